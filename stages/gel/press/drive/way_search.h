// The search for the displacements of two fingers in one time step that leave their drives in balance.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "stages/gel/press/drive/grip_control.h"

namespace tacipc {

/// The ways that are tried in one time step of a drive, each from the state before it, until the grip that the step
/// ends with balances the drive: m/h (Δs/h − v) + c Δs/h + grip = wanted.
class WaySearch {
 public:
  /// \param most_m of the way, in either direction
  /// \param reach_m how near counts as touching
  WaySearch(const GripControl& drive, const DriveInertia& inertia, double h_s, double most_m, double reach_m,
            const GripControl::Gap& gap);

  /// The way to be tried.
  double way_m() const { return way_m_; }
  /// Takes note of the grip that a step by way_m() ended with. \param object_m how far the object has gone ahead of the
  /// finger meanwhile
  void note(double grip_n, double object_m = 0.0);
  /// Whether that way stands: it is in balance, or as far as the drive may go towards it.
  bool stands() const;
  /// Fraction of the force that is missing to the balance after the last displacement; 0 if the drive may not go
  /// farther towards it.
  double imbalance() const;
  /// The next way to be tried, towards the balance, if the object is to go ahead by so much more than it did. Where it
  /// stays, ways between two known ones are between them: the more a finger closes, the harder it presses.
  void correct(double object_ahead_m = 0.0);

  /// The same for the first one: the object was not taken to move.
  void expect(double object_ahead_m);
  /// A step by a way Δ is expected to change |m a + c v + grip − wanted|, which is off_n() now, by Δ × (inertia_n_m() +
  /// stiffness_n_m()).
  double off_n() const { return off_n_; }
  double inertia_n_m() const { return inertia_n_m_; }
  /// Of the grip: 0 where nothing is touched.
  double stiffness_n_m() const { return stiffness_n_m_; }
  /// The stiffness that ways of this step have told, or without inertia that has predicted its grip well.
  std::optional<double> found_n_m() const;

 private:
  double scale_n() const;
  bool balanced() const;
  bool at_its_limit() const {
    return (off_n_ < 0.0 && noted_way_m_ >= most_m_) || (off_n_ > 0.0 && noted_way_m_ <= least_m_);
  }

  double wanted_n_, inertia_n_m_, push_n_;  // push: m/h v + wanted
  double way_m_ = 0.0, off_n_ = 0.0, grip_n_;
  double stiffness_n_m_;
  bool measured_ = false, touches_, object_moves_ = false;
  double least_m_, most_m_;
  /// Ways that were too short and too long, nearest to the balance.
  struct Known {
    double way_m, off_n;
  };
  Known low_{-std::numeric_limits<double>::infinity(), 0.0}, high_{std::numeric_limits<double>::infinity(), 0.0};
  double noted_m_ = 0.0;      // of finger into object, by the last try
  double noted_way_m_ = 0.0;  // of the finger, by the last try
  int tries_ = 0;
};

/// Displacements by which the left and the right finger close.
using Ways = std::array<double, 2>;

/// The search of both fingers. With a drive each they are coupled by a free object between them, which moves until it
/// is in balance itself.
class PairSearch {
 public:
  PairSearch(const std::array<WaySearch, 2>& sides, bool coupled, double object_n_m)
      : sides_(sides), coupled_(coupled), object_n_m_(object_n_m) {}

  /// Takes the motion of a free object into account before the first try.
  /// \param pull_n force by which the object is out of balance if neither finger closes
  void expect(double pull_n);
  Ways ways_m() const { return {sides_[0].way_m(), sides_[1].way_m()}; }
  /// \param object_m displacement of the object from left to right in the try
  void note(const Ways& grips_n, double object_m);
  bool stands() const { return sides_[0].stands() && sides_[1].stands(); }
  double imbalance() const { return std::max(sides_[0].imbalance(), sides_[1].imbalance()); }
  void correct();
  std::optional<double> found_n_m(std::size_t side) const { return sides_[side].found_n_m(); }

 private:
  /// Further displacement of the object from left to right if both drives are corrected: the solution of the three
  /// linear equations of both fingers and the object.
  double shift_of_object(double pull_n) const;

  std::array<WaySearch, 2> sides_;
  bool coupled_;
  double object_n_m_;  // m/h² of the object
};

}  // namespace tacipc
