#include "common/mesh/triangle_mesh.h"

#include <bit>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/text_reader.h"
#include "common/mesh/mesh_formats.h"

namespace tacipc {
namespace {

/// Largest number of corners of a face. Ear clipping is quadratic; real files have no larger face.
constexpr std::size_t kMostCorners = 10'000;

PolygonSoup read_soup(const std::filesystem::path& path) {
  const std::string suffix = lower_case(path.extension().string());
  const std::string name = path.string();
  using Reader = PolygonSoup (*)(std::string_view, const std::string&);
  const Reader reader = suffix == ".stl"   ? read_stl
                        : suffix == ".obj" ? read_obj
                        : suffix == ".off" ? read_off
                        : suffix == ".ply" ? read_ply
                                           : nullptr;
  if (reader == nullptr)
    throw DataError("{}: '{}' is not a known mesh suffix (.stl, .obj, .off, .ply)", name, shown(suffix));
  const std::string bytes = read_file(path);
  if (bytes.empty()) throw DataError("{}: the file is empty", name);
  return reader(bytes, name);
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

}  // namespace

double metres_per_unit(const std::string& unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return 1e-3;
  if (unit == "um") return 1e-6;
  if (unit == "in") return 0.0254;
  if (unit == "ft") return 0.3048;
  throw UsageError(fmt::format("'{}' is not a known unit (m, cm, mm, um, in)", shown(unit)));
}

TriangleMesh read_triangle_mesh(const std::filesystem::path& path, double metres_per_unit) {
  PolygonSoup soup = read_soup(path);
  const std::string name = path.string();
  const std::size_t num_vertices = soup.vertices.size();
  for (std::size_t i = 0; i < num_vertices; ++i) {
    soup.vertices[i] *= metres_per_unit;
    if (!soup.vertices[i].allFinite()) throw DataError("{}: vertex {} is not finite", name, i);
  }

  std::vector<int> triangle_corners;
  triangle_corners.reserve(soup.corners.size());
  soup.first_corner.push_back(static_cast<int>(soup.corners.size()));
  for (std::size_t f = 0; f + 1 < soup.first_corner.size(); ++f) {
    const int first = soup.first_corner[f];
    const std::span<const int> polygon(soup.corners.data() + first, soup.corners.data() + soup.first_corner[f + 1]);
    const auto place = [&] {
      return soup.lines.empty() ? fmt::format("{}: face {}", name, f) : fmt::format("{}:{}: face", name, soup.lines[f]);
    };
    if (polygon.size() < 3) throw DataError("{} has {} corners, needs at least 3", place(), polygon.size());
    if (polygon.size() > kMostCorners)
      throw DataError("{} has {} corners, more than {}", place(), polygon.size(), kMostCorners);
    for (const int vertex : polygon)
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= num_vertices)
        throw DataError("{} refers to vertex {} (counted from 0), but there are {} vertices", place(), vertex,
                        num_vertices);
    triangulate_polygon(polygon, soup.vertices, triangle_corners);
  }
  if (triangle_corners.empty()) throw DataError("{}: has no triangles", name);

  return {rows_of<Positions>(soup.vertices),
          Eigen::Map<const Triangles>(triangle_corners.data(), triangle_corners.size() / 3, 3)};
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const Vector3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                  c = mesh.positions.row(mesh.triangles(f, 2));
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

void remove_unreferenced_vertices(TriangleMesh& mesh) {
  std::vector<int> new_index(mesh.num_vertices(), -1);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) new_index[mesh.triangles.data()[i]] = 0;
  int kept = 0;
  for (int v = 0; v < static_cast<int>(new_index.size()); ++v)
    if (new_index[v] == 0) {
      mesh.positions.row(kept) = mesh.positions.row(v);
      new_index[v] = kept++;
    }
  mesh.positions.conservativeResize(kept, 3);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    mesh.triangles.data()[i] = new_index[mesh.triangles.data()[i]];
}

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh) {
  static_assert(std::endian::native == std::endian::little, "written as it lies in memory");
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment unit: metre\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.num_vertices(), mesh.num_triangles());
  bytes.reserve(bytes.size() + static_cast<std::size_t>(24 * mesh.num_vertices() + 13 * mesh.num_triangles()));
  append(bytes, mesh.positions.data(), sizeof(double) * mesh.positions.size());
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    bytes.push_back(3);
    append(bytes, &mesh.triangles(f, 0), 3 * sizeof(int));
  }
  write_file(path, bytes);
}

}  // namespace tacipc
