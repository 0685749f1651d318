// Within a time step: Newton's method for the few vertices that still move.
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/log.h"
#include "stages/gel/press/contact/patch_search.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/step_limit.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

constexpr double kMostSeeds = 0.01;   // largest part of the free vertices that a patch starts from
constexpr int kFewestVertices = 400;  // that are free: with fewer a step of all costs no more than a patch
// Where more vertices than that move: the farthest of the seeds goes so many times as far as any other vertex.
constexpr double kStandOut = 3.0;
// Once no step is longer than the first, × the tolerance, a patch starts from the vertices whose contact Hessian was
// approximated, if they are at most the second part of the free ones; what makes it indefinite is wider than one ring.
constexpr double kNearRest = 20.0, kMostApproximated = 0.015;
constexpr int kRings = 1, kRingsAboutApproximated = 3;
// Without friction, what snaps drags the gel around it along: patches of at least this part of the free vertices, at
// most so many rings wide, leave a fifth fewer steps of all.
constexpr double kLeastWithoutFriction = 0.09;
constexpr int kMostRingsWithoutFriction = 4;
constexpr int kMaxIterations = 20;
// Iterations × vertices of a patch, × all that are free: a wide one that does not settle soon is left to steps of all.
constexpr double kMostWork = 2.0;
// A patch has converged when its Newton step is shorter than this part of the longest step outside it (at least of the
// tolerance), so that the whole gel finds it at rest. Without friction the gel seldom does.
constexpr double kPatchTolerance = 0.2, kPatchToleranceWithoutFriction = 1.0;
constexpr double kSolveWithoutFriction = 1e-2;  // tolerance of the linear solver there
constexpr int kMaxHalvings = 20;
// How far a vertex of a patch may go until pairs are searched again: × d̂, or × the median edge of the front, whichever
// is more.
constexpr double kReach = 1.0, kReachOfEdge = 0.4;

/// Where a patch starts.
struct Seeds {
  std::vector<int> vertices;
  double others_m;            // the longest displacement of all others, at least the tolerance
  bool approximated = false;  // they are those whose contact Hessian was
};

/// The gel's vertices that go farther than all others; none where no displacement is above the tolerance, or too many
/// are and none of them stands out.
std::optional<Seeds> farthest(const Positions& p, const FreeVertices& free, int num_gel_vertices, double tolerance_m) {
  std::vector<double> lengths;
  std::vector<int> vertices;
  for (const int v : free.vertex_of_free) {
    if (v >= num_gel_vertices) continue;
    lengths.push_back(p.row(v).norm());
    vertices.push_back(v);
  }
  std::vector<double> sorted = lengths;
  const auto most = static_cast<std::ptrdiff_t>(kMostSeeds * static_cast<double>(lengths.size()));
  const auto others = sorted.end() - 1 - most;
  std::nth_element(sorted.begin(), others, sorted.end());
  const double farthest = *std::max_element(others, sorted.end());
  if (farthest <= tolerance_m || (*others > tolerance_m && farthest < kStandOut * *others)) return std::nullopt;
  Seeds found{{}, std::max(*others, tolerance_m)};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] > found.others_m) found.vertices.push_back(vertices[i]);
  }
  return found;
}

/// The gel's vertices about which the last direction took the PSD approximation, where it is only these that keep a
/// gel at rest from being final: they are on the crest of an edge, and go down from it slowly with the approximation.
std::optional<Seeds> approximated(const Blend& blend, const Positions& p, const FreeVertices& free,
                                  int num_gel_vertices, double tolerance_m) {
  if (largest_row(p, p.rows()) > kNearRest * tolerance_m) return std::nullopt;
  Seeds found{{}, tolerance_m, true};
  for (const int v : free.vertex_of_free) {
    if (v < num_gel_vertices && blend.approximated(v)) found.vertices.push_back(v);
  }
  const auto most = static_cast<std::size_t>(kMostApproximated * static_cast<double>(free.size()));
  if (found.vertices.empty() || found.vertices.size() > most) return std::nullopt;
  return found;
}

}  // namespace

