#include "stages/gel/tetmesh/delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "common/base/error.h"

namespace tacipc {
namespace {

__extension__ using Int128 = __int128;
constexpr int kGhost = -1;
constexpr double kGridHalf = 1 << 27;  // coordinates within ±2²⁷: the in-circle determinant stays below 2¹²⁰

struct GridPoint {
  std::int64_t x, y;
  bool operator==(const GridPoint&) const = default;
};

/// Sign of det[b − a, c − a]: positive if a, b, c turn left.
int turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const std::int64_t det = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return (det > 0) - (det < 0);
}

/// Whether d lies strictly inside the circle through a, b, c. \pre a, b, c turn left
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto minor = [&](const GridPoint& p, const GridPoint& q, const GridPoint& r) {
    const std::int64_t px = p.x - d.x, py = p.y - d.y;
    const std::int64_t cross = (q.x - d.x) * (r.y - d.y) - (q.y - d.y) * (r.x - d.x);
    return static_cast<Int128>(px * px + py * py) * cross;
  };
  return minor(a, b, c) + minor(b, c, a) + minor(c, a, b) > 0;
}

struct Triangle {
  std::array<int, 3> vertex;  // counter-clockwise; a ghost's third is kGhost, its edge 0 → 1 has the hull on the right
  std::array<int, 3> neighbour;  // across the edge opposite the vertex
  bool alive = true;
};

class Triangulation {
 public:
  explicit Triangulation(std::vector<GridPoint> points) : points_(std::move(points)) {}

  void start(int a, int b, int c) {
    if (turn(points_[a], points_[b], points_[c]) < 0) std::swap(b, c);
    triangles_ = {
        {{a, b, c}, {2, 3, 1}}, {{b, a, kGhost}, {3, 2, 0}}, {{c, b, kGhost}, {1, 3, 0}}, {{a, c, kGhost}, {2, 1, 0}}};
    last_ = 0;
  }

  void insert(int p) {
    const int first = locate(p);
    cavity_.assign(1, first);
    triangles_[first].alive = false;
    rim_.clear();
    for (std::size_t i = 0; i < cavity_.size(); ++i) {
      const Triangle t = triangles_[cavity_[i]];
      for (int e = 0; e < 3; ++e) {
        const int next = t.neighbour[e];
        if (!triangles_[next].alive) continue;
        if (in_conflict(triangles_[next], p)) {
          triangles_[next].alive = false;
          cavity_.push_back(next);
        }
      }
    }
    for (const int dead : cavity_) {
      const Triangle& t = triangles_[dead];
      for (int e = 0; e < 3; ++e) {
        if (triangles_[t.neighbour[e]].alive)
          rim_.push_back({t.vertex[(e + 1) % 3], t.vertex[(e + 2) % 3], t.neighbour[e]});
      }
    }
    fill(p);
  }

  Triangles result() const {
    Triangles out(static_cast<Eigen::Index>(triangles_.size()), 3);
    Eigen::Index count = 0;
    for (const Triangle& t : triangles_) {
      if (t.alive && t.vertex[2] != kGhost) out.row(count++) << t.vertex[0], t.vertex[1], t.vertex[2];
    }
    out.conservativeResize(count, 3);
    return out;
  }

 private:
  struct RimEdge {
    int from, to, outside;
  };

  bool in_conflict(const Triangle& t, int p) const {
    const GridPoint &a = points_[t.vertex[0]], &b = points_[t.vertex[1]], &q = points_[p];
    if (t.vertex[2] != kGhost) return in_circle(a, b, points_[t.vertex[2]], q);
    const int side = turn(a, b, q);
    if (side != 0) return side > 0;
    return (q.x - a.x) * (q.x - b.x) + (q.y - a.y) * (q.y - b.y) < 0;  // on the hull edge itself
  }

  /// A triangle in conflict with p: the one that contains p, or the ghost through whose hull edge the segment to p
  /// passes.
  int locate(int p) const {
    int t = last_;
    if (triangles_[t].vertex[2] == kGhost) t = triangles_[t].neighbour[2];
    for (;;) {
      const Triangle& now = triangles_[t];
      if (now.vertex[2] == kGhost) return t;
      int next = t;
      for (int e = 0; e < 3 && next == t; ++e) {
        if (turn(points_[now.vertex[(e + 1) % 3]], points_[now.vertex[(e + 2) % 3]], points_[p]) < 0) {
          next = now.neighbour[e];
        }
      }
      if (next == t) {
        for (const int v : now.vertex) {
          if (points_[v] == points_[p]) throw DataError("two points of a face coincide (points {} and {})", v, p);
        }
        return t;
      }
      t = next;
    }
  }

