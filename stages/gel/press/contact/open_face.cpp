#include "stages/gel/press/contact/open_face.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace tacipc {
namespace {

constexpr double kLevel = 1e-9;        // tolerance of the face's level, × its size
constexpr double kLeast = 0.5 + 1e-6;  // c, with a margin for rounding of positions and of a convex outline
constexpr double kAngleError = 1e-6, kRounding = 1e-6;
constexpr double kMuchNearer = 0.95;  // a bound is refined while it falls below this fraction of the last one

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Whether the triangles (counter-clockwise, seen along −z) have a single outline that turns left only, once around.
bool is_convex(const std::vector<std::array<int, 3>>& triangles, const Positions& at) {
  std::map<std::array<int, 2>, int> edges;  // directed; edges without a reverse form the outline
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  std::map<int, int> next;
  for (const auto& [edge, count] : edges) {
    if (count > 1) return false;
    if (edges.contains({edge[1], edge[0]})) continue;
    if (!next.emplace(edge[0], edge[1]).second) return false;
  }
  if (next.empty()) return false;
  double turned = 0.0;
  std::size_t steps = 0;
  int v = next.begin()->first;
  do {
    const auto on = next.find(v);
    const auto after = on == next.end() ? next.end() : next.find(on->second);
    if (after == next.end()) return false;
    const Point a = (at.row(on->second) - at.row(v)).head<2>(),
                b = (at.row(after->second) - at.row(on->second)).head<2>();
    const double angle = std::atan2(cross(a, b), a.dot(b));
    if (angle < -kLevel) return false;
    turned += angle;
    v = on->second;
    ++steps;
  } while (v != next.begin()->first && steps <= next.size());
  return steps == next.size() && std::abs(turned - 2.0 * std::numbers::pi) < kAngleError;
}

}  // namespace

OpenFace::OpenFace(const ContactMesh& mesh)
    : mesh_(mesh), on_face_(static_cast<std::size_t>(mesh.num_vertices()), false) {
  if (mesh.gel.vertices.empty()) return;
  const Positions& rest = mesh.rest_positions;
  double top = rest(mesh.gel.vertices[0], 2);
  Point low = rest.row(mesh.gel.vertices[0]).head<2>(), high = low;
  for (const int v : mesh.gel.vertices) {
    top = std::max(top, rest(v, 2));
    low = low.cwiseMin(rest.row(v).head<2>().transpose());
    high = high.cwiseMax(rest.row(v).head<2>().transpose());
  }
  const double level = top - kLevel * (high - low).norm();
  std::vector<std::array<int, 3>> face;
  for (const auto& t : mesh.gel.triangles) {
    if (std::all_of(t.begin(), t.end(), [&](int v) { return rest(v, 2) >= level; })) face.push_back(t);
  }
  if (!is_convex(face, rest)) return;
  for (const auto& t : face) {
    Eigen::Matrix2d edges;
    for (int k = 0; k < 2; ++k) edges.col(k) = (rest.row(t[k + 1]) - rest.row(t[0])).head<2>();
    if (!(edges.determinant() > 0.0)) {
      triangles_.clear();
      return;
    }
    triangles_.push_back({t, edges.inverse(), {}});
  }
  for (const auto& t : face) {
    for (const int v : t) on_face_[static_cast<std::size_t>(v)] = true;
  }
  for (const int v : mesh.gel.vertices) {
    if (has(v)) outline_.extend(Point(rest.row(v).head<2>()));
  }
  for (Triangle& triangle : triangles_) triangle.squares = squares_around(triangle.vertices);
}

/// Ranges of the sideways displacements of the face from rest, for blocks of 2 × 2 squares, 4 × 4, and so on.
class OpenFace::Ways {
 public:
  Ways(const OpenFace& face, const Positions& x) {
    std::vector<Range>& finest = levels_[0];
    finest.resize(kSide * kSide, kNone);
    const Positions& rest = face.mesh_.rest_positions;
    for (const Triangle& triangle : face.triangles_) {
      Range range = kNone;
      for (const int v : triangle.vertices) {
        const double right = x(v, 0) - rest(v, 0), up = x(v, 1) - rest(v, 1);
        join(range, {right, up, -right, -up});
      }
      const Squares& at = triangle.squares;
      for (int j = at.low / 2; j <= at.high / 2; ++j) {
        for (int i = at.left / 2; i <= at.right / 2; ++i) join(finest[static_cast<std::size_t>(j * kSide + i)], range);
      }
    }
    for (int level = 1; level < kLevels; ++level) {
      const int side = kSide >> level;
      levels_[level].resize(static_cast<std::size_t>(side * side), kNone);
      for (int j = 0; j < 2 * side; ++j) {
        for (int i = 0; i < 2 * side; ++i)
          join(levels_[level][static_cast<std::size_t>(j / 2 * side + i / 2)],
               levels_[level - 1][static_cast<std::size_t>(j * 2 * side + i)]);
      }
    }
  }

