// Within a time step: Newton's method for the few vertices that still move.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/base/log.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/search_tools.h"
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
constexpr int kMaxIterations = 20;
// A patch has converged when its Newton step is shorter than this part of the longest step outside it (at least of the
// tolerance), so that the whole gel finds it at rest.
constexpr double kPatchTolerance = 0.2;
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

/// The pairs that a patch can come near to. They are searched up to a reach of each vertex, again where one gets out of
/// it. Of those found only the ones count that come near within a travel of each vertex: most vertices go much less far
/// than the few that the patch is about.
class PatchPairs {
 public:
  /// \pre every vertex of the patch is at x, on its path of the last search
  PatchPairs(const ContactSearch& search, const FreeVertices& patch, const Positions& x, int num_gel_vertices,
             double d_hat_m, double longest_reach_m)
      : search_(search),
        patch_(patch),
        num_gel_vertices_(num_gel_vertices),
        d_hat_m_(d_hat_m),
        longest_reach_m_(longest_reach_m),
        start_(x),
        reach_m_(static_cast<std::size_t>(x.rows()), 0.0),
        travel_m_(reach_m_) {}

  /// Searches at x for the step p and more.
  void search(const Positions& x, const Positions& p) {
    searched_at_ = x;
    std::vector<double> of_search(reach_m_.size(), 0.0);
    for (const int v : patch_.vertex_of_free) {
      const auto i = static_cast<std::size_t>(v);
      reach_m_[i] = std::clamp(kSpareReach * p.row(v).norm(), kShortestReach * longest_reach_m_, longest_reach_m_);
      of_search[i] = reach_m_[i] + (x.row(v) - start_.row(v)).norm();
      travel_m_[i] = 0.0;
    }
    pairs_ = search_.pairs_around(of_search, x, d_hat_m_);
    needed_m_ = coarse_squared_distances(pairs_, x);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto& v = pairs_[i].vertices;
      const double both = *std::max_element(v.begin(), v.end()) < num_gel_vertices_ ? 2.0 : 1.0;
      needed_m_[i] = ((1.0 - kRounding) * std::sqrt(needed_m_[i]) - d_hat_m_) / both;
    }
  }

  /// Largest part of the step p, at most 1, by which every vertex stays within its reach.
  double part_within_reach(const Positions& x, const Positions& p) const {
    double alpha = 1.0;
    for (const int v : patch_.vertex_of_free) {
      const double reach = reach_m_[static_cast<std::size_t>(v)];
      const Eigen::RowVector3d from = x.row(v) - searched_at_.row(v), step = p.row(v);
      if ((from + alpha * step).squaredNorm() <= reach * reach) continue;
      // |from + α step|² = reach²
      const double a = step.squaredNorm(), b = from.dot(step), c = from.squaredNorm() - reach * reach;
      alpha = std::clamp((std::sqrt(std::max(0.0, b * b - a * c)) - b) / a, 0.0, alpha);
    }
    return alpha;
  }

  /// Lengthens the travel of each vertex that has to go farther to be at x. False where none has to.
  bool travel_to(const Positions& x) {
    bool any = false;
    for (const int v : patch_.vertex_of_free) {
      double& travel = travel_m_[static_cast<std::size_t>(v)];
      const double way = (x.row(v) - searched_at_.row(v)).norm();
      if (way <= travel) continue;
      travel = kSpareTravel * way;
      any = true;
    }
    return any;
  }
  std::vector<ContactPair> within_travel() const {
    std::vector<ContactPair> found;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (needed_m_[i] <= farthest_reach(travel_m_, pairs_[i].vertices)) found.push_back(pairs_[i]);
    }
    return found;
  }

 private:
  static constexpr double kRounding = 1e-5;
  static constexpr double kSpareTravel = 1.5;    // × the way to go
  static constexpr double kSpareReach = 3.0;     // × the step
  static constexpr double kShortestReach = 0.2;  // × the longest
  const ContactSearch& search_;
  const FreeVertices& patch_;
  int num_gel_vertices_;
  double d_hat_m_, longest_reach_m_;
  Positions start_, searched_at_;
  std::vector<double> reach_m_, travel_m_;  // per vertex, from where pairs were searched
  std::vector<ContactPair> pairs_;
  std::vector<double> needed_m_;  // travel from which on each counts
};

}  // namespace

