// The single treatments of the mesh doctor, in the order they are applied.
#pragma once

#include "stages/object/decimate/mesh_doctor.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {

/// Vertices of open edges at the same place, then those within the distance, become one: the one of lowest index.
void weld_open_vertices(TriangleMesh& mesh, double distance_m, DoctorReport& report);

/// Removes faces that name a vertex twice, pulls faces with two corners at one place together, and turns the longest
/// edge of other faces without area over to their neighbour.
void remove_degenerate_faces(TriangleMesh& mesh, DoctorReport& report);

/// Of faces with the same three vertices one stays if an edge needs it, else none.
void remove_duplicate_faces(TriangleMesh& mesh, DoctorReport& report);

/// Gives the faces of an edge that three or more share vertices of their own, two faces each: each face stays with its
/// neighbour across matter, the narrowest wedge first. What has no partner stays open. Nothing moves; where sheets
/// share both ends of an edge, each gets a vertex in its middle.
void separate_sheets(TriangleMesh& mesh, DoctorReport& report);

/// Removes parts with fewer than four faces or less than the given fraction of the area; the largest always stays.
void remove_debris(TriangleMesh& mesh, double area_fraction, DoctorReport& report);

/// Makes neighbours agree on the outside and each part enclose a positive volume (as far as it is closed).
/// \throw DataError for one-sided surfaces.
void orient_consistently(TriangleMesh& mesh, DoctorReport& report);

/// Gives each fan of faces around a vertex a vertex of its own; the first fan keeps the old one.
void split_vertices(TriangleMesh& mesh, DoctorReport& report);
/// The same for fans of faces that are neighbours by `opposite`.
void split_fans(TriangleMesh& mesh, const std::vector<int>& opposite, DoctorReport& report);

struct HoleLimits {
  int max_edges;
  double max_length_m;
  bool leave_larger = false;  // instead of refusing them
};
/// Closes each boundary loop by the triangulation of least area without new vertices.
/// \throw DataError `open mesh: …` for loops beyond the limits.
void fill_holes(TriangleMesh& mesh, const HoleLimits& limits, DoctorReport& report);

/// Makes a plate of each part that is open: its faces half the thickness outwards, a copy of them, turned over, half of
/// it inwards, and walls along its edge.
void thicken_open_parts(TriangleMesh& mesh, double thickness_m, DoctorReport& report);

/// Removes closed parts that enclose no volume. \throw DataError if there is no other part.
void remove_flat_parts(TriangleMesh& mesh, DoctorReport& report);

/// Counts crossings and removes parts that lie wholly inside another.
void examine_components(TriangleMesh& mesh, DoctorReport& report);

}  // namespace tacipc
