// How drives close two fingers, so that they press with a force that is wanted.
#pragma once

#include <functional>
#include <limits>
#include <optional>

namespace tacipc {

/// What a drive moves and what holds it back, along its way: m a + c v = wanted force − grip. Without either the grip
/// is the wanted force at the end of every time step, as far as the fingers get.
struct DriveInertia {
  double mass_kg = 0.0, damping_n_s_m = 0.0;

  /// m/h² + c/h, by which the way of an implicit time step is resisted.
  double stiffness_n_m(double h_s) const { return (mass_kg / h_s + damping_n_s_m) / h_s; }
  bool none() const { return mass_kg == 0.0 && damping_n_s_m == 0.0; }
};

/// A drive, from one time step to the next.
struct GripControl {
  double wanted_n = 0.0;  // force that it closes with; without inertia the grip that the last time step ended with
  double closed_m = 0.0;  // its way, from where it began
  double velocity_m_s = 0.0;
  double last_step_m = 0.0, last_grip_n = 0.0;
  double stiffness_n_m = 0.0;  // of the grip, by the object's and the gels' deformation, as measured last
  bool let_go = false;         // the object is free
  bool by_way = false;         // the fingers go to where they are wanted, whatever their grip
  double wanted_closed_m = 0.0;

  /// Smallest gap between fingers and object, of no interest where it is larger than `none`.
  using Gap = std::function<double(double none)>;

  /// The grip that time steps should end with from now on.
  void grip(double force_n);
  /// Where the fingers should be from now on.
  void go_to(double closed_m);

  /// Takes note of the grip after a time step in which it has closed by so much.
  /// \param found_n_m the stiffness that the step has told; none: by how much the grip is more than after the last step
  void measure(double h_s, double step_m, double grip_n, std::optional<double> found_n_m = {});

  /// Whether any force is left between fingers and object.
  bool touches() const;
  /// Whether the object is free and it does not touch it.
  bool lost() const { return let_go && !touches(); }
  /// Whether the last step ended with what is wanted, and a drive with mass does not swing about it.
  bool arrived(const DriveInertia& inertia = {}) const;
};

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
  double noted_m_ = 0.0;  // of finger into object, by the last try
  int tries_ = 0;
};

inline constexpr double kTouches_n = 1e-6;  // a smaller force on a finger is none

}  // namespace tacipc
