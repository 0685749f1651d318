// Readers behind read_triangle_mesh(): each converts the bytes of one format to polygons.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Polygons as a file lists them; read_triangle_mesh() checks indices and coordinates.
struct PolygonSoup {
  std::vector<Vector3> vertices;
  std::vector<int> corners;       // vertex indices of all polygons, one after another
  std::vector<int> first_corner;  // start of each polygon in `corners`
  std::vector<int> lines;         // line of each polygon in a text file; empty for a binary one

  void add_polygon(std::span<const int> polygon);
  void add_polygon(std::span<const int> polygon, int line);
};

/// Appends the triangles of one polygon: a fan from its first corner if it is convex, ear clipping otherwise.
void triangulate_polygon(std::span<const int> polygon, const std::vector<Vector3>& vertices,
                         std::vector<int>& triangle_corners);

/// Read the bytes of a file; `name` stands for the file in messages.
/// \throw DataError if the file is damaged
PolygonSoup read_stl(std::string_view bytes, const std::string& name);
PolygonSoup read_obj(std::string_view bytes, const std::string& name);
PolygonSoup read_off(std::string_view bytes, const std::string& name);
PolygonSoup read_ply(std::string_view bytes, const std::string& name);

}  // namespace tacipc
