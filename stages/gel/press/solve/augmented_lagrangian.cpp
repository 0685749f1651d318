// Within a time step: glued and object vertices held by multipliers instead of being eliminated.
#include "common/base/error.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

constexpr double kConstraintStiffness = 100.0;  // per vertex, over that of a contact pair
constexpr int kMaxMultiplierUpdates = 60;
// Where an update leaves more than the first part of a miss, the constraint gets so many times as stiff.
constexpr double kSlowProgress = 0.3, kStiffening = 4.0;

}  // namespace

void TimeStepper::add_constraint(Step& step) const {
  const int n = mesh_.num_gel_vertices;
  std::vector<int> vertices = gel_.glued;
  for (int v = 0; v < mesh_.num_object_vertices; ++v) vertices.push_back(n + v);
  Positions targets(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < gel_.glued.size(); ++i)
    targets.row(static_cast<Eigen::Index>(i)) = mesh_.rest_positions.row(gel_.glued[i]);
  targets.bottomRows(mesh_.num_object_vertices) = step.goal.object_target;
  const double stiffness =
      kConstraintStiffness * step.weights.barrier_stiffness_j_m4 * settings_.laws.reach_m() * settings_.laws.reach_m();
  const Positions no_multipliers = Positions::Zero(targets.rows(), 3);
  step.constraint = std::make_shared<Dirichlet>(std::move(vertices), std::move(targets), no_multipliers, stiffness);
  step.terms.constraint = step.constraint;
  step.arrived = true;  // the energy pulls the object along
}

void TimeStepper::minimise_constrained(Step& step) {
  minimise(step);
  double last_miss = std::numeric_limits<double>::infinity();
  for (int update = 0; step.constraint; ++update) {
    const double miss = largest_row(step.constraint->misses(step.x), step.constraint->num_stencils());
    if (miss <= kConstraintTolerance) return;
    if (update == kMaxMultiplierUpdates) {
      throw SolverError("the augmented Lagrangian left a vertex {:.2e} m from its target after {} renewals", miss,
                        kMaxMultiplierUpdates);
    }
    // Where contact is stiffer than the constraint, multipliers converge slowly.
    const double stiffening = miss > kSlowProgress * last_miss ? kStiffening : 1.0;
    step.constraint = std::make_shared<Dirichlet>(step.constraint->renewed(step.x, stiffening));
    last_miss = miss;
    step.terms.constraint = step.constraint;
    minimise(step);
  }
}

}  // namespace tacipc
