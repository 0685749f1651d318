// Small valid files of every format, made as bytes, for tests of the readers.
#pragma once

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace tacipc {

/// Appends numbers as bytes of either order.
struct Bytes {
  std::string text;
  std::endian order = std::endian::little;

  template <typename T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i)
      text.push_back(raw[order == std::endian::native ? i : sizeof(T) - 1 - i]);
    return *this;
  }
  Bytes& raw(std::string_view bytes) {
    text += bytes;
    return *this;
  }
};

inline constexpr double kTetPoints[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline constexpr int kTetFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline std::string tetrahedron_obj() {
  return "# a comment\no tet\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

inline std::string tetrahedron_off() {
  return "OFF\n# counts\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string tetrahedron_ascii_stl() {
  std::string text = "solid facet of a tet\n";
  for (const auto& face : kTetFaces) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int corner : face) {
      text += "   vertex";
      for (const double x : kTetPoints[corner]) text += fmt::format(" {}", x);
      text += "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid\n";
}

inline std::string tetrahedron_binary_stl(std::string header = "solid but binary") {
  header.resize(80, ' ');
  Bytes bytes;
  bytes.raw(header).add(std::uint32_t{4});
  for (const auto& face : kTetFaces) {
    for (int i = 0; i < 3; ++i) bytes.add(0.0f);
    for (const int corner : face)
      for (const double x : kTetPoints[corner]) bytes.add(static_cast<float>(x));
    bytes.add(std::uint16_t{0});
  }
  return bytes.text;
}

/// With a property and an element that nobody asked for, and float coordinates behind a colour.
inline std::string tetrahedron_ply(const std::string& format) {
  Bytes bytes;
  bytes.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  bytes.raw(
      "ply\nformat " + format +
      " 1.0\ncomment end_header follows\nelement camera 1\nproperty list uint8 short views\nproperty double zoom\n"
      "element vertex 4\nproperty uchar red\nproperty float x\nproperty double y\nproperty float32 z\n"
      "element face 4\nproperty list uchar uint vertex_indices\nproperty int material\nend_header\n");
  if (format == "ascii") {
    bytes.raw("2 -1 3 0.5\n");
    for (const auto& p : kTetPoints) bytes.raw(fmt::format("255 {} {} {}\n", p[0], p[1], p[2]));
    for (const auto& f : kTetFaces) bytes.raw(fmt::format("3 {} {} {} 7\n", f[0], f[1], f[2]));
    return bytes.text;
  }
  bytes.add(std::uint8_t{2}).add(std::int16_t{-1}).add(std::int16_t{3}).add(0.5);
  for (const auto& p : kTetPoints)
    bytes.add(std::uint8_t{255}).add(static_cast<float>(p[0])).add(p[1]).add(static_cast<float>(p[2]));
  for (const auto& f : kTetFaces) {
    bytes.add(std::uint8_t{3});
    for (const int corner : f) bytes.add(static_cast<std::uint32_t>(corner));
    bytes.add(std::int32_t{7});
  }
  return bytes.text;
}

/// One tetrahedron whose nodes are numbered 10, 30, 20, 40, and one triangle with physical tag 2.
inline std::string msh22_ascii() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 2 \"side\"\n$EndPhysicalNames\n$Nodes\n4\n"
         "10 0 0 0\n30 1 0 0\n20 0 1 0\n40 0 0 1\n$EndNodes\n$Elements\n3\n1 15 2 0 1 10\n2 2 2 2 5 10 20 30\n"
         "3 4 2 9 1 10 30 20 40\n$EndElements\n";
}

inline std::string msh22_binary(std::endian order) {
  constexpr int kNumbers[4] = {10, 30, 20, 40};
  Bytes bytes;
  bytes.order = order;
  bytes.raw("$MeshFormat\n2.2 1 8\n").add(1).raw("\n$EndMeshFormat\n$Nodes\n4\n");
  for (int i = 0; i < 4; ++i) {
    bytes.add(kNumbers[i]);
    for (const double x : kTetPoints[i]) bytes.add(x);
  }
  bytes.raw("\n$EndNodes\n$Elements\n2\n");
  bytes.add(2).add(1).add(2).add(1).add(2).add(5).add(10).add(20).add(30);
  bytes.add(4).add(1).add(2).add(2).add(9).add(1).add(10).add(30).add(20).add(40);
  return bytes.raw("\n$EndElements\n").text;
}

inline std::string msh41_ascii() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 1 1\n1 0 0 0 0\n1 0 0 0 1 0 0 0 0\n"
         "5 0 0 0 1 1 0 1 2 0\n1 0 0 0 1 1 1 1 9 1 5\n$EndEntities\n$Nodes\n2 4 10 40\n2 5 0 3\n10\n30\n20\n0 0 0\n"
         "1 0 0\n0 1 0\n3 1 0 1\n40\n0 0 1\n$EndNodes\n$Elements\n2 2 1 2\n2 5 2 1\n1 10 20 30\n3 1 4 1\n"
         "2 10 30 20 40\n$EndElements\n";
}

inline std::string msh41_binary(std::endian order) {
  using Size = std::uint64_t;
  Bytes bytes;
  bytes.order = order;
  const auto sizes = [&](std::vector<Size> values) {
    for (const Size value : values) bytes.add(value);
  };
  const auto bounds = [&](int n) {
    for (int i = 0; i < n; ++i) bytes.add(0.25 * i);
  };
  bytes.raw("$MeshFormat\n4.1 1 8\n").add(1).raw("\n$EndMeshFormat\n$Entities\n");
  sizes({1, 0, 1, 1});
  bytes.add(1);
  bounds(3);
  sizes({0});
  bytes.add(5);
  bounds(6);
  sizes({1});
  bytes.add(2);
  sizes({0});
  bytes.add(1);
  bounds(6);
  sizes({1});
  bytes.add(9);
  sizes({1});
  bytes.add(5);
  bytes.raw("\n$EndEntities\n$Nodes\n");
  sizes({1, 4, 10, 40});
  bytes.add(3).add(1).add(0);
  sizes({4, 10, 30, 20, 40});
  for (const auto& point : kTetPoints)
    for (const double x : point) bytes.add(x);
  bytes.raw("\n$EndNodes\n$Elements\n");
  sizes({2, 2, 1, 2});
  bytes.add(2).add(5).add(2);
  sizes({1, 1, 10, 20, 30});
  bytes.add(3).add(1).add(4);
  sizes({1, 2, 10, 30, 20, 40});
  return bytes.raw("\n$EndElements\n").text;
}

inline std::string npy_bytes(const std::string& descr, const std::string& more, const std::string& data) {
  std::string header = "{'descr': '" + descr + "', " + more + "}";
  header.resize(117, ' ');
  header += "\n";
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(118) + '\0' + header + data;
}

}  // namespace tacipc
