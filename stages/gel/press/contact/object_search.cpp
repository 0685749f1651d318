#include "stages/gel/press/contact/object_search.h"

#include <cmath>

#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/search_tools.h"

namespace tacipc {
namespace {

constexpr double kExtraMargin = 0.5;     // × the search distance: margin beyond the need of the call itself
constexpr double kFloatRounding = 1e-5;  // relative rounding of distances stored as floats

/// Largest squared distance of rows of `x` from `searched_at`.
template <std::size_t Vertices>
double largest_squared(const std::array<Vector3, Vertices>& searched_at, const Positions& x,
                       const std::array<int, Vertices>& vertices) {
  double largest = 0.0;
  for (std::size_t k = 0; k < Vertices; ++k)
    largest = std::max(largest, (x.row(vertices[k]).transpose() - searched_at[k]).squaredNorm());
  return largest;
}

double largest_row_norm(const auto& rows) { return std::sqrt(rows.rowwise().squaredNorm().maxCoeff()); }

}  // namespace

template <int Vertices>
void ObjectSearch::Tracked<Vertices>::resize(std::size_t count) {
  searched_at.resize(count);
  near.resize(count);
  margin_m.resize(count);
}

template <int Vertices>
void ObjectSearch::Tracked<Vertices>::forget() {
  std::fill(margin_m.begin(), margin_m.end(), -1.0);
}

ObjectSearch::ObjectSearch(const ContactMesh& mesh, const ObjectPart& object)
    : mesh_(mesh),
      object_(object),
      vertices_(boxes_at(OneVertex{object.surface.vertices}, mesh.rest_positions)),
      edges_(boxes_at(object.surface.edges, mesh.rest_positions)),
      triangles_(boxes_at(object.surface.triangles, mesh.rest_positions)) {
  gel_vertices_.resize(mesh.gel.vertices.size());
  gel_edges_.resize(mesh.gel.edges.size());
  gel_triangles_.resize(mesh.gel.triangles.size());
}

/// Fits the trees to the object's rows of `start`, and discards all earlier searches.
void ObjectSearch::place_object(const Positions& start) {
  object_at_ = object_.rows(start);
  vertices_.refit(boxes_at(OneVertex{object_.surface.vertices}, start));
  edges_.refit(boxes_at(object_.surface.edges, start));
  triangles_.refit(boxes_at(object_.surface.triangles, start));
  gel_vertices_.forget();
  gel_edges_.forget();
  gel_triangles_.forget();
}

template <int Vertices, typename Primitives, typename PairOf>
void ObjectSearch::track(const Primitives& gel, const Bvh& object, const Moment& moment, PairOf&& pair_of,
                         Tracked<Vertices>& all, std::vector<ContactPair>& out) {
  collect(gel.size(), out, [&](std::size_t first, std::size_t last, std::vector<ContactPair>& found) {
    std::vector<ContactPair> candidates, in_reach;
    std::vector<int> others;
    for (std::size_t i = first; i < last; ++i) {
      const std::array<int, Vertices> v = gel[i];
      const auto travel_of = [&] {
        return moment.object_moved_m + std::sqrt(std::max(largest_squared(all.searched_at[i], moment.start, v),
                                                          largest_squared(all.searched_at[i], moment.end, v)));
      };
      double travel = all.margin_m[i] < 0.0 ? 0.0 : travel_of();
      if (!(travel <= all.margin_m[i])) {
        for (int k = 0; k < Vertices; ++k) all.searched_at[i][k] = moment.start.row(v[k]);
        travel = travel_of();
        all.margin_m[i] = travel + kExtraMargin * moment.within_m;
        const double reach = moment.within_m + all.margin_m[i];
        candidates.clear();
        others.clear();
        object.query(grown(box_around(moment.start, v), reach), [&](int j) {
          candidates.push_back(pair_of(static_cast<int>(i), j));
          others.push_back(j);
        });
        const std::vector<double> squared = coarse_squared_distances(candidates, moment.start);
        all.near[i].clear();
        for (std::size_t k = 0; k < others.size(); ++k) {
          const double distance = std::sqrt(squared[k]);
          if (distance <= (1.0 + kFloatRounding) * reach)
            all.near[i].push_back({others[k], static_cast<float>(distance)});
        }
        num_searches_.fetch_add(1, std::memory_order_relaxed);
      }
      const double within = (1.0 + kFloatRounding) * (moment.within_m + travel);
      for (const Near& near : all.near[i]) {
        if (near.distance_m <= within) in_reach.push_back(pair_of(static_cast<int>(i), near.other));
      }
    }
    // The remaining candidates are used several times.
    for_each_coming_near(
        in_reach, 0, in_reach.size(), [&](std::size_t /*pair*/) { return moment.within_m; }, moment.x, moment.p,
        [&](std::size_t i) { found.push_back(in_reach[i]); });
  });
}

void ObjectSearch::pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) {
  const int n = object_.first_vertex;
  const Eigen::RowVector3d origin = x.row(n), shifted = origin + p.row(n);
  Moment moment{.x = x,
                .p = p,
                .start = x.rowwise() - origin,
                .end = (x + p).rowwise() - shifted,
                .within_m = within_m,
                .object_moved_m = 0};
  const auto object_moved = [&] {
    return std::max(largest_row_norm(object_.rows(moment.start) - object_at_),
                    largest_row_norm(object_.rows(moment.end) - object_at_));
  };
  if (within_m == within_m_) moment.object_moved_m = object_moved();
  if (within_m != within_m_ || moment.object_moved_m > kExtraMargin * within_m) {
    place_object(moment.start);
    moment.object_moved_m = object_moved();
  }
  within_m_ = within_m;
  object_moved_m_ = moment.object_moved_m;
  object_.rows(moment.start) = object_at_;

  const Surface &gel = mesh_.gel, &object = object_.surface;
  track(
      OneVertex{gel.vertices}, triangles_, moment,
      [&](int i, int j) { return point_triangle_pair(gel.vertices[i], object.triangles[j]); }, gel_vertices_, out);
  track(
      gel.triangles, vertices_, moment,
      [&](int i, int j) { return point_triangle_pair(object.vertices[j], gel.triangles[i]); }, gel_triangles_, out);
  track(
      gel.edges, edges_, moment, [&](int i, int j) { return edge_edge_pair(gel.edges[i], object.edges[j]); },
      gel_edges_, out);
}

void ObjectSearch::around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x,
                          double within_m, std::vector<ContactPair>& out) const {
  const Vector3 origin = x.row(object_.first_vertex);
  const auto all_of = [&](const auto& primitives, const Bvh& tree, auto&& pair_of) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto& vertices = primitives[i];
      if (!has_one(wanted, vertices)) continue;
      const double reach = farthest_reach(reach_m, vertices);
      const Box box = grown(box_around(x, vertices), within_m + object_moved_m_ + reach).translate(-origin);
      tree.query(box, [&](int j) { out.push_back(pair_of(i, j)); });
    }
  };
  const Surface &gel = mesh_.gel, &object = object_.surface;
  all_of(OneVertex{gel.vertices}, triangles_,
         [&](std::size_t i, int j) { return point_triangle_pair(gel.vertices[i], object.triangles[j]); });
  all_of(gel.triangles, vertices_,
         [&](std::size_t i, int j) { return point_triangle_pair(object.vertices[j], gel.triangles[i]); });
  all_of(gel.edges, edges_, [&](std::size_t i, int j) { return edge_edge_pair(gel.edges[i], object.edges[j]); });
}

}  // namespace tacipc
