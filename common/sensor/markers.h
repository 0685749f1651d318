// Markers printed on the front face: bound to its triangles at rest, they move with the gel.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// A marker as a point of a front triangle, Σ weights[i] · position of vertices[i].
struct Marker {
  int row = 0;     // row in the grid, 0 at the smallest y
  int column = 0;  // column in the grid, 0 at the smallest x
  std::array<int, 3> vertices{};
  Vector3 weights = Vector3::Zero();  // ≥ 0, sum 1
};

/// Finds for each marker the front triangle above its (x, y) at rest, row after row. If several triangles share the
/// point, the one in which it lies deepest is taken, and of equal ones the first: the same mesh gives the same binding.
/// Domed fronts are viewed along z; triangles that face sideways or inwards take no marker. A point outside all
/// triangles by at most 1e-9 of a triangle's height counts as on its edge. Markers off the front are left out if the
/// sensor file gives no grid.
/// \throw DataError naming the first marker off the front if the sensor file gives a grid
std::vector<Marker> bind_markers(const MarkerGrid& grid, const Positions& rest, const Triangles& front);

/// Returns the positions of the markers, #M × 3, for gel positions in the numbering of the binding.
Positions marker_positions(const std::vector<Marker>& markers, const Positions& gel);

/// Computes displacements since the first frame [0] and since frame `press_end` [1], row-major (frames, #M, 2, 3), from
/// the marker positions of all frames. [1] is zero before that frame, and everywhere if there is no such frame.
std::vector<double> marker_displacements(const std::vector<Positions>& frames, std::optional<std::size_t> press_end);

/// Returns a table marker,row,column,vertex0,…,weight2, which relates markers.npy to positions.npy. Weights read back
/// to the same bits.
std::string markers_csv(const std::vector<Marker>& markers);

/// Position of a marker in the grid.
struct MarkerPlace {
  int row = 0, column = 0;
};
/// Reads the grid position of every marker from such a table.
/// \throw DataError if it lacks these columns or a field is not a count
std::vector<MarkerPlace> read_marker_places(const std::filesystem::path& file);

}  // namespace tacipc
