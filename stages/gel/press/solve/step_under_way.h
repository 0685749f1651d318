// One time step while it is solved: what the files that solve it share.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "stages/gel/press/energy/dirichlet.h"
#include "stages/gel/press/solve/time_step.h"

namespace tacipc {

struct TimeStepper::Step {
  const StepGoal& goal;
  const IterationObserver& observe;
  const Positions& start;  // of gel and object
  Positions x;
  Positions turned_start = {};  // the start moved with the hand, where that turns
  StepTerms terms = {};         // all but contact
  StepWeights weights = {};
  SymmetricRows start_stress_pa = {};      // elastic, where stress relaxes
  bool arrived = false;                    // objects are at their targets, and gels are where their mounts end
  double gel_way_left = 0.0;               // part of StepGoal::gel_motion that is still to be made
  Vector3 object_shift = Vector3::Zero();  // along its free axes, so far
  struct Body {
    int body = 0;                                     // its number
    ControlPoints predicted = ControlPoints::Zero();  // without contact
    Vector3 acceleration_m_s2 = Vector3::Zero();      // of its weight and load
    double weight_n = 0.0;                            // the larger of the two
  };
  std::vector<Body> bodies = {};  // those that are free, ascending
  StepReport report = {};
  std::shared_ptr<const Friction> friction = nullptr;
  std::shared_ptr<const Dirichlet> constraint = nullptr;
  Blend blend;             // of the contact Hessian, once the object has arrived
  double looseness = 1.0;  // factor on the tolerances, while friction is still to be renewed
  /// How often friction may still be renewed before an iteration of Newton's method, instead of at its minima.
  int renewals_left = 0;
  double least_friction_change_n = std::numeric_limits<double>::infinity();  // of those renewals since arrival

  /// What slides and strain rates are measured from.
  const Positions& compared_start() const { return turned_start.rows() > 0 ? turned_start : start; }
};

/// Newton's method at work on one minimum: what an iteration leaves for the next.
struct TimeStepper::Minimisation {
  std::shared_ptr<const ContactBarrier> barrier;
  IncrementalPotential energy;
  std::optional<double> value = std::nullopt;  // of the energy at x, where line search and patch have told it
  double residual_m_s = std::numeric_limits<double>::infinity();  // max |p| / h of the last direction
  int exact_hessian_waits = 0;  // iterations within the tolerances that went on for want of the exact Hessian
  /// The part of the rest of its motion that the next move takes the object by, and whether the gel is relaxed at a
  /// fixed object first.
  double part_of_motion = 1.0;
  double bent = 1.0;  // the part of the direction found that this move takes
  /// Whole steps in a row that had to do with an approximated Hessian, and how many times as far the next one goes.
  int crept = 0;
  double stretch = 1.0;
  bool relax_next = false;
};

/// The line search had to shorten the step p: raises the PSD shares of the vertices that go farthest in it, the likely
/// cause.
void raise_shares_of_farthest(const Positions& p, Blend& blend);

/// How far a rigid motion takes each point.
Positions way_of(const Matrix4& motion, const Positions& from);

/// √(max |row i|²) over the first `rows` rows.
double largest_row(const Positions& p, Eigen::Index rows);

inline constexpr double kLeastWeight = 0.01;           // N: a lighter body's balance is measured as if it weighed this
inline constexpr double kMovingSlack = 0.3;            // part of each gap that a move leaves: no line search guards it
inline constexpr double kNewtonSlack = 0.1;            // part of each gap that a step leaves
inline constexpr double kSufficientDecrease = 1e-4;    // Armijo: part of the decrease that the slope promises
inline constexpr double kEnergyRounding = 1e-14;       // relative: changes of the energy below it are not measurable
inline constexpr double kConstraintTolerance = 2e-10;  // m: augmented Lagrangian, when targets count as met

}  // namespace tacipc
