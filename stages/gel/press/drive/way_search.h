// Search for the displacements of two fingers in one time step that leave their drives in balance.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "stages/gel/press/drive/grip_control.h"

namespace tacipc {

/// Displacements that are attempted in one time step of a drive, each from the state before the step, until the grip
/// force at its end balances the drive: m/h (Δs/h − v) + c Δs/h + grip = wanted.
/// Call order: way_m() gives the displacement, note() records its grip force, and correct() computes the next one until
/// stands().
class WaySearch {
 public:
  /// \param most_m largest displacement in either direction
  /// \param reach_m gap below which finger and object touch
  WaySearch(const GripControl& drive, const DriveInertia& inertia, double h_s, double most_m, double reach_m,
            const GripControl::Gap& gap);

  /// Displacement to be attempted.
  double way_m() const { return way_m_; }
  /// Records the grip force after a step by way_m().
  /// \param object_m displacement of the object away from the finger in that step
  void note(double grip_n, double object_m = 0.0);
  /// Whether the last displacement is accepted: it is in balance, at the drive's limit, or the last attempt.
  bool stands() const;
  /// Imbalance after the last displacement as a fraction of the force; 0 at the drive's limit.
  double imbalance() const;
  /// Computes the next displacement. If the object does not move, displacements between two known ones are bracketed by
  /// them: the more a finger closes, the harder it presses.
  /// \param object_ahead_m expected further displacement of the object away from the finger
  void correct(double object_ahead_m = 0.0);

  /// Adapts the first displacement to an expected displacement of the object.
  void expect(double object_ahead_m);
  /// Residual m a + c v + grip − wanted. A displacement Δ is expected to change it by Δ × (inertia_n_m() +
  /// stiffness_n_m()).
  double off_n() const { return off_n_; }
  /// Stiffness m/h² + c/h of the drive itself.
  double inertia_n_m() const { return inertia_n_m_; }
  /// Stiffness of the grip; 0 without contact.
  double stiffness_n_m() const { return stiffness_n_m_; }
  /// Stiffness determined by the attempts of this step, or confirmed without inertia by a well predicted grip force.
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
  /// A known displacement and its residual: the longest that was too short, and the shortest that was too long.
  struct Known {
    double way_m, off_n;
  };
  Known low_{-std::numeric_limits<double>::infinity(), 0.0}, high_{std::numeric_limits<double>::infinity(), 0.0};
  double noted_m_ = 0.0;      // last displacement of the finger relative to the object
  double noted_way_m_ = 0.0;  // last displacement of the finger
  int tries_ = 0;
};

/// Displacements by which the left and the right finger close.
using Ways = std::array<double, 2>;

/// Search for both fingers. If each has its own drive, they are coupled by a free object between them, which moves
/// until it is in balance itself.
class PairSearch {
 public:
  PairSearch(const std::array<WaySearch, 2>& sides, bool coupled, double object_n_m)
      : sides_(sides), coupled_(coupled), object_n_m_(object_n_m) {}

  /// Includes the motion of a free object before the first attempt.
  /// \param pull_n net force on the object if neither finger closes
  void expect(double pull_n);
  Ways ways_m() const { return {sides_[0].way_m(), sides_[1].way_m()}; }
  /// Records both grip forces. \param object_m displacement of the object from left to right in the attempt
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
