#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <iterator>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/mesh/tet_mesh.h"

namespace tacipc {
namespace {

constexpr int kVolumeTag = 4;
constexpr int kVolume = 1;

struct NamedTag {
  BoundaryTag tag;
  const char* name;
  bool required;
};

/// Kind of a file: gel or soft object.
struct Kind {
  std::vector<NamedTag> tags;  // tags of its boundary
  const char* volume;          // physical name of the volume
  const char *said, *tags_said;
};
const Kind kGel{
    {{BoundaryTag::front, "front", true}, {BoundaryTag::side, "side", false}, {BoundaryTag::glued, "glued", true}},
    "gel",
    "a gel",
    "1 (front), 2 (side) or 3 (glued)"};
const Kind kObject{{{BoundaryTag::free, "free", true}}, "object", "a soft object", "5 (free)"};

/// Returns sorted triangles, each rotated to begin with its smallest index, so that sets of triangles can be compared.
std::vector<std::array<int, 3>> canonical(const Triangles& triangles) {
  std::vector<std::array<int, 3>> rows(triangles.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    std::array<int, 3>& row = rows[f];
    row = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    std::rotate(row.begin(), std::ranges::min_element(row), row.end());
  }
  std::ranges::sort(rows);
  return rows;
}

template <typename Row>
Eigen::RowVector3d corner_sum(const Positions& positions, const Row& row) {
  return positions.row(row[0]) + positions.row(row[1]) + positions.row(row[2]);
}

}  // namespace

void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  fmt::memory_buffer buffer;
  const auto out = std::back_inserter(buffer);
  const auto write_bounds = [&](const auto& cells) {
    Eigen::RowVector3d low = mesh.positions.row(cells(0, 0)), high = low;
    for (Eigen::Index i = 0; i < cells.size(); ++i) {
      low = low.cwiseMin(mesh.positions.row(cells.data()[i]));
      high = high.cwiseMax(mesh.positions.row(cells.data()[i]));
    }
    fmt::format_to(out, "{} {} {} {} {} {}", low[0], low[1], low[2], high[0], high[1], high[2]);
  };
  if (mesh.num_tets() == 0) throw DataError("{}: a mesh without tetrahedra is not written", path.string());

  const bool is_object = std::ranges::find(mesh.tags, BoundaryTag::free) != mesh.tags.end();
  const Kind& kind = is_object ? kObject : kGel;
  fmt::format_to(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", kind.tags.size() + 1);
  for (const NamedTag& named : kind.tags) fmt::format_to(out, "2 {} \"{}\"\n", static_cast<int>(named.tag), named.name);
  fmt::format_to(out, "3 {} \"{}\"\n$EndPhysicalNames\n", kVolumeTag, kind.volume);

  std::vector<std::pair<int, Triangles>> surfaces;
  for (const NamedTag& named : kind.tags)
    if (Triangles faces = mesh.faces(named.tag); faces.rows() > 0)
      surfaces.emplace_back(static_cast<int>(named.tag), std::move(faces));

  fmt::format_to(out, "$Entities\n0 0 {} 1\n", surfaces.size());
  for (const auto& [tag, faces] : surfaces) {
    fmt::format_to(out, "{} ", tag);
    write_bounds(faces);
    fmt::format_to(out, " 1 {} 0\n", tag);
  }
  fmt::format_to(out, "{} ", kVolume);
  write_bounds(mesh.tets);
  fmt::format_to(out, " 1 {} {}", kVolumeTag, surfaces.size());
  for (const auto& surface : surfaces) fmt::format_to(out, " {}", surface.first);
  fmt::format_to(out, "\n$EndEntities\n");

  const Eigen::Index num_vertices = mesh.num_vertices();
  fmt::format_to(out, "$Nodes\n1 {} 1 {}\n3 {} 0 {}\n", num_vertices, num_vertices, kVolume, num_vertices);
  for (Eigen::Index i = 1; i <= num_vertices; ++i) fmt::format_to(out, "{}\n", i);
  for (Eigen::Index i = 0; i < num_vertices; ++i)
    fmt::format_to(out, "{} {} {}\n", mesh.positions(i, 0), mesh.positions(i, 1), mesh.positions(i, 2));
  fmt::format_to(out, "$EndNodes\n");

  Eigen::Index count = mesh.num_tets();
  for (const auto& surface : surfaces) count += surface.second.rows();
  fmt::format_to(out, "$Elements\n{} {} 1 {}\n", surfaces.size() + 1, count, count);
  Eigen::Index element = 0;
  for (const auto& [tag, faces] : surfaces) {
    fmt::format_to(out, "2 {} 2 {}\n", tag, faces.rows());
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
      fmt::format_to(out, "{} {} {} {}\n", ++element, faces(f, 0) + 1, faces(f, 1) + 1, faces(f, 2) + 1);
  }
  fmt::format_to(out, "3 {} 4 {}\n", kVolume, mesh.num_tets());
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t)
    fmt::format_to(out, "{} {} {} {} {}\n", ++element, mesh.tets(t, 0) + 1, mesh.tets(t, 1) + 1, mesh.tets(t, 2) + 1,
                   mesh.tets(t, 3) + 1);
  fmt::format_to(out, "$EndElements\n");
  write_file(path, std::string_view(buffer.data(), buffer.size()));
}

