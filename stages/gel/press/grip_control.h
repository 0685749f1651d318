// How two fingers on one drive are closed, so that they press with a force that is wanted.
#pragma once

#include <functional>

namespace tacipc {

/// The drive, from one time step to the next. Both fingers close by (wanted − present force)/stiffness, the stiffness
/// being that of the last steps.
struct GripControl {
  double wanted_n = 0.0;  // grip that the last time step should have ended with: mean of both fingers
  double closed_m = 0.0;  // of each finger, from where it began
  double last_step_m = 0.0, last_grip_n = 0.0;
  double stiffness_n_m = 0.0;  // of the grip, as the last steps had it
  bool let_go = false;         // the object is free
  bool by_way = false;         // the fingers go to where they are wanted, whatever their grip
  double wanted_closed_m = 0.0;

  /// Smallest gap between fingers and object, of no interest where it is larger than `none`.
  using Gap = std::function<double(double none)>;

  /// The grip that time steps should end with from now on.
  void grip(double force_n);
  /// Where the fingers should be from now on.
  void go_to(double closed_m);

  /// How far both fingers close in a time step that should end with what is wanted, at most by `most_m`.
  /// \param reach_m how near counts as touching
  double closing_step(double most_m, double reach_m, const Gap& gap) const;
  /// Takes note of the grip after a step in which they have closed by so much.
  void measure(double step_m, double grip_n);

  /// Whether any force is left between fingers and object.
  bool touches() const;
  /// Whether the object is free and neither finger touches it: fingers neither close nor open any further then, except
  /// in a release.
  bool lost() const { return let_go && !touches(); }
  /// Whether the last step ended with what is wanted.
  bool arrived() const;
};

inline constexpr double kTouches_n = 1e-6;  // a smaller force on a finger is none

}  // namespace tacipc
