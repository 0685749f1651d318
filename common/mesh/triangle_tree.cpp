#include "common/mesh/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace tacipc {
namespace {

constexpr int kLeafSize = 4;

double squared_distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (a + t * ab - p).squaredNorm();
}

}  // namespace

double squared_distance_to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 n = (b - a).cross(c - a);
  const double n2 = n.squaredNorm();
  // If the point projects into the triangle, the plane is nearest; otherwise an edge is.
  if (n2 > 0.0 && n.cross(b - a).dot(p - a) >= 0.0 && n.cross(c - b).dot(p - b) >= 0.0 &&
      n.cross(a - c).dot(p - c) >= 0.0) {
    const double height = n.dot(p - a);
    return height * height / n2;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : mesh_(mesh), faces_(static_cast<std::size_t>(mesh.num_triangles())) {
  std::iota(faces_.begin(), faces_.end(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(faces_.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) boxes[f] = box_of(static_cast<int>(f));
  nodes_.reserve(boxes.size());
  build(boxes, 0, static_cast<int>(boxes.size()));
}

Eigen::AlignedBox3d TriangleTree::box_of(int face) const {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < 3; ++k) box.extend(mesh_.positions.row(mesh_.triangles(face, k)).transpose());
  return box;
}

void TriangleTree::build(const std::vector<Eigen::AlignedBox3d>& boxes, int first, int last) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({.box = {}, .next = 0, .first = first, .last = last});
  Eigen::AlignedBox3d centres;
  for (int i = first; i < last; ++i) {
    nodes_[self].box.extend(boxes[faces_[i]]);
    centres.extend(boxes[faces_[i]].center());
  }
  if (last - first > kLeafSize) {
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    // Ties are broken by index, so that the halves do not depend on the library's partition.
    std::nth_element(faces_.begin() + first, faces_.begin() + middle, faces_.begin() + last, [&](int a, int b) {
      const double ca = boxes[a].center()[axis], cb = boxes[b].center()[axis];
      return ca != cb ? ca < cb : a < b;
    });
    nodes_[self].last = first;
    build(boxes, first, middle);
    build(boxes, middle, last);
  } else {
    std::sort(faces_.begin() + first, faces_.begin() + last);
  }
  nodes_[self].next = static_cast<int>(nodes_.size());
}

double TriangleTree::squared_distance(const Vector3& point) const {
  double best = std::numeric_limits<double>::infinity();
  nearest(0, point, best);
  return best;
}

double TriangleTree::squared_distance(const Vector3& point, int face) const {
  const auto x = [&](int k) -> Vector3 { return mesh_.positions.row(mesh_.triangles(face, k)).transpose(); };
  return squared_distance_to_triangle(point, x(0), x(1), x(2));
}

bool TriangleTree::within(const Vector3& point, double squared, int& face) const {
  return squared_distance(point, face) <= squared || reaches(0, point, squared, face);
}

bool TriangleTree::reaches(int n, const Vector3& point, double squared, int& face) const {
  const Node& node = nodes_[n];
  if (node.box.squaredExteriorDistance(point) > squared) return false;
  for (int i = node.first; i < node.last; ++i) {
    if (squared_distance(point, faces_[i]) > squared) continue;
    face = faces_[i];
    return true;
  }
  if (node.first < node.last) return false;
  return reaches(n + 1, point, squared, face) || reaches(nodes_[n + 1].next, point, squared, face);
}

void TriangleTree::nearest(int n, const Vector3& point, double& best) const {
  const Node& node = nodes_[n];
  for (int i = node.first; i < node.last; ++i) best = std::min(best, squared_distance(point, faces_[i]));
  if (node.first < node.last) return;
  std::pair<double, int> near{0.0, n + 1}, far{0.0, nodes_[n + 1].next};
  near.first = nodes_[near.second].box.squaredExteriorDistance(point);
  far.first = nodes_[far.second].box.squaredExteriorDistance(point);
  if (far.first < near.first) std::swap(near, far);
  if (near.first < best) nearest(near.second, point, best);
  if (far.first < best) nearest(far.second, point, best);
}

}  // namespace tacipc
