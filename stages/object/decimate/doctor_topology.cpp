#include <algorithm>
#include <numeric>

#include "common/base/disjoint_sets.h"
#include "common/base/error.h"
#include "stages/object/decimate/doctor_steps.h"

namespace tacipc {
namespace {

/// A closed part counts as flat if its volume is below this fraction of its area times its extent.
constexpr double kFlatVolume = 1e-9;
constexpr int kMinFaces = 4;  // least number of faces of a closed surface

/// Six times the volume of each part, from the middle of its corners, and its area.
struct Sizes {
  std::vector<double> volume;
  std::vector<double> area;
  std::vector<std::int64_t> faces;
  std::vector<int> first_face;
};

Sizes sizes_of(const TriangleMesh& mesh, const Components& components, const std::vector<char>* turned = nullptr) {
  const auto count = static_cast<std::size_t>(components.count);
  Sizes sizes{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0), std::vector<std::int64_t>(count, 0),
              std::vector<int>(count, -1)};
  const int num_faces = static_cast<int>(mesh.num_triangles());
  std::vector<Vector3> middle(count, Vector3::Zero());
  for (int f = 0; f < num_faces; ++f) {
    const int part = components.of_face[f];
    if (sizes.first_face[part] < 0) sizes.first_face[part] = f;
    ++sizes.faces[part];
    middle[part] += (corner(mesh, f, 0) + corner(mesh, f, 1) + corner(mesh, f, 2)) / 3.0;
  }
  for (std::size_t part = 0; part < count; ++part) middle[part] /= static_cast<double>(sizes.faces[part]);
  for (int f = 0; f < num_faces; ++f) {
    const int part = components.of_face[f];
    const Vector3 area = area_vector(mesh, f);
    const double sign = turned != nullptr && (*turned)[f] != 0 ? -1.0 : 1.0;
    sizes.area[part] += area.norm();
    sizes.volume[part] += sign * (corner(mesh, f, 0) - middle[part]).dot(area) / 3.0;
  }
  return sizes;
}

}  // namespace

void remove_debris(TriangleMesh& mesh, double area_fraction, DoctorReport& report) {
  const Components components = connected_components(mesh.triangles, opposite_half_edges(mesh));
  if (components.count == 1) return;
  const Sizes sizes = sizes_of(mesh, components);
  const double all = std::accumulate(sizes.area.begin(), sizes.area.end(), 0.0);
  const auto largest = std::ranges::max_element(sizes.area) - sizes.area.begin();
  std::vector<char> debris(components.count, 0);
  for (int part = 0; part < components.count; ++part)
    if (part != largest && (sizes.faces[part] < kMinFaces || sizes.area[part] < area_fraction * all)) {
      debris[part] = 1;
      ++report.debris_components;
    }
  if (report.debris_components == 0) return;
  std::vector<char> keep(mesh.num_triangles());
  for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = debris[components.of_face[f]] != 0 ? 0 : 1;
  mesh.triangles = select_faces(mesh.triangles, keep);
}

void orient_consistently(TriangleMesh& mesh, DoctorReport& report) {
  const std::vector<int> opposite = opposite_half_edges(mesh);
  const int num_faces = static_cast<int>(mesh.num_triangles());
  std::vector<char> turned(num_faces, 0);
  std::vector<char> seen(turned.size(), 0);
  std::vector<int> queue;
  for (int seed = 0; seed < num_faces; ++seed) {
    if (seen[seed] != 0) continue;
    seen[seed] = 1;
    queue.assign(1, seed);
    while (!queue.empty()) {
      const int face = queue.back();
      queue.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int h = 3 * face + k, other = opposite[h];
        if (other == kOpen) continue;
        // Neighbours agree if they run along their edge in opposite directions.
        const bool same_way = origin_of(mesh.triangles, h) == origin_of(mesh.triangles, other);
        const char wanted = static_cast<char>(turned[face] ^ (same_way ? 1 : 0));
        if (seen[other / 3] == 0) {
          seen[other / 3] = 1;
          turned[other / 3] = wanted;
          queue.push_back(other / 3);
        } else if (turned[other / 3] != wanted) {
          throw DataError("one-sided surface: the faces around {} have no common outside",
                          place_mm(mesh.positions.row(origin_of(mesh.triangles, h))));
        }
      }
    }
  }
  const Components components = connected_components(mesh.triangles, opposite);
  const Sizes sizes = sizes_of(mesh, components, &turned);
  for (int f = 0; f < num_faces; ++f)
    if ((turned[f] != 0) != (sizes.volume[components.of_face[f]] < 0.0)) {
      std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
      ++report.reoriented_faces;
    }
}

void split_vertices(TriangleMesh& mesh, DoctorReport& report) { split_fans(mesh, opposite_half_edges(mesh), report); }

void split_fans(TriangleMesh& mesh, const std::vector<int>& opposite, DoctorReport& report) {
  // Corners of one fan are joined through their common edges; half edge h represents the corner at its start.
  DisjointSets fans(opposite.size());
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
    if (opposite[h] == kOpen) continue;
    fans.join(h, next_in_face(opposite[h]));
    fans.join(next_in_face(h), opposite[h]);
  }
  std::vector<char> has_fan(mesh.num_vertices(), 0);
  std::vector<int> vertex_of_fan(opposite.size());
  std::vector<int> copied;
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
    if (fans.root(h) != h) continue;
    const int v = origin_of(mesh.triangles, h);
    if (has_fan[v] == 0) {
      has_fan[v] = 1;
      vertex_of_fan[h] = v;
    } else {
      vertex_of_fan[h] = static_cast<int>(mesh.num_vertices() + std::ssize(copied));
      copied.push_back(v);
    }
  }
  if (copied.empty()) return;
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) mesh.triangles.data()[h] = vertex_of_fan[fans.root(h)];
  const Eigen::Index before = mesh.num_vertices();
  mesh.positions.conservativeResize(before + std::ssize(copied), 3);
  for (std::size_t i = 0; i < copied.size(); ++i) mesh.positions.row(before + i) = mesh.positions.row(copied[i]);
  report.split_vertices += std::ssize(copied);
}

void remove_flat_parts(TriangleMesh& mesh, DoctorReport& report) {
  const Components components = connected_components(mesh.triangles, opposite_half_edges(mesh));
  const Sizes sizes = sizes_of(mesh, components);
  const double extent = largest_extent(mesh);
  const auto is_flat = [&](int part) { return !(sizes.volume[part] > kFlatVolume * sizes.area[part] * extent); };
  const auto count = [&] {
    std::int64_t flat = 0;
    for (int part = 0; part < components.count; ++part) flat += is_flat(part) ? 1 : 0;
    return flat;
  }();
  if (count == 0) return;
  if (count == components.count)
    throw DataError("a closed part of {} faces near {} encloses no volume ({:.3g} mm^3)", sizes.faces[0],
                    place_mm(corner(mesh, sizes.first_face[0], 0).transpose()), 1e9 * sizes.volume[0]);
  std::vector<char> keep(mesh.num_triangles());
  for (std::size_t f = 0; f < keep.size(); ++f) keep[f] = is_flat(components.of_face[f]) ? 0 : 1;
  mesh.triangles = select_faces(mesh.triangles, keep);
  report.flat_components = count;
}

}  // namespace tacipc
