#include "stages/gel/press/contact/open_face.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tacipc {
namespace {

constexpr double kFlat = 1e-9;         // of the face's size
constexpr double kLeast = 0.5 + 1e-6;  // c, with room for rounding and for an outline that is convex but for rounding
constexpr double kAngleError = 1e-6, kRounding = 1e-6;

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Whether the triangles (counter-clockwise, seen along −z) have one outline, and that turns left only, once around.
bool is_convex(const std::vector<std::array<int, 3>>& triangles, const Positions& at) {
  std::map<std::array<int, 2>, int> edges;  // directed; those without a reverse make the outline
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
    if (angle < -kFlat) return false;
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
  const double level = top - kFlat * (high - low).norm();
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
    triangles_.push_back({t, edges.inverse()});
  }
  for (const auto& t : face) {
    for (const int v : t) on_face_[static_cast<std::size_t>(v)] = true;
  }
  for (const int v : mesh.gel.vertices) {
    if (!has(v)) continue;
    vertices_.push_back(v);
    outline_.extend(Point(rest.row(v).head<2>()));
  }
}

std::array<int, 4> OpenFace::squares(const Eigen::AlignedBox2d& box) const {
  std::array<int, 4> out;
  for (int c = 0; c < 2; ++c) {
    const double scale = kSquares / outline_.sizes()[c];
    const auto square = [&](double at) {
      return static_cast<int>(std::clamp((at - outline_.min()[c]) * scale, 0.0, kSquares - 1.0));
    };
    out[2 * c] = square(box.min()[c]);
    out[2 * c + 1] = square(box.max()[c]);
  }
  return out;
}

bool OpenFace::Places::within(const Places& other) const {
  if (none() || other.none()) return none();
  for (std::size_t i = 0; i < in_.size(); ++i)
    if (in_[i] && !other.in_[i]) return false;
  return true;
}

OpenFace::Places OpenFace::at_risk(const Positions& x, const Positions& p, double d_hat_m) const {
  const auto open = [](const Eigen::Matrix2d& gradient) {
    const double mean = 0.5 * (gradient(0, 0) + gradient(1, 1)) - kLeast;
    const double difference = 0.5 * (gradient(0, 0) - gradient(1, 1));
    const double mixed = 0.5 * (gradient(0, 1) + gradient(1, 0));
    return mean >= 0.0 && mean * mean >= difference * difference + mixed * mixed;
  };
  Places out;
  out.face_ = this;
  double reach = 0.0;
  for (const Triangle& triangle : triangles_) {
    const auto& v = triangle.vertices;
    Eigen::Matrix2d start, change;
    for (int k = 0; k < 2; ++k) {
      start.col(k) = (x.row(v[k + 1]) - x.row(v[0])).head<2>();
      change.col(k) = (p.row(v[k + 1]) - p.row(v[0])).head<2>();
    }
    if (open(start * triangle.inverse_edges) && open((start + change) * triangle.inverse_edges)) continue;
    if (out.none()) {
      out.in_.assign(kSquares * kSquares, 0);
      reach = (1.0 + kRounding) * (d_hat_m + 2.0 * farthest_sideways(x, p));
    }
    Eigen::AlignedBox2d box;
    for (const int i : v) box.extend(Point(mesh_.rest_positions.row(i).head<2>()));
    const auto [left, right, low, high] = squares({box.min().array() - reach, box.max().array() + reach});
    for (int j = low; j <= high; ++j)
      std::fill_n(&out.in_[static_cast<std::size_t>(j * kSquares + left)], right - left + 1, 1);
  }
  return out;
}

double OpenFace::farthest_sideways(const Positions& x, const Positions& p) const {
  double squared = 0.0;
  for (const int v : vertices_) {
    const Point from_rest = (x.row(v) - mesh_.rest_positions.row(v)).head<2>();
    squared = std::max({squared, from_rest.squaredNorm(), (from_rest + Point(p.row(v).head<2>())).squaredNorm()});
  }
  return std::sqrt(squared);
}

}  // namespace tacipc