std::optional<double> TimeStepper::relax_patch(Step& step, const NewtonDirection& direction,
                                               std::vector<ContactPair>& pairs) {
  if (!settings_.newton.patches || settings_.augmented_lagrangian || !step.goal.free_axes.empty()) return std::nullopt;
  const double h = step.goal.h_s, tolerance = settings_.newton.velocity_tolerance_m_s * h;
  const Stopwatch watch(times_.patches_s);
  const FreeVertices& free = newton_->free();
  if (free.size() < kFewestVertices) return std::nullopt;
  std::optional<Seeds> found = farthest(direction.p, free, mesh_.num_gel_vertices, tolerance);
  const bool may_wait = settings_.newton.adaptive_contact_hessian && step.looseness == 1.0;
  if (!found && may_wait && direction.largest_share > 0.0)
    found = approximated(step.blend, direction.p, free, mesh_.num_gel_vertices, tolerance);
  if (!found) return std::nullopt;

  PatchSize size{found->approximated ? kRingsAboutApproximated : kRings};
  if (!step.friction) {
    size.fewest_vertices = static_cast<int>(kLeastWithoutFriction * free.size());
    size.most_rings = kMostRingsWithoutFriction;
  }
  const LocalPatch patch = grow_patch(found->vertices, size, gel_.tets, tets_of_, free);
  const double reach = std::max(kReach * settings_.laws.reach_m(), kReachOfEdge * settings_.front_edge_m);
  PatchSearch near(search_, patch.free.vertex_of_free, mesh_.num_gel_vertices, step.x, direction.p,
                   settings_.laws.reach_m(), reach);
  StepTerms terms = step.terms;
  for (auto* term : {&terms.inertia, &terms.mass_damping, &terms.stiffness_damping, &terms.gravity,
                     &terms.viscous_memory, &terms.elasticity})
    *term = restricted(*term, patch.moves);
  terms.bodies.clear();  // they are held meanwhile
  terms.friction = step.friction ? step.friction->restricted_to(patch.moves) : nullptr;
  IncrementalPotential energy;
  const auto renew_energy = [&] {
    terms.barrier = barrier(near.pairs());
    energy = make_incremental_potential(terms, step.weights);
  };
  renew_energy();

  NewtonStepper newton(patch.free, mesh_.num_gel_vertices, terms.elasticity, settings_.linear_solver);
  if (!step.friction) newton.set_tolerance(kSolveWithoutFriction);
  const double shortest = (step.friction ? kPatchTolerance : kPatchToleranceWithoutFriction) * found->others_m;
  const Positions still = Positions::Zero(step.x.rows(), 3);
  Blend blend = step.blend;
  const int most = std::min(kMaxIterations, static_cast<int>(kMostWork * free.size() / patch.free.size()));
  // Vertices outside have no way, and are where they are, in all of these.
  const std::vector<int>& inside = patch.free.vertex_of_free;
  Positions p = still, trial = step.x;
  const auto go = [&](double part) {
    for (const int v : inside) trial.row(v) = step.x.row(v) + part * p.row(v);
  };
  // Pairs that are added later are too far away to change it.
  double value = energy.value(step.x);
  const double value_before = value;
  int iterations = 0;
  for (; iterations < most; ++iterations) {
    const NewtonDirection local = newton.direction({energy, step.x, still}, blend);
    const double longest = largest_row(local.p, local.p.rows());
    const bool exact = local.largest_share == 0.0 || !settings_.newton.adaptive_contact_hessian;
    if (longest < shortest && (exact || found->others_m > tolerance)) break;
    const double alpha = near.part_within_reach(step.x, local.p);
    for (const int v : inside) p.row(v) = alpha * local.p.row(v);
    go(1.0);
    if (near.extend_to(trial)) renew_energy();
    const double limit = std::min(contact_step_limit(near.pairs(), step.x, p, gap_rule(kNewtonSlack)),
                                  inversion_step_limit(patch.tets, step.x, p));
    const double rounding = kEnergyRounding * std::abs(value);
    double part = limit, after = value;
    const auto decreases = [&] {
      go(part);
      after = energy.value(trial);
      return after <= value + kSufficientDecrease * part * alpha * local.slope + rounding;
    };
    int halvings = 0;
    for (; !decreases() && halvings < kMaxHalvings; ++halvings) part *= 0.5;
    if (halvings == kMaxHalvings) break;
    value = after;
    for (const int v : inside) step.x.row(v) = trial.row(v);
    if (halvings > 0) raise_shares_of_farthest(local.p.topRows(blend.size()), blend);
    log_debug("    patch {:3d}: alpha {:.3g} (limit {:.3g}) step {:.3e} m/s blend {:.3g}", iterations + 1, part * alpha,
              limit, longest / h, local.largest_share);
  }
  step.report.patch_iterations += iterations;
  ++step.report.patches;
  log_debug("  patch of {} vertices ({} moved): {} iterations", patch.free.size(), found->vertices.size(), iterations);
  if (found->approximated) {
    for (const int v : patch.free.vertex_of_free) step.blend.take_over(v, blend);
  }
  if (iterations == 0) return std::nullopt;
  pairs = with_patch(std::move(pairs), patch.moves, near.pairs());
  return value - value_before;
}

}  // namespace tacipc
