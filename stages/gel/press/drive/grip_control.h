// How drives close two fingers, so that they press with a force that is wanted.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "common/base/types.h"
#include "stages/gel/press/measure/verdict.h"

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

/// State of the hand of a grasp.
struct HandState {
  std::array<GripControl, 2> drives;  // of left and right finger; one that moves both counts as two that are alike
  Matrix4 world_from_hand = Matrix4::Identity();
  double grip_n = 0.0;  // Grasp::grip_n
};

inline constexpr double kFirstTouch_m = 2e-5;  // displacement of a finger in the step after its first touch
// A smaller change of force within a step, as a fraction of the force, may be the solver's tolerance.
inline constexpr double kMeasurablePart = 2e-3;

}  // namespace tacipc
