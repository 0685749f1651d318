// A small reader of VTU files with raw appended data that goes by their headers alone, as a VTK reader does.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace tacipc {

struct VtuFile {
  struct Array {
    std::string section;  // Points, Cells, PointData, CellData
    std::string type;
    std::size_t components = 0;
    std::vector<double> values;
  };
  std::size_t points = 0, cells = 0;
  std::map<std::string, Array> arrays;
};

inline std::string attribute(const std::string& element, const std::string& name) {
  const std::size_t at = element.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 3;
  return element.substr(from, element.find('"', from) - from);
}

template <typename T>
std::vector<double> values_of(const char* data, std::size_t bytes) {
  std::vector<T> raw(bytes / sizeof(T));
  std::memcpy(raw.data(), data, raw.size() * sizeof(T));
  return {raw.begin(), raw.end()};
}

/// Reads what vtu_bytes wrote; whatever does not fit is a test failure.
inline VtuFile parse_vtu(const std::string& bytes) {
  VtuFile file;
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t data_at = bytes.find(mark) + mark.size();
  std::size_t used = 0;
  std::string section;
  for (std::size_t at = bytes.find('<'); at < data_at; at = bytes.find('<', at + 1)) {
    const std::string element = bytes.substr(at + 1, bytes.find('>', at) - at - 1);
    const std::string tag = element.substr(0, element.find_first_of(" >"));
    if (tag == "VTKFile") {
      EXPECT_EQ(attribute(element, "type"), "UnstructuredGrid");
      EXPECT_EQ(attribute(element, "byte_order"), "LittleEndian");
      EXPECT_EQ(attribute(element, "header_type"), "UInt64");
    } else if (tag == "Piece") {
      file.points = std::stoul(attribute(element, "NumberOfPoints"));
      file.cells = std::stoul(attribute(element, "NumberOfCells"));
    } else if (tag == "Points" || tag == "Cells" || tag == "PointData" || tag == "CellData") {
      section = tag;
    } else if (tag == "DataArray") {
      EXPECT_EQ(attribute(element, "format"), "appended");
      const std::size_t offset = std::stoul(attribute(element, "offset"));
      EXPECT_EQ(offset, used) << element;
      std::uint64_t size = 0;
      std::memcpy(&size, bytes.data() + data_at + offset, sizeof size);
      used = offset + sizeof size + size;
      if (data_at + used > bytes.size()) {
        ADD_FAILURE() << element << " ends after the file";
        return file;
      }
      const char* data = bytes.data() + data_at + offset + sizeof size;
      VtuFile::Array array{
          section, attribute(element, "type"), std::stoul(attribute(element, "NumberOfComponents")), {}};
      if (array.type == "Float64") array.values = values_of<double>(data, size);
      if (array.type == "Int64") array.values = values_of<std::int64_t>(data, size);
      if (array.type == "UInt8") array.values = values_of<std::uint8_t>(data, size);
      const bool per_point = section == "Points" || section == "PointData";
      if (array.type != "Int64") {
        EXPECT_EQ(array.values.size(), array.components * (per_point ? file.points : file.cells)) << element;
      }
      file.arrays[attribute(element, "Name")] = array;
    }
  }
  EXPECT_EQ(bytes.substr(data_at + used), "\n  </AppendedData>\n</VTKFile>\n");
  return file;
}

}  // namespace tacipc