bool TimeStepper::relax_patch(Step& step, const NewtonDirection& direction, std::vector<ContactPair>& pairs) {
  if (!settings_.newton.patches || settings_.augmented_lagrangian || !step.goal.free_axes.empty()) return false;
  const double h = step.goal.h_s, tolerance = settings_.newton.velocity_tolerance_m_s * h;
  const Stopwatch watch(times_.patches_s);
  const FreeVertices& free = newton_->free();
  if (free.size() < kFewestVertices) return false;
  std::optional<Seeds> found = farthest(direction.p, free, mesh_.num_gel_vertices, tolerance);
  const bool may_wait = settings_.newton.adaptive_contact_hessian && step.looseness == 1.0;
  if (!found && may_wait && direction.largest_share > 0.0)
    found = approximated(step.blend, direction.p, free, mesh_.num_gel_vertices, tolerance);
  if (!found) return false;

  const LocalPatch patch =
      grow_patch(found->vertices, found->approximated ? kRingsAboutApproximated : kRings, gel_.tets, free);
  const double reach = std::max(kReach * settings_.d_hat_m, kReachOfEdge * settings_.front_edge_m);
  PatchPairs near(search_, patch.free, step.x, mesh_.num_gel_vertices, settings_.d_hat_m, reach);
  near.search(step.x, direction.p);
  StepTerms terms = step.terms;
  for (auto* term : {&terms.inertia, &terms.mass_damping, &terms.stiffness_damping, &terms.gravity,
                     &terms.viscous_memory, &terms.elasticity})
    *term = restricted(*term, patch.moves);
  terms.bodies.clear();  // they are held meanwhile
  terms.friction = step.friction ? step.friction->restricted_to(patch.moves) : nullptr;
  std::vector<ContactPair> own_pairs;
  IncrementalPotential energy;
  const auto collect_pairs = [&] {
    own_pairs = near.within_travel();
    terms.barrier = barrier(own_pairs);
    energy = make_incremental_potential(terms, step.weights);
  };
  collect_pairs();

  NewtonStepper newton(patch.free, mesh_.num_gel_vertices, terms.elasticity, settings_.linear_solver);
  const Positions still = Positions::Zero(step.x.rows(), 3);
  Blend blend = step.blend;
  int iterations = 0;
  for (; iterations < kMaxIterations; ++iterations) {
    const NewtonDirection local = newton.direction({energy, step.x, still}, blend);
    const double longest = std::sqrt(local.p.rowwise().squaredNorm().maxCoeff());
    const bool exact = local.largest_share == 0.0 || !settings_.newton.adaptive_contact_hessian;
    if (longest < kPatchTolerance * found->others_m && (exact || found->others_m > tolerance)) break;
    double alpha = near.part_within_reach(step.x, local.p);
    if (alpha < 1.0) {
      near.search(step.x, local.p);
      alpha = near.part_within_reach(step.x, local.p);
    }
    const Positions p = alpha * local.p;
    if (near.travel_to(step.x + p)) collect_pairs();
    const double limit = std::min(
        contact_step_limit(own_pairs, step.x, p, {kNewtonSlack, kGapFloor * settings_.d_hat_m, settings_.d_hat_m}),
        inversion_step_limit(patch.tets, step.x, p));
    const double before = energy.value(step.x), rounding = kEnergyRounding * std::abs(before);
    double part = limit;
    int halvings = 0;
    Positions trial = step.x + part * p;
    while (!(energy.value(trial) <= before + kSufficientDecrease * part * alpha * local.slope + rounding) &&
           halvings < kMaxHalvings) {
      ++halvings;
      part *= 0.5;
      trial = step.x + part * p;
    }
    if (halvings == kMaxHalvings) break;
    step.x = trial;
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
  if (iterations == 0) return false;
  pairs = with_patch(std::move(pairs), patch.moves, own_pairs);
  return true;
}

}  // namespace tacipc
