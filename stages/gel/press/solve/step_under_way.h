// Data of a time step while it is solved.
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

struct Step {
  const StepGoal& goal;
  const IterationObserver& observe;
  NewtonStepper& newton;   // for the bodies that are free in this step
  const Positions& start;  // of gel and object
  Positions x;
  Positions turned_start = {};  // the start moved with the hand, if that turns
  StepTerms terms = {};         // all but contact
  StepWeights weights = {};
  SymmetricRows start_stress_pa = {};      // elastic, of a viscoelastic gel
  bool arrived = false;                    // objects are at their targets, and gels are where their mounts end
  double gel_way_left = 0.0;               // part of StepGoal::gel_motion that is still to be made
  Vector3 object_shift = Vector3::Zero();  // along its free axes, so far
  /// A body that is free in this step.
  struct Body {
    int body = 0;                                     // its number
    ControlPoints predicted = ControlPoints::Zero();  // without contact
    Vector3 acceleration_m_s2 = Vector3::Zero();      // by its weight and load
    double weight_n = 0.0;                            // the larger of the two
  };
  std::vector<Body> bodies = {};  // ascending
  StepReport report = {};
  std::shared_ptr<const Friction> friction = nullptr;
  std::shared_ptr<const Dirichlet> constraint = nullptr;
  Blend blend;             // of the contact Hessian, once the object has arrived
  double looseness = 1.0;  // factor on the tolerances, while friction is still to be updated
  int renewals_left = 0;   // friction updates left before iterations of Newton's method, instead of at its minima
  double least_friction_change_n = std::numeric_limits<double>::infinity();  // of these updates since arrival

  /// Positions from which slides and strain rates are measured.
  const Positions& compared_start() const { return turned_start.rows() > 0 ? turned_start : start; }

  /// The incremental potential with the step's friction and this barrier.
  IncrementalPotential potential(std::shared_ptr<const ContactBarrier> barrier) const {
    StepTerms all = terms;
    all.friction = friction;
    all.barrier = std::move(barrier);
    return make_incremental_potential(all, weights);
  }
};

/// A barrier and its active pairs at the last x: energy, friction and derivatives need them at the same x.
class ActiveBarrier {
 public:
  explicit ActiveBarrier(std::shared_ptr<const ContactBarrier> barrier) : barrier_(std::move(barrier)) {}
  const std::shared_ptr<const ContactBarrier>& barrier() const { return barrier_; }
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

/// Newton's method at work on one minimum: data that an iteration leaves for the next.
struct Minimisation {
  ActiveBarrier active;
  IncrementalPotential energy;
  std::optional<double> value = std::nullopt;  // of the energy at x, if line search or patch have computed it
  double residual_m_s = std::numeric_limits<double>::infinity();  // max |p| / h of the last direction
  int exact_hessian_waits = 0;  // iterations within the tolerances that went on for want of the exact Hessian
  double part_of_motion = 1.0;  // part of the rest of its motion that the next move takes the object by
  double bent = 1.0;            // part of the direction found that this move takes
  int crept = 0;                // whole steps in a row with an approximated Hessian
  double stretch = 1.0;         // factor on the length of the next step
  bool relax_next = false;      // the gel is relaxed at a fixed object before the next move
};

inline constexpr double kLeastWeight = 0.01;           // N: a lighter body's balance is measured as if it weighed this
inline constexpr double kMovingSlack = 0.3;            // part of each gap that a move leaves: no line search guards it
inline constexpr double kNewtonSlack = 0.1;            // part of each gap that a step leaves
inline constexpr double kSufficientDecrease = 1e-4;    // Armijo: part of the decrease that the slope promises
inline constexpr double kEnergyRounding = 1e-14;       // relative: changes of the energy below it are not measurable
inline constexpr double kConstraintTolerance = 2e-10;  // m: augmented Lagrangian, when targets count as met

}  // namespace tacipc
