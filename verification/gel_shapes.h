// Gels of verification cases: a graded block of cells, a disc of rings, a disc from the tetmesh library, or a mesh
// file.
#pragma once

#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "common/config/config.h"
#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"
#include "stages/gel/tetmesh/sizing.h"

namespace tacipc::verify {

/// Crowned front: gently curved, and falling off towards the rim. Along each axis the sag is s(x) = S (x/a)² up to the
/// half size a. Beyond, the slope continues and a parabola is added that reaches the edge sag at the rim. Both axes
/// combine to z = −√(s_x² + s_y²).
struct Crown {
  double half_x_m = 0.0, half_y_m = 0.0, sag_m = 0.0, edge_sag_m = 0.0;
};

/// Block −width/2 ≤ x ≤ width/2, −height/2 ≤ y ≤ height/2, −thickness ≤ z ≤ 0 of graded cells. Cells are `near_m` wide
/// up to `near_half_m` from the axis; farther out each is `growth` times the previous one, at most `far_m`. In depth
/// the first layer at the front is `layer_m` thick, and layers grow by `layer_growth`. Each cell is six tetrahedra
/// (Kuhn), mirrored from cell to cell so that no direction is preferred.
struct BoxGel {
  double width_m = 0.0, height_m = 0.0, thickness_m = 0.0;
  double near_m = 0.0, near_half_m = 0.0, growth = 1.0, far_m = 0.0;
  double layer_m = 0.0, layer_growth = 1.0;
  std::optional<double> corner_cut_m =
      {};  // legs of the triangle that is cut off at each corner, which is one cell there, m
  std::optional<Crown> crown = {};
};

/// Disc made of rings. Every ring has the same even number of sectors, so that the mesh can be arbitrarily fine along
/// the radius. Between the two radii of the focus, rings are `near_m` apart, and one ring lies on each of the two.
/// Inwards and outwards from there each distance is `growth` times the previous one, at most `far_m`. Layers and cells
/// are as in BoxGel.
struct RingGel {
  double radius_m = 0.0, thickness_m = 0.0;
  int sectors = 0;
  double focus_from_m = 0.0, focus_to_m = 0.0;
  double near_m = 0.0, growth = 1.0, far_m = 0.0;
  double layer_m = 0.0, layer_growth = 1.0;
};

/// Disc from the tetmesh library.
struct DiscGel {
  double radius_m = 0.0, thickness_m = 0.0;
  SizingConfig sizing;
};

/// Mesh file. The mesh is scaled, turned by half a turn about x if `flip` is set, then lifted so that its highest point
/// is at z = 0.
struct FileGel {
  std::string path;  // shared:… names a file of the shared data
  double unit_m = 1.0;
  Vector3 scale = Vector3::Ones();
  bool flip = false;
};

/// Section `gel` of a case.
struct GelSpec {
  std::variant<BoxGel, RingGel, DiscGel, FileGel> shape;

  static GelSpec read(ConfigReader& in);
};

/// Coordinates of the cell borders along one axis of a box, symmetric about 0, an even number of cells.
std::vector<double> graded_lines(double half_m, double near_m, double near_half_m, double growth, double far_m,
                                 std::optional<double> last_m);

/// Radii of the rings, from 0 to the rim.
std::vector<double> ring_radii(const RingGel& gel);

/// Builds the tagged mesh: the lowest plane is glued, faces that look within 60° of +z are front, the rest is side.
/// \throw DataError for a file that cannot be read
TetMesh make_gel(const GelSpec& spec, const std::filesystem::path& shared);

/// Gel shape for the press: outline of the bounding box, and thickness.
GelShape shape_of(const GelSpec& spec, const TetMesh& gel);

}  // namespace tacipc::verify
