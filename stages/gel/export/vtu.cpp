#include "stages/gel/export/vtu.h"

#include <fmt/core.h>

#include <bit>
#include <cassert>

namespace tacipc {
namespace {

constexpr std::uint8_t kVtkTriangle = 5, kVtkTetrahedron = 10;

/// Collects the data after the header while the header is written.
class Appended {
 public:
  /// Returns the header's line for an array and adds its values to the data.
  template <typename T>
  std::string array(const std::string& name, int components, const T* values, std::size_t count) {
    static_assert(std::endian::native == std::endian::little, "written as it lies in memory");
    const std::string line = fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type_of(values), name, components, bytes_.size());
    const std::uint64_t size = count * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values), size);
    return line;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  static const char* type_of(const double*) { return "Float64"; }
  static const char* type_of(const std::int64_t*) { return "Int64"; }
  static const char* type_of(const std::uint8_t*) { return "UInt8"; }

  std::string bytes_;
};

std::string data_arrays(const std::vector<VtuArray>& arrays, [[maybe_unused]] Eigen::Index rows, Appended& appended) {
  std::string lines;
  for (const VtuArray& array : arrays) {
    lines += std::visit(
        [&](const auto& values) {
          assert(values.size() == static_cast<std::size_t>(rows * array.components));
          return appended.array(array.name, array.components, values.data(), values.size());
        },
        array.values);
  }
  return lines;
}

}  // namespace

std::string vtu_bytes(const VtuGrid& grid) {
  assert(grid.cells.cols() == 3 || grid.cells.cols() == 4);
  const Eigen::Index num_points = grid.points.rows(), num_cells = grid.cells.rows(), corners = grid.cells.cols();
  const auto count = [](Eigen::Index n) { return static_cast<std::size_t>(n); };
  const std::vector<std::int64_t> connectivity(grid.cells.data(), grid.cells.data() + grid.cells.size());
  std::vector<std::int64_t> ends;
  for (Eigen::Index c = 1; c <= num_cells; ++c) ends.push_back(c * corners);
  const std::vector<std::uint8_t> types(count(num_cells), corners == 3 ? kVtkTriangle : kVtkTetrahedron);

  Appended appended;
  std::string file =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n";
  file += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", num_points, num_cells);
  // One statement each: arrays are appended in the order of the header.
  file += "      <Points>\n";
  file += appended.array("Points", 3, grid.points.data(), count(grid.points.size()));
  file += "      </Points>\n      <Cells>\n";
  file += appended.array("connectivity", 1, connectivity.data(), connectivity.size());
  file += appended.array("offsets", 1, ends.data(), ends.size());
  file += appended.array("types", 1, types.data(), types.size());
  file += "      </Cells>\n      <PointData>\n";
  file += data_arrays(grid.point_data, num_points, appended);
  file += "      </PointData>\n      <CellData>\n";
  file += data_arrays(grid.cell_data, num_cells, appended);
  file += "      </CellData>\n";
  file += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
  return file + appended.bytes() + "\n  </AppendedData>\n</VTKFile>\n";
}

std::string pvd_text(const std::vector<PvdEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const PvdEntry& entry : entries)
    text +=
        fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", entry.time_s, entry.part, entry.file);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace tacipc