  /// Upper bound of the difference between the displacements of two points in these squares, m.
  double difference(const Squares& at) const {
    int level = 0;
    while (std::max(at.right - at.left, at.high - at.low) >> (level + 1) > kMostAcross && level + 1 < kLevels) ++level;
    const int shift = level + 1, side = kSide >> level;
    Range range = kNone;
    for (int j = at.low >> shift; j <= at.high >> shift; ++j) {
      for (int i = at.left >> shift; i <= at.right >> shift; ++i)
        join(range, levels_[level][static_cast<std::size_t>(j * side + i)]);
    }
    return std::hypot(-range[2] - range[0], -range[3] - range[1]);
  }

 private:
  // Smallest displacements to the right, up, left and down.
  using Range = std::array<double, 4>;
  static constexpr int kSide = kSquares / 2, kLevels = 7, kMostAcross = 3;
  static constexpr double kBeyond = std::numeric_limits<double>::infinity();
  static constexpr Range kNone{kBeyond, kBeyond, kBeyond, kBeyond};
  static void join(Range& a, const Range& b) {
    for (std::size_t k = 0; k < 4; ++k) a[k] = b[k] < a[k] ? b[k] : a[k];
  }

  std::array<std::vector<Range>, kLevels> levels_;
};

OpenFace::Squares OpenFace::squares(const Eigen::AlignedBox2d& box) const {
  const auto square = [&](double at, int axis) {
    const double scale = kSquares / outline_.sizes()[axis];
    return static_cast<std::uint8_t>(std::clamp((at - outline_.min()[axis]) * scale, 0.0, kSquares - 1.0));
  };
  return {square(box.min().x(), 0), square(box.max().x(), 0), square(box.min().y(), 1), square(box.max().y(), 1)};
}

bool OpenFace::Places::within(const Places& other) const {
  if (none() || other.none()) return none();
  for (std::size_t i = 0; i < in_.size(); ++i)
    if (in_[i] && !other.in_[i]) return false;
  return true;
}

OpenFace::Places OpenFace::at_risk(const Positions& x, const Positions& p, double within_m) const {
  const auto open = [](const Eigen::Matrix2d& gradient) {
    const double mean = 0.5 * (gradient(0, 0) + gradient(1, 1)) - kLeast;
    const double difference = 0.5 * (gradient(0, 0) - gradient(1, 1));
    const double mixed = 0.5 * (gradient(0, 1) + gradient(1, 0));
    return mean >= 0.0 && mean * mean >= difference * difference + mixed * mixed;
  };
  Places out;
  std::vector<const Triangle*> failing;
  for (const Triangle& triangle : triangles_) {
    const auto& v = triangle.vertices;
    Eigen::Matrix2d start, change;
    for (int k = 0; k < 2; ++k) {
      start.col(k) = (x.row(v[k + 1]) - x.row(v[0])).head<2>();
      change.col(k) = (p.row(v[k + 1]) - p.row(v[0])).head<2>();
    }
    if (open(start * triangle.inverse_edges) && open((start + change) * triangle.inverse_edges)) continue;
    failing.push_back(&triangle);
  }
  if (failing.empty()) return out;
  out.in_.assign(kSquares * kSquares, 0);
  const Ways at_start(*this, x), at_end(*this, x + p);
  for (const Triangle* triangle : failing) {
    Eigen::AlignedBox2d box;
    for (const int v : triangle->vertices) box.extend(Point(mesh_.rest_positions.row(v).head<2>()));
    Squares at{0, kSquares - 1, 0, kSquares - 1};
    for (double reach = std::numeric_limits<double>::infinity();;) {
      const double nearer = (1.0 + kRounding) * (within_m + std::max(at_start.difference(at), at_end.difference(at)));
      if (!(nearer < kMuchNearer * reach)) break;
      reach = nearer;
      at = squares({box.min().array() - reach, box.max().array() + reach});
    }
    for (int j = at.low; j <= at.high; ++j)
      std::fill_n(&out.in_[static_cast<std::size_t>(j * kSquares + at.left)], at.right - at.left + 1, 1);
  }
  return out;
}

}  // namespace tacipc
