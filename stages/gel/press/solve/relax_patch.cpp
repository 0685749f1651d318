#include "stages/gel/press/solve/relax_patch.h"

#include <algorithm>
#include <cmath>

#include "common/base/log.h"
#include "stages/gel/press/contact/patch_search.h"
#include "stages/gel/press/solve/line_search.h"

namespace tacipc {
namespace {

constexpr double kMostSeeds = 0.01;  // largest fraction of the free vertices from which a patch starts
/// Smallest number of free vertices; with fewer a step of the whole gel costs no more than a patch.
constexpr int kFewestVertices = 400;
// If more vertices move, the farthest seed must move this many times as far as any other vertex.
constexpr double kStandOut = 3.0;
// Once no step is longer than kNearRest × the tolerance, a patch starts from the vertices with an approximated contact
// Hessian, if they are at most kMostApproximated of the free vertices. The region that makes the Hessian indefinite is
// wider than one ring.
constexpr double kNearRest = 20.0, kMostApproximated = 0.015;
constexpr int kRings = 1, kRingsAboutApproximated = 3;
// Without friction, a snapping vertex pulls the surrounding gel with it. Patches of at least kLeastWithoutFriction of
// the free vertices, with a limited number of rings, save a fifth of the steps of the whole gel.
constexpr double kLeastWithoutFriction = 0.09;
constexpr int kMostRingsWithoutFriction = 4;
constexpr int kMaxPatchIterations = 20;
// Limit of iterations × vertices of a patch, × the number of free vertices: a wide patch that does not settle soon is
// left to steps of the whole gel.
constexpr double kMostWork = 2.0;
// A patch has converged when its Newton step is shorter than this fraction of the longest step outside it (at least of
// the tolerance), so that it is at rest for the whole gel. Without friction this rarely holds.
constexpr double kPatchTolerance = 0.2, kPatchToleranceWithoutFriction = 1.0;
constexpr double kSolveWithoutFriction = 1e-2;  // tolerance of the linear solver without friction
constexpr int kMaxPatchHalvings = 20;
// Displacement of a patch vertex after which pairs are searched again: × d̂, or × the median edge of the front,
// whichever is larger.
constexpr double kReach = 1.0, kReachOfEdge = 0.4;

/// Vertices from which a patch starts.
struct Seeds {
  std::vector<int> vertices;
  double others_m;            // longest displacement of all other vertices, at least the tolerance
  bool approximated = false;  // the seeds are the vertices with an approximated contact Hessian
};

/// Gel vertices that move farther than all others. Nothing if no displacement is above the tolerance, or if too many
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

/// Gel vertices at which the last direction used the PSD approximation, if only these prevent a gel at rest from being
/// final: they are on the crest of an edge and move down from it slowly with the approximation.
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

/// Seeds of a patch after this direction; nothing if there is no reason for a patch.
std::optional<Seeds> seeds_of(const SolverModel& model, const Step& step, const NewtonDirection& direction) {
  const NewtonSettings& settings = model.settings.newton;
  if (!settings.patches || model.settings.augmented_lagrangian || !step.goal.free_axes.empty()) return std::nullopt;
  const FreeVertices& free = step.newton.free();
  if (free.size() < kFewestVertices) return std::nullopt;
  const double tolerance_m = settings.velocity_tolerance_m_s * step.goal.h_s;
  const int num_gel_vertices = model.mesh.num_gel_vertices;
  if (auto found = farthest(direction.p, free, num_gel_vertices, tolerance_m)) return found;
  if (!settings.adaptive_contact_hessian || step.looseness != 1.0 || direction.largest_share == 0.0)
    return std::nullopt;
  return approximated(step.blend, direction.p, free, num_gel_vertices, tolerance_m);
}

PatchSize size_of(const Seeds& seeds, const Step& step) {
  PatchSize size{seeds.approximated ? kRingsAboutApproximated : kRings};
  if (!step.friction) {
    size.fewest_vertices = static_cast<int>(kLeastWithoutFriction * step.newton.free().size());
    size.most_rings = kMostRingsWithoutFriction;
  }
  return size;
}

/// Newton's method for one patch; moves the patch's vertices in the step's x.
class PatchRun {
 public:
  PatchRun(const SolverModel& model, CollisionDetector& detector, const LocalPatch& patch, const Positions& p,
           Step& step)
      : model_(model),
        detector_(detector),
        patch_(patch),
        step_(step),
        near_(detector.search(), patch.free.vertex_of_free, model.mesh.num_gel_vertices, step.x, p,
              model.settings.laws.reach_m(),
              std::max(kReach * model.settings.laws.reach_m(), kReachOfEdge * model.settings.front_edge_m)),
        terms_(step.terms),
        blend_(step.blend),
        p_(Positions::Zero(step.x.rows(), 3)),
        trial_(step.x) {
    for (auto* term : {&terms_.inertia, &terms_.mass_damping, &terms_.stiffness_damping, &terms_.gravity,
                       &terms_.viscous_memory, &terms_.elasticity})
      *term = restricted(*term, patch.moves);
    terms_.bodies.clear();  // bodies are held while a patch is solved
    terms_.friction = step.friction ? step.friction->restricted_to(patch.moves) : nullptr;
    renew_energy();
    newton_.emplace(patch.free, model.mesh.num_gel_vertices, terms_.elasticity, model.settings.linear_solver);
    if (!step.friction) newton_->set_tolerance(kSolveWithoutFriction);
    // Pairs that are added later are too far away to change the energy.
    value_ = value_before_ = energy_.value(step.x);
  }

