#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "stages/object/decimate/doctor_steps.h"
#include "stages/object/decimate/self_intersection.h"

namespace tacipc {
namespace {

/// Σ solid angles of the faces seen from a point, over 4π: 1 inside a closed outward surface, 0 outside.
/// tan(Ω/2) = a·(b×c) / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|)
double winding_number(const TriangleMesh& mesh, const std::vector<int>& faces, const Vector3& point) {
  double sum = 0.0;
  for (const int f : faces) {
    const Vector3 a = corner(mesh, f, 0) - point, b = corner(mesh, f, 1) - point, c = corner(mesh, f, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace

void examine_components(TriangleMesh& mesh, DoctorReport& report) {
  const Components components = connected_components(mesh.triangles, opposite_half_edges(mesh));
  std::set<std::pair<int, int>> crossing;
  for (const FacePair& pair : self_intersections(mesh)) {
    const auto parts = std::minmax({components.of_face[pair.first], components.of_face[pair.second]});
    if (parts.first == parts.second)
      ++report.self_intersections;
    else
      crossing.insert(parts);
  }
  report.overlapping_components = std::ssize(crossing);
  report.components = components.count;
  if (components.count == 1) return;

  const auto count = static_cast<std::size_t>(components.count);
  std::vector<std::vector<int>> faces(count);
  std::vector<Eigen::AlignedBox3d> boxes(count);
  for (int f = 0; f < static_cast<int>(mesh.num_triangles()); ++f) {
    const int part = components.of_face[f];
    faces[part].push_back(f);
    for (int k = 0; k < 3; ++k) boxes[part].extend(corner(mesh, f, k));
  }
  // A part that crosses nothing lies entirely inside another or entirely outside, so one vertex decides.
  std::vector<char> hidden(count, 0);
  tbb::parallel_for(0, components.count, [&](int inner) {
    for (int outer = 0; outer < components.count && hidden[inner] == 0; ++outer) {
      if (outer == inner || !boxes[outer].contains(boxes[inner])) continue;
      if (crossing.contains(std::minmax({inner, outer}))) continue;
      if (winding_number(mesh, faces[outer], corner(mesh, faces[inner].front(), 0)) > 0.5) hidden[inner] = 1;
    }
  });
  std::vector<char> keep(mesh.num_triangles(), 1);
  for (std::size_t part = 0; part < count; ++part) {
    if (hidden[part] == 0) continue;
    ++report.hidden_components;
    for (const int f : faces[part]) keep[f] = 0;
  }
  if (report.hidden_components == 0) return;
  report.components -= report.hidden_components;
  mesh.triangles = select_faces(mesh.triangles, keep);
  // Crossings of removed parts no longer matter.
  DoctorReport again;
  examine_components(mesh, again);
  report.overlapping_components = again.overlapping_components;
  report.self_intersections = again.self_intersections;
}

}  // namespace tacipc
