#include "stages/gel/press/contact/patch_search.h"

#include <algorithm>
#include <cmath>

#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/search_tools.h"

namespace tacipc {
namespace {

constexpr double kDistanceRounding = 1e-5;
constexpr double kSpareTravel = 1.5;                       // factor on the displacement
constexpr double kSpareReach = 3.0, kShortestReach = 0.2;  // factors on the step and on the longest reach
// Fraction of the reach: once a vertex leaves its reach, vertices beyond this fraction of theirs are also searched
// again.
constexpr double kUsedUp = 0.5;

}  // namespace

PatchSearch::PatchSearch(ContactSearch& search, const std::vector<int>& vertices, int num_gel_vertices,
                         const Positions& x, const Positions& p, double within_m, double longest_reach_m)
    : search_(search),
      vertices_(vertices),
      num_gel_vertices_(num_gel_vertices),
      within_m_(within_m),
      longest_reach_m_(longest_reach_m),
      searched_at_(x),
      reach_m_(static_cast<std::size_t>(x.rows()), 0.0),
      travel_m_(reach_m_) {
  search_around(vertices, x, p);
  extend_to(x);
}

void PatchSearch::search_around(const std::vector<int>& some, const Positions& x, const Positions& p) {
  std::vector<char> wanted(reach_m_.size(), 0);
  for (const int v : some) {
    const auto i = static_cast<std::size_t>(v);
    wanted[i] = 1;
    searched_at_.row(v) = x.row(v);
    reach_m_[i] = std::clamp(kSpareReach * p.row(v).norm(), kShortestReach * longest_reach_m_, longest_reach_m_);
    travel_m_[i] = -1.0;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < in_reach_.size(); ++i) {
    if (has_one(wanted, in_reach_[i].vertices)) continue;
    in_reach_[kept] = in_reach_[i];
    needed_m_[kept++] = needed_m_[i];
  }
  in_reach_.erase(in_reach_.begin() + static_cast<std::ptrdiff_t>(kept), in_reach_.end());
  needed_m_.resize(kept);
  const std::vector<ContactPair> found = search_.pairs_around(wanted, reach_m_, searched_at_, within_m_);
  const std::vector<double> squared = coarse_squared_distances(found, searched_at_);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& v = found[i].vertices;
    const double both = *std::max_element(v.begin(), v.end()) < num_gel_vertices_ ? 2.0 : 1.0;
    const double needed = ((1.0 - kDistanceRounding) * std::sqrt(squared[i]) - within_m_) / both;
    if (needed > farthest_reach(reach_m_, v)) continue;
    in_reach_.push_back(found[i]);
    needed_m_.push_back(needed);
  }
}

double PatchSearch::part_within_known_reach(const Positions& x, const Positions& p) const {
  double alpha = 1.0;
  for (const int v : vertices_) {
    const double reach = reach_m_[static_cast<std::size_t>(v)];
    const Eigen::RowVector3d from = x.row(v) - searched_at_.row(v), step = p.row(v);
    if ((from + alpha * step).squaredNorm() <= reach * reach) continue;
    // Solve |from + α step|² = reach² for α.
    const double a = step.squaredNorm(), b = from.dot(step), c = from.squaredNorm() - reach * reach;
    alpha = std::clamp((std::sqrt(std::max(0.0, b * b - a * c)) - b) / a, 0.0, alpha);
  }
  return alpha;
}

double PatchSearch::part_within_reach(const Positions& x, const Positions& p) {
  const double part = part_within_known_reach(x, p);
  if (part == 1.0) return part;
  std::vector<int> far;
  for (const int v : vertices_) {
    if ((x.row(v) + p.row(v) - searched_at_.row(v)).norm() > kUsedUp * reach_m_[static_cast<std::size_t>(v)])
      far.push_back(v);
  }
  search_around(far, x, p);
  return part_within_known_reach(x, p);
}

bool PatchSearch::extend_to(const Positions& x) {
  bool any = false;
  for (const int v : vertices_) {
    double& travel = travel_m_[static_cast<std::size_t>(v)];
    const double way = (x.row(v) - searched_at_.row(v)).norm();
    if (way <= travel) continue;
    travel = kSpareTravel * way;
    any = true;
  }
  if (!any) return false;
  pairs_.clear();
  for (std::size_t i = 0; i < in_reach_.size(); ++i) {
    if (needed_m_[i] <= farthest_reach(travel_m_, in_reach_[i].vertices)) pairs_.push_back(in_reach_[i]);
  }
  return true;
}

}  // namespace tacipc
