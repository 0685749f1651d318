// Control of the drives that close two fingers with a prescribed force.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "common/base/types.h"
#include "stages/gel/press/measure/verdict.h"

namespace tacipc {

/// Inertia and damping of a drive along its closing axis: m a + c v = prescribed force − grip force. If both are zero,
/// the grip force equals the prescribed force at the end of every time step, as far as the fingers can move.
struct DriveInertia {
  double mass_kg = 0.0, damping_n_s_m = 0.0;  // mass and viscous damping

  /// Stiffness m/h² + c/h against displacement in an implicit time step.
  double stiffness_n_m(double h_s) const { return (mass_kg / h_s + damping_n_s_m) / h_s; }
  bool none() const { return mass_kg == 0.0 && damping_n_s_m == 0.0; }
};

/// State of a drive from one time step to the next.
struct GripControl {
  /// Force by which the drive closes; without inertia the grip force at the end of the last time step.
  double wanted_n = 0.0;
  double closed_m = 0.0;  // displacement since the start
  double velocity_m_s = 0.0;
  double last_step_m = 0.0, last_grip_n = 0.0;  // displacement and grip force of the last time step
  double stiffness_n_m = 0.0;    // last measured stiffness of the grip, due to the deformation of object and gels
  bool let_go = false;           // the object is free
  bool by_way = false;           // the finger has a prescribed displacement, whatever its grip force
  double wanted_closed_m = 0.0;  // prescribed displacement since the start

  /// Smallest gap between finger and object, capped at `none`.
  using Gap = std::function<double(double none)>;

  /// Sets the grip force with which the following time steps should end.
  void grip(double force_n);
  /// Sets the displacement that the following time steps should reach.
  void go_to(double closed_m);

  /// Records the displacement and the grip force of a time step.
  /// \param found_n_m stiffness determined in this step; absent: it is computed from the change of the grip force since
  /// the last step
  void measure(double h_s, double step_m, double grip_n, std::optional<double> found_n_m = {});

  /// Whether there is contact between finger and object.
  bool touches() const;
  /// Whether the object is free and the finger does not touch it.
  bool lost() const { return let_go && !touches(); }
  /// Whether the last step ended with the prescribed force or displacement, and a drive with mass does not oscillate
  /// about it.
  bool arrived(const DriveInertia& inertia = {}) const;
};

/// State of the hand of a grasp.
struct HandState {
  std::array<GripControl, 2> drives;  // drives of left and right finger; a common drive is stored as two equal ones
  Matrix4 world_from_hand = Matrix4::Identity();
  double grip_n = 0.0;  // value of Grasp::grip_n
};

inline constexpr double kFirstTouch_m = 2e-5;  // displacement of a finger in the step after its first touch
/// Smallest measurable change of force within a step, as a fraction of the force; less may be due to the solver's
/// tolerance.
inline constexpr double kMeasurablePart = 2e-3;

}  // namespace tacipc
