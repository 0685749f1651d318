// Objects of verification cases: surfaces of revolution, prisms, or a mesh file. The lowest point touches first.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc::verify {

/// One object. Lengths are in metres; lengths that do not apply to the kind are zero.
struct ObjectShape {
  enum class Kind { sphere, punch, cone, cylinder, plate, block, wedge, file };
  Kind kind = Kind::sphere;
  double radius_m = 0.0;       // radius of a sphere, punch or cylinder, or of a cone's base
  double edge_m = 0.0;         // length of surface edges in the contact region
  double fine_radius_m = 0.0;  // sphere: radius around its lowest point in which edges have the length `edge_m`
  double fillet_m = 0.0;       // punch: radius of its rounded rim
  double height_m = 0.0;       // height of a punch, cone, block or wedge
  double length_m = 0.0;       // length of a cylinder or wedge along y
  double half_width_m = 0.0;   // plate: radius of the circle in its lower face; block, wedge: half width along x
  double half_depth_m = 0.0;   // block: half width along y
  std::string path = {};       // file: its path; shared:… names a file of the shared data
  double unit_m = 1.0;

  static ObjectShape read(ConfigReader& in);
};

/// Builds the closed surface with outward triangles. Generated shapes have their lowest point at z = 0; files stay as
/// they are. A sphere, cylinder or fillet is inscribed: its vertices lie on the true surface, and a vertex (for a
/// cylinder an edge) is lowest. A plate is a tetrahedron that stands on one large triangle, so no edge crosses its
/// face.
TriangleMesh make_object(const ObjectShape& shape, const std::filesystem::path& shared);

/// Prism along y over a convex polygon (x, z), counter-clockwise if seen from −y.
TriangleMesh extrude(const std::vector<Eigen::Vector2d>& polygon, double length_m);

}  // namespace tacipc::verify
