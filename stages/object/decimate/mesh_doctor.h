// Mesh doctor: turns a scan into a closed, consistently oriented surface, or reports its defects.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/object.h"
#include "stages/object/decimate/side_solid.h"
#include "stages/object/decimate/side_survey.h"

namespace tacipc {

/// Limits of the repairs. Relative lengths are fractions of the mesh's largest extent.
struct DoctorConfig {
  double min_extent_m = 0.5e-3;  // extents outside this range suggest a wrong unit
  double max_extent_m = 0.5;
  double relative_weld_distance = 1e-6;  // distance within which open vertices merge
  int max_hole_edges = 128;              // holes with more edges or a longer boundary are an error
  double relative_max_hole_length = 0.3;
  double debris_area_fraction = 1e-4;  // parts with a smaller fraction of the area are removed
  bool refuse_self_intersections = false;
  std::optional<double> sheet_thickness_m =
      std::nullopt;  // thickness of plates made from open parts; absent: open parts are an error
  std::optional<SideConfig> height_field = std::nullopt;  // solid of one side, if no repair closes the surface
  std::optional<SensorWindow> window = std::nullopt;      // field of view by which kMostRelief is judged
  std::string unit = "mm";                                // assumed unit of the file's numbers
};

/// Solid of one side of a surface that no repair closes.
struct SideTaken {
  std::string side;
  std::string reason;  // defect of the surface
  SideError error;
};

/// Defects found and repairs made.
struct DoctorReport {
  std::int64_t unreferenced_vertices = 0;  // removed
  std::int64_t merged_vertices = 0;
  std::int64_t degenerate_faces = 0;  // faces without area: removed, or edge flipped
  std::int64_t duplicate_faces = 0;   // removed
  std::int64_t reoriented_faces = 0;
  std::int64_t separated_edges = 0;  // edges where three or more faces met
  std::int64_t split_vertices = 0;   // vertices where two sheets met
  std::int64_t filled_holes = 0;
  std::int64_t hole_faces = 0;              // faces added to fill holes
  std::int64_t debris_components = 0;       // removed
  std::int64_t flat_components = 0;         // closed parts without volume: removed
  std::int64_t hidden_components = 0;       // parts inside another, which nothing can touch: removed
  std::int64_t thickened_sheets = 0;        // open parts turned into plates
  std::int64_t components = 0;              // kept
  std::int64_t overlapping_components = 0;  // pairs of parts that cross: treated as their union
  std::int64_t self_intersections = 0;      // pairs of faces of one component that cross
  std::optional<SideTaken> height_field = std::nullopt;

  bool changed_mesh() const;
};

/// Repairs everything that needs no guess, and logs it. In the result every edge is in exactly two faces of opposite
/// direction, each vertex has one fan of faces, no face lacks area, and faces look outwards. A mesh without defects is
/// returned bit by bit. A surface that stays open, one-sided or without volume is replaced by the solid of one side if
/// the configuration names a side.
/// \throw DataError, with position and numbers, if it names no side, or for a wrong scale
TriangleMesh treat_mesh(TriangleMesh mesh, const DoctorConfig& config, DoctorReport& report);

}  // namespace tacipc
