// Markers printed on the front face: bound to its triangles at rest, carried along as the gel deforms.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// A marker as a point of a front triangle: Σ weights[i] · position of vertices[i].
struct Marker {
  int row = 0;     // of the grid, 0 at the smallest y
  int column = 0;  // 0 at the smallest x
  std::array<int, 3> vertices{};
  Vector3 weights = Vector3::Zero();  // ≥ 0, sum 1
};

/// Finds for each marker the front triangle above its (x, y) at rest, row after row. Of several triangles that share
/// the point the one is taken in which it lies deepest, of equal ones the first: the same mesh gives the same binding.
/// Domed fronts are seen from above; triangles that look sideways or inwards carry no marker. A point outside all
/// triangles by no more than 1e-9 of a triangle's height counts as on its edge. Markers off the front are left out
/// where the sensor file does not ask for a grid. \throw DataError naming the first one off the front where it does.
std::vector<Marker> bind_markers(const MarkerGrid& grid, const Positions& rest, const Triangles& front);

/// Positions of the markers, #M × 3, for gel positions in the numbering of the binding.
Positions marker_positions(const std::vector<Marker>& markers, const Positions& gel);

/// Displacements since the first frame [0] and since frame `press_end` [1], row-major (frames, #M, 2, 3), from the
/// marker positions of all frames. [1] is zero before that frame, and everywhere where there is none.
std::vector<double> marker_displacements(const std::vector<Positions>& frames, std::optional<std::size_t> press_end);

/// marker,row,column,vertex0,…,weight2: how markers.npy comes from positions.npy. Weights read back to the same bits.
std::string markers_csv(const std::vector<Marker>& markers);

/// Where a marker is in the grid.
struct MarkerPlace {
  int row = 0, column = 0;
};
/// Of every marker, from such a table. \throw DataError if it has no such columns or a field is no count
std::vector<MarkerPlace> read_marker_places(const std::filesystem::path& file);

}  // namespace tacipc
