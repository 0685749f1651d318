// Objects of verification cases: surfaces of revolution, prisms, or a mesh file. Their lowest point is pressed in.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc::verify {

/// One object; lengths in metres, those that do not belong to the kind are zero.
struct ObjectShape {
  enum class Kind { sphere, punch, cone, cylinder, plate, block, wedge, file };
  Kind kind = Kind::sphere;
  double radius_m = 0.0;       // sphere, punch, cylinder; of a cone's base
  double edge_m = 0.0;         // length of surface edges where they touch
  double fine_radius_m = 0.0;  // sphere: radius about its lowest point with such edges
  double fillet_m = 0.0;       // punch: radius of its rounded rim
  double height_m = 0.0;       // punch, cone, block, wedge
  double length_m = 0.0;       // cylinder (along y), wedge (along y)
  double half_width_m = 0.0;   // plate: radius of the circle in its lower face; block, wedge: along x
  double half_depth_m = 0.0;   // block: along y
  std::string path = {};       // file; shared:… names a file of the shared data
  double unit_m = 1.0;

  static ObjectShape read(ConfigReader& in);
};

/// Closed surface, outward triangles, lowest point at z = 0 for the shapes made here (files stay as they are).
/// A sphere, cylinder or fillet is inscribed: its vertices lie on the true surface, one of them (an edge, for the
/// cylinder) lowest. A plate is a tetrahedron that stands on one large triangle: no edge runs through its face.
TriangleMesh make_object(const ObjectShape& shape, const std::filesystem::path& shared);

/// Prism along y of a convex polygon (x, z), counter-clockwise seen from −y.
TriangleMesh extrude(const std::vector<Eigen::Vector2d>& polygon, double length_m);

}  // namespace tacipc::verify
