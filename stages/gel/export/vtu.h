// Writes VTK XML files for ParaView: unstructured grids (.vtu) and collections of them over time (.pvd).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Values per point or cell, row after row.
struct VtuArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::uint8_t>> values;  // Float64 or UInt8
};

/// Triangles (three columns) or tetrahedra (four columns) between points.
struct VtuGrid {
  Positions points;
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> cells;
  std::vector<VtuArray> point_data = {};
  std::vector<VtuArray> cell_data = {};
};

/// Bytes of a .vtu file: an XML header and, after the underscore of its AppendedData, for each array its size in bytes
/// as UInt64 and its values, all little-endian. Offsets in the header count from that underscore. The same grid gives
/// the same bytes.
/// \pre each array has its components for every point or cell
std::string vtu_bytes(const VtuGrid& grid);

/// One entry of a collection; `file` is relative to the collection.
struct PvdEntry {
  double time_s = 0.0;
  std::string file;
  std::size_t part = 0;  // index among the grids shown at the same time
};

/// Text of a .pvd file, which lists grids over time.
std::string pvd_text(const std::vector<PvdEntry>& entries);

}  // namespace tacipc
