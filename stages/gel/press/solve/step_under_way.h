// Data of a time step while it is solved: the step itself (Step) and one run of Newton's method within it
// (Minimisation).
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "stages/gel/press/energy/dirichlet.h"
#include "stages/gel/press/energy/friction.h"
#include "stages/gel/press/energy/incremental_potential.h"
#include "stages/gel/press/solve/newton_step.h"
#include "stages/gel/press/solve/solver_model.h"
#include "stages/gel/press/solve/step_goal.h"
#include "stages/gel/press/solve/step_report.h"

namespace tacipc {

/// Called after each Newton iteration, for progress lines.
using IterationObserver = std::function<void(int iteration, double velocity_residual_m_s)>;

/// A time step under way: its goal, its energy terms, the current positions and its report.
struct Step {
  const StepGoal& goal;
  const IterationObserver& observe;
  NewtonStepper& newton;   // stepper for the bodies that are free in this step
  const Positions& start;  // positions of gel and object at the start
  Positions x;
  Positions turned_start = {};  // start rotated with the hand; empty if the hand does not rotate
  StepTerms terms = {};         // energy terms apart from contact and friction
  StepWeights weights = {};
  SymmetricRows start_stress_pa = {};      // elastic stress of a viscoelastic gel at the start
  bool arrived = false;                    // objects are at their targets and gels have followed their mounts
  double gel_way_left = 0.0;               // fraction of StepGoal::gel_motion that is still to be made
  Vector3 object_shift = Vector3::Zero();  // translation along the free axes so far
  /// A body that is free in this step.
  struct Body {
    int body = 0;                                     // index of the body
    ControlPoints predicted = ControlPoints::Zero();  // control points after flight without contact
    Vector3 acceleration_m_s2 = Vector3::Zero();      // acceleration by weight and load
    double weight_n = 0.0;                            // weight or load, whichever is larger, N
  };
  std::vector<Body> bodies = {};  // free bodies, ascending
  StepReport report = {};
  std::shared_ptr<const Friction> friction = nullptr;
  std::shared_ptr<const Dirichlet> constraint = nullptr;
  Blend blend;             // blend of the contact Hessian, used once the objects have arrived
  double looseness = 1.0;  // factor on the tolerances while friction is still to be updated
  int renewals_left = 0;   // friction updates left before Newton iterations; the others are made at minima
  /// Smallest change by such an update since arrival.
  double least_friction_change_n = std::numeric_limits<double>::infinity();

  /// Positions from which slides and strain rates are measured.
  const Positions& compared_start() const { return turned_start.rows() > 0 ? turned_start : start; }

  /// Incremental potential with this barrier and the step's current friction.
  IncrementalPotential potential(std::shared_ptr<const ContactBarrier> barrier) const {
    StepTerms all = terms;
    all.friction = friction;
    all.barrier = std::move(barrier);
    return make_incremental_potential(all, weights);
  }
};

/// A barrier with a cache of its active pairs at the last x: energy, friction and derivatives need them at the same x.
class ActiveBarrier {
 public:
  explicit ActiveBarrier(std::shared_ptr<const ContactBarrier> barrier) : barrier_(std::move(barrier)) {}
  const std::shared_ptr<const ContactBarrier>& barrier() const { return barrier_; }
  /// Active pairs at x; computed only if x has changed.
  const std::vector<int>& at(const Positions& x) {
    if (x_.rows() != x.rows() || (x_.array() != x.array()).any()) {
      x_ = x;
      pairs_ = barrier_->active(x);
    }
    return pairs_;
  }

 private:
  std::shared_ptr<const ContactBarrier> barrier_;
  Positions x_;
  std::vector<int> pairs_;
};

/// One run of Newton's method towards a minimum: data that an iteration leaves for the next.
struct Minimisation {
  ActiveBarrier active;
  IncrementalPotential energy;
  std::optional<double> value = std::nullopt;  // energy at x, if the line search or a patch has computed it
  double residual_m_s = std::numeric_limits<double>::infinity();  // max |p| / h of the last direction
  int exact_hessian_waits = 0;  // iterations within tolerance that only waited for the exact contact Hessian
  double part_of_motion = 1.0;  // fraction of the remaining motion that the next move attempts
  double bent = 1.0;            // fraction of the computed direction that this move keeps after bending at contacts
  int crept = 0;                // consecutive full steps with an approximated Hessian
  double stretch = 1.0;         // factor on the length of the next step
  bool relax_next = false;      // relax the gel at a fixed object before the next move
};

inline constexpr double kLeastWeight = 0.01;  // N: smallest weight by which the balance of a free body is scaled
inline constexpr double kMovingSlack = 0.3;   // fraction of each gap that a move leaves: no line search guards it
inline constexpr double kNewtonSlack = 0.1;   // fraction of each gap that a Newton step leaves
/// Armijo constant: required fraction of the decrease predicted by the slope.
inline constexpr double kSufficientDecrease = 1e-4;
inline constexpr double kEnergyRounding = 1e-14;  // relative change of the energy below which it is not measurable
/// Distance, m, at which the augmented Lagrangian counts a target as met.
inline constexpr double kConstraintTolerance = 2e-10;

}  // namespace tacipc