namespace {

/// Reads a mesh of one kind.
/// \throw DataError, which names the other kind if the file has it
TetMesh read_kind(const std::filesystem::path& path, const Kind& kind, const Kind& other) {
  MshContent content = read_msh(path);
  const std::string name = path.string();
  TetMesh mesh{.positions = std::move(content.positions),
               .tets = std::move(content.tets),
               .boundary = std::move(content.triangles),
               .tags = {}};
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    const Eigen::RowVector3d x0 = mesh.positions.row(mesh.tets(t, 0));
    Matrix3 edges;
    for (int i = 0; i < 3; ++i) edges.row(i) = mesh.positions.row(mesh.tets(t, i + 1)) - x0;
    if (!(edges.determinant() > 0.0))
      throw DataError("{}: tet {} has volume {:.3g} m^3, must be positive", name, t, edges.determinant() / 6.0);
  }
  const auto named = [](const Kind& in, int tag) {
    return std::ranges::find_if(in.tags, [&](const NamedTag& one) { return static_cast<int>(one.tag) == tag; });
  };
  const std::vector<int>& tags = content.triangle_tags;
  if (!tags.empty() && std::ranges::all_of(tags, [&](int t) { return named(other, t) != other.tags.end(); }))
    throw DataError("{}: is the mesh of {}, expected that of {}", name, other.said, kind.said);
  for (std::size_t f = 0; f < content.triangle_tags.size(); ++f) {
    const int tag = tags[f];
    if (named(kind, tag) == kind.tags.end()) {
      const Eigen::RowVector3d centre = corner_sum(mesh.positions, mesh.boundary.row(f)) / 3.0;
      throw DataError("{}: boundary triangle {} near ({:.4g}, {:.4g}, {:.4g}) m has physical tag {}, expected {}", name,
                      f, centre[0], centre[1], centre[2], tag, kind.tags_said);
    }
    mesh.tags.push_back(static_cast<BoundaryTag>(tag));
  }
  for (const NamedTag& one : kind.tags) {
    if (one.required && std::ranges::find(mesh.tags, one.tag) == mesh.tags.end())
      throw DataError("{}: no boundary triangle is tagged {}", name, one.name);
  }
  const auto expected = canonical(boundary_triangles(mesh.tets, mesh.num_vertices()));
  if (canonical(mesh.boundary) != expected)
    throw DataError(
        "{}: its {} tagged triangles are not the {} outward boundary triangles of its tets, each exactly once", name,
        mesh.boundary.rows(), expected.size());
  return mesh;
}

}  // namespace

TetMesh read_tet_mesh(const std::filesystem::path& path) { return read_kind(path, kGel, kObject); }

TetMesh read_object_tet_mesh(const std::filesystem::path& path) { return read_kind(path, kObject, kGel); }

}  // namespace tacipc