  /// Iterates until a Newton step is shorter than `shortest_m`, with the exact Hessian unless `approximated` is true.
  /// \return number of iterations that moved the patch
  int minimise(double shortest_m, bool approximated) {
    const Positions still = Positions::Zero(step_.x.rows(), 3);
    const int most =
        std::min(kMaxPatchIterations, static_cast<int>(kMostWork * step_.newton.free().size() / patch_.free.size()));
    int iterations = 0;
    for (; iterations < most; ++iterations) {
      const NewtonDirection local = newton_->direction({energy_, step_.x, still}, blend_);
      const double longest = largest_row(local.p, local.p.rows());
      const bool exact = local.largest_share == 0.0 || !model_.settings.newton.adaptive_contact_hessian;
      if (longest < shortest_m && (exact || approximated)) break;
      const std::optional<Taken> taken = take(local);
      if (!taken) break;
      log_debug("    patch {:3d}: alpha {:.3g} (limit {:.3g}) step {:.3e} m/s blend {:.3g}", iterations + 1,
                taken->alpha, taken->limit, longest / step_.goal.h_s, local.largest_share);
    }
    return iterations;
  }

  double change() const { return value_ - value_before_; }
  const Blend& blend() const { return blend_; }
  const std::vector<ContactPair>& pairs() const { return near_.pairs(); }

 private:
  struct Taken {
    double alpha, limit;  // fraction of the direction that is taken, and fraction that reach and contact allow
  };

  void renew_energy() {
    terms_.barrier = model_.barrier(near_.pairs());
    energy_ = make_incremental_potential(terms_, step_.weights);
  }

  /// Moves the patch in `trial_` to this fraction of `p_`; vertices outside do not change.
  void go(double part) {
    for (const int v : patch_.free.vertex_of_free) trial_.row(v) = step_.x.row(v) + part * p_.row(v);
  }

  /// Moves the patch along a direction as far as the energy decreases; nothing, with the patch unmoved, if it does not.
  std::optional<Taken> take(const NewtonDirection& local) {
    const std::vector<int>& inside = patch_.free.vertex_of_free;
    const double alpha = near_.part_within_reach(step_.x, local.p);
    for (const int v : inside) p_.row(v) = alpha * local.p.row(v);
    go(1.0);
    if (near_.extend_to(trial_)) renew_energy();
    const double limit = std::min(contact_step_limit(near_.pairs(), step_.x, p_, detector_.gap_rule(kNewtonSlack)),
                                  inversion_step_limit(patch_.tets, step_.x, p_));
    const double rounding = kEnergyRounding * std::abs(value_);
    double part = limit, after = value_;
    const auto decreases = [&] {
      go(part);
      after = energy_.value(trial_);
      return after <= value_ + kSufficientDecrease * part * alpha * local.slope + rounding;
    };
    int halvings = 0;
    for (; !decreases() && halvings < kMaxPatchHalvings; ++halvings) part *= 0.5;
    if (halvings == kMaxPatchHalvings) return std::nullopt;
    value_ = after;
    for (const int v : inside) step_.x.row(v) = trial_.row(v);
    if (halvings > 0) raise_shares_of_farthest(local.p.topRows(blend_.size()), blend_);
    return Taken{part * alpha, limit};
  }

  const SolverModel& model_;
  CollisionDetector& detector_;
  const LocalPatch& patch_;
  Step& step_;
  PatchSearch near_;
  StepTerms terms_;
  IncrementalPotential energy_;
  std::optional<NewtonStepper> newton_;
  Blend blend_;
  Positions p_, trial_;
  double value_ = 0.0, value_before_ = 0.0;
};

}  // namespace

std::optional<double> PatchSolver::relax(Step& step, const NewtonDirection& direction,
                                         std::vector<ContactPair>& pairs) {
  const Stopwatch watch(times_.patches_s);
  const std::optional<Seeds> seeds = seeds_of(model_, step, direction);
  if (!seeds) return std::nullopt;
  const LocalPatch patch =
      grow_patch(seeds->vertices, size_of(*seeds, step), model_.gel.tets, tets_of_, step.newton.free());
  PatchRun run(model_, detector_, patch, direction.p, step);
  const double tolerance_m = model_.settings.newton.velocity_tolerance_m_s * step.goal.h_s;
  const double shortest_m = (step.friction ? kPatchTolerance : kPatchToleranceWithoutFriction) * seeds->others_m;
  const int iterations = run.minimise(shortest_m, seeds->others_m > tolerance_m);
  step.report.patch_iterations += iterations;
  ++step.report.patches;
  log_debug("  patch of {} vertices ({} moved): {} iterations", patch.free.size(), seeds->vertices.size(), iterations);
  if (seeds->approximated) {
    for (const int v : patch.free.vertex_of_free) step.blend.take_over(v, run.blend());
  }
  if (iterations == 0) return std::nullopt;
  pairs = with_patch(std::move(pairs), patch.moves, run.pairs());
  return run.change();
}

}  // namespace tacipc