  /// Joins every rim edge to p. Ghost vertices stay third; freed entries are reused.
  void fill(int p) {
    std::vector<int> made;
    std::size_t reuse = 0;
    for (const RimEdge& edge : rim_) {
      int place;
      if (reuse < cavity_.size()) {
        place = cavity_[reuse++];
      } else {
        place = static_cast<int>(triangles_.size());
        triangles_.emplace_back();
      }
      Triangle t{{edge.from, edge.to, p}, {-1, -1, edge.outside}};
      if (edge.from == kGhost) t = {{edge.to, p, kGhost}, {-1, edge.outside, -1}};
      if (edge.to == kGhost) t = {{p, edge.from, kGhost}, {edge.outside, -1, -1}};
      triangles_[place] = t;
      for (int& back : triangles_[edge.outside].neighbour) {
        const Triangle& outside = triangles_[edge.outside];
        const auto e = static_cast<std::size_t>(&back - outside.neighbour.data());
        if (outside.vertex[(e + 1) % 3] == edge.to && outside.vertex[(e + 2) % 3] == edge.from) back = place;
      }
      made.push_back(place);
    }
    for (const int t : made) {
      for (int e = 0; e < 3; ++e) {
        if (triangles_[t].neighbour[e] >= 0) continue;
        const int from = triangles_[t].vertex[(e + 1) % 3], to = triangles_[t].vertex[(e + 2) % 3];
        for (const int other : made) {
          for (int f = 0; f < 3; ++f) {
            const Triangle& o = triangles_[other];
            if (o.vertex[(f + 1) % 3] == to && o.vertex[(f + 2) % 3] == from) triangles_[t].neighbour[e] = other;
          }
        }
      }
    }
    last_ = made.front();
  }

  std::vector<GridPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> cavity_;
  std::vector<RimEdge> rim_;
  int last_ = 0;
};

std::vector<GridPoint> to_grid(const std::vector<Vector2>& points) {
  Vector2 low = points.front(), high = points.front();
  for (const Vector2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector2 middle = (low + high) / 2.0;
  const double scale = kGridHalf / std::max(1e-300, (high - low).maxCoeff() / 2.0);
  std::vector<GridPoint> grid;
  grid.reserve(points.size());
  for (const Vector2& p : points) {
    grid.push_back({std::llround((p.x() - middle.x()) * scale), std::llround((p.y() - middle.y()) * scale)});
  }
  return grid;
}

/// Order of insertion: strips in alternating directions, so that each point is near the previous one and walks are
/// short.
std::vector<int> strip_order(const std::vector<GridPoint>& grid) {
  const auto strips = static_cast<std::int64_t>(std::sqrt(static_cast<double>(grid.size())) / 2.0) + 1;
  const auto strip = [&](const GridPoint& p) {
    return (p.y + static_cast<std::int64_t>(kGridHalf)) * strips / (2 * static_cast<std::int64_t>(kGridHalf) + 1);
  };
  std::vector<int> order(grid.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const std::int64_t sa = strip(grid[a]), sb = strip(grid[b]);
    if (sa != sb) return sa < sb;
    if (grid[a].x != grid[b].x) return (grid[a].x < grid[b].x) == (sa % 2 == 0);
    return a < b;
  });
  return order;
}

}  // namespace

Triangles delaunay(const std::vector<Vector2>& points) {
  if (points.size() < 3) throw DataError("{} points have no triangulation", points.size());
  const std::vector<GridPoint> grid = to_grid(points);
  std::vector<int> order = strip_order(grid);
  std::size_t third = 2;
  while (third < order.size() && turn(grid[order[0]], grid[order[1]], grid[order[third]]) == 0) ++third;
  if (third == order.size()) throw DataError("all {} points of a face lie on one line", points.size());
  std::rotate(order.begin() + 2, order.begin() + static_cast<std::ptrdiff_t>(third),
              order.begin() + static_cast<std::ptrdiff_t>(third) + 1);
  Triangulation triangulation(grid);
  triangulation.start(order[0], order[1], order[2]);
  for (std::size_t i = 3; i < order.size(); ++i) triangulation.insert(order[i]);
  return triangulation.result();
}

}  // namespace tacipc
