#include "stages/gel/tetmesh/gel_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/tetmesh/face_mesh.h"
#include "stages/gel/tetmesh/outline.h"

namespace tacipc {
namespace {

/// Points at one height fraction around the rim: for each panel the indices of its points and their parameters, with
/// the corner points at both ends.
struct Row {
  std::vector<std::vector<int>> vertices;
  std::vector<std::vector<double>> parameters;
};

class Builder {
 public:
  explicit Builder(const Sizing& sizing) : sizing_(sizing), panels_(panels(sizing.gel)) {}

  /// Adds vertices along the rim at a fraction of the depth: 0 front, 1 back.
  Row add_row(double fraction) {
    Row row;
    const int first = num_vertices();
    for (std::size_t p = 0; p < panels_.size(); ++p) {
      const Panel& panel = panels_[p];
      const auto parameters = graded_parameters(panel.length_m, panel.min_edges, [&](double t) {
        return target_edge_length(sizing_, at(panel.at(t), fraction));
      });
      std::vector<int> vertices;
      for (std::size_t i = 0; i + 1 < parameters.size(); ++i) {
        vertices.push_back(num_vertices());
        positions_.push_back(at(panel.at(parameters[i]), fraction));
      }
      vertices.push_back(p + 1 == panels_.size() ? first : num_vertices());
      row.vertices.push_back(vertices);
      row.parameters.push_back(parameters);
    }
    return row;
  }

  /// Fills a face whose rim is the vertices [first, first + count), just added.
  void add_face(double fraction, int first, std::uint64_t seed) {
    const GelShape& gel = sizing_.gel;
    const Face face{
        .gel = gel,
        .dome_radius_m = fraction == 0.0 ? gel.dome_radius_m : std::optional<double>(),
        .height_m = [&, fraction](const Vector2& p) { return at(p, fraction).z(); },
        .edge_length_m = [&, fraction](const Vector2& p) { return target_edge_length(sizing_, at(p, fraction)); }};
    std::vector<Vector2> rim;
    for (std::size_t i = static_cast<std::size_t>(first); i < positions_.size(); ++i)
      rim.push_back(positions_[i].head<2>());
    const FaceMesh mesh = mesh_face(face, rim, seed);
    check_rim(mesh, rim.size());
    for (std::size_t i = rim.size(); i < mesh.points.size(); ++i) positions_.push_back(at(mesh.points[i], fraction));
    const bool front = fraction == 0.0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      const auto v = [&](int i) { return first + mesh.triangles(t, i); };
      if (front) {
        add_triangle(v(0), v(1), v(2), BoundaryTag::front);
      } else {
        add_triangle(v(0), v(2), v(1), BoundaryTag::glued);
      }
    }
  }

  /// Adds triangles between two rows, always closing the shorter diagonal.
  void add_strip(const Row& upper, const Row& lower) {
    for (std::size_t p = 0; p < panels_.size(); ++p) {
      const std::vector<int>&a = upper.vertices[p], &b = lower.vertices[p];
      std::size_t i = 0, j = 0;
      while (i + 1 < a.size() || j + 1 < b.size()) {
        bool along_upper = i + 1 < a.size();
        if (along_upper && j + 1 < b.size()) {
          along_upper = (positions_[a[i + 1]] - positions_[b[j]]).squaredNorm() <=
                        (positions_[a[i]] - positions_[b[j + 1]]).squaredNorm();
        }
        if (along_upper) {
          add_triangle(a[i], b[j], a[i + 1], BoundaryTag::side);
          ++i;
        } else {
          add_triangle(b[j], b[j + 1], a[i], BoundaryTag::side);
          ++j;
        }
      }
    }
  }

  /// Depth fractions of the rows, including front and back: steps of the height of equilateral triangles.
  std::vector<double> row_fractions() const {
    const Vector2 corner = panels_.front().at(0.0);
    const double height = at(corner, 0.0).z() + sizing_.gel.thickness_m;
    return graded_parameters(height, 1, [&](double fraction) {
      return std::numbers::sqrt3 / 2.0 * target_edge_length(sizing_, at(corner, fraction));
    });
  }

  int num_vertices() const { return static_cast<int>(positions_.size()); }

  GelSurface finish() const { return {rows_of<Positions>(positions_), rows_of<Triangles>(triangles_), tags_}; }

 private:
  /// The point of the gel over (x, y) at a fraction of the depth there.
  Vector3 at(const Vector2& p, double fraction) const {
    const double front = sizing_.gel.front_z(p.x(), p.y()), back = -sizing_.gel.thickness_m;
    if (fraction == 0.0) return {p.x(), p.y(), front};
    return {p.x(), p.y(), fraction == 1.0 ? back : front + (back - front) * fraction};
  }

  void add_triangle(int a, int b, int c, BoundaryTag tag) {
    triangles_.push_back({a, b, c});
    tags_.push_back(tag);
  }

  /// Checks that the hull of the triangulation is exactly the rim; otherwise the strips would not close the surface.
  static void check_rim(const FaceMesh& mesh, std::size_t rim_size) {
    std::size_t open = 0;
    const auto edges = unique_edges(mesh.triangles);
    std::vector<int> uses(edges.size(), 0);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      for (int e = 0; e < 3; ++e) {
        const int i = mesh.triangles(t, e), j = mesh.triangles(t, (e + 1) % 3);
        const auto edge = std::lower_bound(edges.begin(), edges.end(), std::pair(std::min(i, j), std::max(i, j)));
        ++uses[static_cast<std::size_t>(edge - edges.begin())];
      }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (uses[e] != 1) continue;
      ++open;
      const auto [i, j] = edges[e];
      const bool on_rim = static_cast<std::size_t>(j) < rim_size &&
                          (j == i + 1 || (i == 0 && static_cast<std::size_t>(j) + 1 == rim_size));
      if (!on_rim) throw DataError("the rim of a face is crossed by an edge between its points {} and {}", i, j);
    }
    if (open != rim_size) throw DataError("the rim of a face has {} edges instead of {}", open, rim_size);
  }

  const Sizing& sizing_;
  std::vector<Panel> panels_;
  std::vector<Vector3> positions_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<BoundaryTag> tags_;
};

}  // namespace

GelSurface gel_surface(const Sizing& sizing, std::uint64_t seed) {
  Builder build(sizing);
  std::vector<Row> rows{build.add_row(0.0)};
  build.add_face(0.0, 0, 2 * seed);
  const std::vector<double> fractions = build.row_fractions();
  for (std::size_t i = 1; i + 1 < fractions.size(); ++i) rows.push_back(build.add_row(fractions[i]));
  const int first_of_back = build.num_vertices();
  rows.push_back(build.add_row(1.0));
  build.add_face(1.0, first_of_back, 2 * seed + 1);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) build.add_strip(rows[i], rows[i + 1]);
  return build.finish();
}

}  // namespace tacipc
