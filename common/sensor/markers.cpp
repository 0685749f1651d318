#include "common/sensor/markers.h"

#include <cassert>

#include "common/base/error.h"
#include "common/base/parse.h"
#include "common/format/csv.h"

namespace tacipc {
namespace {

/// Tolerance, in barycentric coordinates, for points outside a triangle by rounding.
constexpr double kOutside = 1e-9;

/// Returns barycentric coordinates of a triangle's corners at (x, y), seen along z; nothing if it faces sideways or
/// inwards.
std::optional<Vector3> weights_at(const Eigen::Vector2d& point, const Positions& rest, const Triangles& front,
                                  Eigen::Index triangle) {
  Eigen::Vector2d corner[3];
  for (int c = 0; c < 3; ++c) corner[c] = rest.row(front(triangle, c)).head<2>().transpose();
  const auto twice_area = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  const double whole = twice_area(corner[0], corner[1], corner[2]);
  if (!(whole > 0.0)) return std::nullopt;
  return Vector3(twice_area(point, corner[1], corner[2]), twice_area(corner[0], point, corner[2]),
                 twice_area(corner[0], corner[1], point)) /
         whole;
}

}  // namespace

std::vector<Marker> bind_markers(const MarkerGrid& grid, const Positions& rest, const Triangles& front) {
  std::vector<Marker> markers;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d point(grid.x_m(column), grid.y_m(row));
      Eigen::Index found = -1;
      double deepest = -kOutside;
      Vector3 weights;
      for (Eigen::Index f = 0; f < front.rows(); ++f) {
        const auto here = weights_at(point, rest, front, f);
        if (!here || here->minCoeff() < deepest || (found >= 0 && here->minCoeff() == deepest)) continue;
        found = f;
        deepest = here->minCoeff();
        weights = *here;
      }
      if (found < 0) {
        if (!grid.given) continue;
        throw DataError("marker in row {}, column {} at ({:.6g}, {:.6g}) mm does not lie on the front face", row,
                        column, 1e3 * point.x(), 1e3 * point.y());
      }
      weights = weights.cwiseMax(0.0);
      weights /= weights.sum();
      markers.push_back({row, column, {front(found, 0), front(found, 1), front(found, 2)}, weights});
    }
  }
  return markers;
}

Positions marker_positions(const std::vector<Marker>& markers, const Positions& gel) {
  Positions positions = Positions::Zero(markers.size(), 3);
  for (std::size_t m = 0; m < markers.size(); ++m) {
    for (int c = 0; c < 3; ++c) positions.row(m) += markers[m].weights[c] * gel.row(markers[m].vertices[c]);
  }
  return positions;
}

std::vector<double> marker_displacements(const std::vector<Positions>& frames, std::optional<std::size_t> press_end) {
  assert(!press_end || *press_end < frames.size());
  std::vector<double> all;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    for (Eigen::Index m = 0; m < frames[frame].rows(); ++m) {
      for (const bool since_press : {false, true}) {
        Vector3 way = Vector3::Zero();
        if (!since_press) way = frames[frame].row(m) - frames[0].row(m);
        if (since_press && press_end && frame >= *press_end) way = frames[frame].row(m) - frames[*press_end].row(m);
        all.insert(all.end(), {way.x(), way.y(), way.z()});
      }
    }
  }
  return all;
}

std::string markers_csv(const std::vector<Marker>& markers) {
  std::string text = "marker,row,column,vertex0,vertex1,vertex2,weight0,weight1,weight2\n";
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const Marker& marker = markers[m];
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", m, marker.row, marker.column, marker.vertices[0],
                    marker.vertices[1], marker.vertices[2], marker.weights[0], marker.weights[1], marker.weights[2]);
  }
  return text;
}

std::vector<MarkerPlace> read_marker_places(const std::filesystem::path& file) {
  std::vector<MarkerPlace> places;
  CsvReader rows(file);
  const auto count = [&](const char* column) {
    const std::string& text = rows[column];
    const auto value = parse_number<int>(text);
    if (!value || *value < 0) throw DataError("{}:{}: '{}' is not a {}", file.string(), rows.line(), text, column);
    return *value;
  };
  while (rows.next()) places.push_back({.row = count("row"), .column = count("column")});
  return places;
}

}  // namespace tacipc
