// The mesh doctor: turns a scan into a closed, consistently oriented surface, or says what is wrong with it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/object.h"
#include "stages/object/decimate/side_solid.h"
#include "stages/object/decimate/side_survey.h"

namespace tacipc {

/// How far the doctor may go. Lengths called relative are fractions of the mesh's largest extent.
struct DoctorConfig {
  double min_extent_m = 0.5e-3;  // smaller or larger: the unit is probably wrong
  double max_extent_m = 0.5;
  double relative_weld_distance = 1e-6;  // open vertices this near become one
  int max_hole_edges = 128;              // holes with more edges, or longer around, are refused
  double relative_max_hole_length = 0.3;
  double debris_area_fraction = 1e-4;  // parts with less of the area are removed
  bool refuse_self_intersections = false;
  std::optional<double> sheet_thickness_m = std::nullopt;  // plates of this instead of refusing what is open
  std::optional<SideConfig> height_field = std::nullopt;   // of one side, where no repair closes the surface
  std::optional<SensorWindow> window = std::nullopt;       // what kMostRelief is judged by
  std::string unit = "mm";                                 // that the file's numbers were taken for
};

/// A surface that no repair closed, as one side of it shows it.
struct SideTaken {
  std::string side;
  std::string reason;  // what was wrong with the surface
  SideError error;
};

/// What was found and done.
struct DoctorReport {
  std::int64_t unreferenced_vertices = 0;  // removed
  std::int64_t merged_vertices = 0;
  std::int64_t degenerate_faces = 0;  // without area: removed, or turned away by an edge flip
  std::int64_t duplicate_faces = 0;   // removed
  std::int64_t reoriented_faces = 0;
  std::int64_t separated_edges = 0;  // where three or more faces met
  std::int64_t split_vertices = 0;   // where two sheets met in one vertex
  std::int64_t filled_holes = 0;
  std::int64_t hole_faces = 0;              // added to fill them
  std::int64_t debris_components = 0;       // removed
  std::int64_t flat_components = 0;         // closed, without volume: removed
  std::int64_t hidden_components = 0;       // inside another: removed, nothing can touch them
  std::int64_t thickened_sheets = 0;        // open parts made plates
  std::int64_t components = 0;              // kept
  std::int64_t overlapping_components = 0;  // pairs that cross: taken as their union
  std::int64_t self_intersections = 0;      // pairs of faces of one component that cross
  std::optional<SideTaken> height_field = std::nullopt;

  bool changed_mesh() const;
};

/// Repairs what can be repaired without guessing and logs it. The result has every edge in exactly two faces of
/// opposite direction, one fan of faces around each vertex, no face without area and outward faces; where nothing was
/// wrong it is the input, bit by bit. What stays open, one-sided or without volume is replaced by the solid of one side
/// if the configuration names one. \throw DataError otherwise, and for wrong scale, with place and numbers.
TriangleMesh treat_mesh(TriangleMesh mesh, const DoctorConfig& config, DoctorReport& report);

}  // namespace tacipc
