// Within a time step: Newton's method for the few vertices that still move.
#include <algorithm>
#include <limits>
#include <optional>

#include "common/log.h"
#include "stages/press/solve/local_patch.h"
#include "stages/press/solve/step_limit.h"
#include "stages/press/solve/step_under_way.h"

namespace tacipc {
namespace {

constexpr double kFewVertices = 0.005;  // part of the gel's that a patch starts from at most
constexpr double kStandOut = 3.0;       // times as far as the next goes the farthest of them
constexpr int kRings = 2;
constexpr int kMaxIterations = 20;
// Of how far all others go, or of the tolerance: the whole is to find nothing left to do there.
constexpr double kEnough = 0.2;
constexpr int kMaxHalvings = 20;
constexpr double kReach = 1.0;          // how far patches move at most, × d̂
constexpr double kSmallestPart = 1e-3;  // of a Newton step that is worth taking

/// Vertices that go farther than all others.
struct Seeds {
  std::vector<int> vertices;
  double rest_m;  // how far others go, at least the tolerance
};

/// Nothing where nobody goes farther than the tolerance, or many do and none of them stands out.
std::optional<Seeds> seeds(const Positions& p, const FreeVertices& free, double tolerance_m) {
  std::vector<double> ways;
  for (const int v : free.vertex_of_free) ways.push_back(p.row(v).norm());
  std::vector<double> sorted = ways;
  const auto few = static_cast<std::ptrdiff_t>(kFewVertices * static_cast<double>(ways.size()));
  const auto rest = sorted.end() - 1 - few;
  std::nth_element(sorted.begin(), rest, sorted.end());
  const double farthest = *std::max_element(rest, sorted.end());
  if (farthest <= tolerance_m || (*rest > tolerance_m && farthest < kStandOut * *rest)) return std::nullopt;
  Seeds found{{}, std::max(*rest, tolerance_m)};
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (ways[i] > found.rest_m) found.vertices.push_back(free.vertex_of_free[i]);
  }
  return found;
}

}  // namespace

bool TimeStepper::relax_patch(Step& step, const NewtonDirection& direction) {
  if (!settings_.newton.patches || settings_.augmented_lagrangian || !step.goal.yielding.empty()) return false;
  const double h = step.goal.h_s, tolerance = settings_.newton.velocity_tolerance_m_s * h;
  const Stopwatch watch(times_.patches_s);
  const std::optional<Seeds> found = seeds(direction.p, newton_.free(), tolerance);
  if (!found) return false;

  const LocalPatch patch = grow_patch(found->vertices, kRings, gel_.tets, newton_.free());
  const double reach = kReach * settings_.d_hat_m;
  const Positions start = step.x;
  const std::vector<ContactPair> pairs = search_.pairs_around(patch.moves, start, settings_.d_hat_m, reach);
  StepTerms terms = step.terms;
  for (auto* term : {&terms.inertia, &terms.mass_damping, &terms.stiffness_damping, &terms.gravity, &terms.elasticity})
    *term = restricted(*term, patch.moves);
  terms.friction = step.friction ? step.friction->restricted_to(patch.moves) : nullptr;
  terms.barrier = std::make_shared<ContactBarrier>(barrier(pairs));
  const IncrementalPotential energy = make_incremental_potential(terms, step.weights);

  NewtonStepper newton(patch.free, mesh_.num_gel_vertices, mesh_pattern(patch.free, *terms.elasticity),
                       settings_.linear_solver);
  const Positions still = Positions::Zero(step.x.rows(), 3);
  Blend blend = step.blend;
  int iterations = 0;
  for (bool room = true; room && iterations < kMaxIterations; ++iterations) {
    const NewtonDirection local =
        newton.direction(energy, step.x, still, {}, std::numeric_limits<double>::infinity(), blend);
    const double longest = std::sqrt(local.p.rowwise().squaredNorm().maxCoeff());
    const bool exact = local.blend == 0.0 || !settings_.newton.adaptive_contact_hessian;
    if (longest < kEnough * found->rest_m && (exact || found->rest_m > tolerance)) break;
    double alpha = 1.0;
    // No further than the pairs at hand are all there are.
    for (const int v : patch.free.vertex_of_free) {
      for (int c = 0; c < 3; ++c) {
        const double before = step.x(v, c) - start(v, c), way = local.p(v, c);
        if (std::abs(before + alpha * way) > reach) alpha = std::max(0.0, ((way > 0 ? reach : -reach) - before) / way);
      }
    }
    if (alpha < kSmallestPart) break;
    room = alpha == 1.0;
    const Positions p = alpha * local.p;
    const double limit = std::min(contact_step_limit(pairs, step.x, p, {kNewtonSlack, kGapFloor * settings_.d_hat_m}),
                                  inversion_step_limit(patch.tets, step.x, p));
    const double before = energy.value(step.x), noise = 1e-14 * std::abs(before);
    double part = limit;
    int halvings = 0;
    Positions trial = step.x + part * p;
    while (!(energy.value(trial) <= before + 1e-4 * part * alpha * local.slope + noise) && halvings < kMaxHalvings) {
      ++halvings;
      part *= 0.5;
      trial = step.x + part * p;
    }
    if (halvings == kMaxHalvings) break;
    step.x = trial;
    if (halvings > 0) lean_on_farthest(local.p.topRows(mesh_.num_gel_vertices), blend);
    log_debug("    patch {:3d}: alpha {:.3g} (limit {:.3g}) step {:.3e} m/s blend {:.3g}", iterations + 1, part * alpha,
              limit, longest / h, local.blend);
  }
  step.report.patch_iterations += iterations;
  ++step.report.patches;
  log_debug("  patch of {} vertices ({} moved): {} iterations", patch.free.size(), found->vertices.size(), iterations);
  return iterations > 0;
}

}  // namespace tacipc
