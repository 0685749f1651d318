#include "stages/gel/press/solve/augmented_lagrangian.h"

#include <limits>

#include "common/base/error.h"
#include "stages/gel/press/solve/line_search.h"

namespace tacipc {
namespace {

constexpr double kConstraintStiffness = 100.0;  // per vertex, relative to the stiffness of a contact pair
constexpr int kMaxMultiplierUpdates = 60;
// If an update leaves more than kSlowProgress of the last miss, the stiffness is multiplied by kStiffening.
constexpr double kSlowProgress = 0.3, kStiffening = 4.0;

}  // namespace

void add_constraint(const SolverModel& model, Step& step) {
  const int n = model.mesh.num_gel_vertices;
  std::vector<int> vertices = model.gel.glued;
  for (int v = 0; v < model.mesh.num_object_vertices; ++v) vertices.push_back(n + v);
  Positions targets(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < model.gel.glued.size(); ++i)
    targets.row(static_cast<Eigen::Index>(i)) = model.mesh.rest_positions.row(model.gel.glued[i]);
  targets.bottomRows(model.mesh.num_object_vertices) = step.goal.object_target;
  const double stiffness = kConstraintStiffness * step.weights.barrier_stiffness_j_m4 * model.settings.laws.reach_m() *
                           model.settings.laws.reach_m();
  const Positions no_multipliers = Positions::Zero(targets.rows(), 3);
  step.constraint = std::make_shared<Dirichlet>(std::move(vertices), std::move(targets), no_multipliers, stiffness);
  step.terms.constraint = step.constraint;
  step.arrived = true;  // the constraint's energy moves the object to its target
}

void minimise_constrained(Step& step, const std::function<void()>& minimise) {
  minimise();
  double last_miss = std::numeric_limits<double>::infinity();
  for (int update = 0; step.constraint; ++update) {
    const double miss = largest_row(step.constraint->misses(step.x), step.constraint->num_stencils());
    if (miss <= kConstraintTolerance) return;
    if (update == kMaxMultiplierUpdates) {
      throw SolverError("the augmented Lagrangian left a vertex {:.2e} m from its target after {} renewals", miss,
                        kMaxMultiplierUpdates);
    }
    // If contact is stiffer than the constraint, multipliers converge slowly.
    const double stiffening = miss > kSlowProgress * last_miss ? kStiffening : 1.0;
    step.constraint = std::make_shared<Dirichlet>(step.constraint->renewed(step.x, stiffening));
    last_miss = miss;
    step.terms.constraint = step.constraint;
    minimise();
  }
}

}  // namespace tacipc
