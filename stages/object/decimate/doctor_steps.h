// Individual steps of the mesh doctor, in the order in which they are applied.
#pragma once

#include "stages/object/decimate/mesh_doctor.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {

/// Merges vertices of open edges at the same position, then those within the distance, into the one of lowest index.
void weld_open_vertices(TriangleMesh& mesh, double distance_m, DoctorReport& report);

/// Removes faces that name a vertex twice, merges two corners of a face at the same position, and flips the longest
/// edge of other faces without area.
void remove_degenerate_faces(TriangleMesh& mesh, DoctorReport& report);

/// Removes duplicate faces: of faces with the same three vertices one stays if an edge needs it, otherwise none.
void remove_duplicate_faces(TriangleMesh& mesh, DoctorReport& report);

/// Separates sheets at edges that three or more faces share: the faces get their own vertices, two faces each. Each
/// face stays with its neighbour across the solid, the narrowest wedge first. Faces without a partner stay open. No
/// vertex moves; if sheets share both ends of an edge, each gets a vertex in its middle.
void separate_sheets(TriangleMesh& mesh, DoctorReport& report);

/// Removes parts with fewer than four faces or less than the given fraction of the area; the largest part always stays.
void remove_debris(TriangleMesh& mesh, double area_fraction, DoctorReport& report);

/// Orients neighbours consistently, and each part outwards: its enclosed volume, as far as it is closed, is positive.
/// \throw DataError for one-sided surfaces
void orient_consistently(TriangleMesh& mesh, DoctorReport& report);

/// Gives each fan of faces around a vertex a vertex of its own; the first fan keeps the old one.
void split_vertices(TriangleMesh& mesh, DoctorReport& report);
/// Gives each fan of faces that are neighbours by `opposite` a vertex of its own; the first fan keeps the old one.
void split_fans(TriangleMesh& mesh, const std::vector<int>& opposite, DoctorReport& report);

/// Limits of holes that may be filled.
struct HoleLimits {
  int max_edges;
  double max_length_m;
  bool leave_larger = false;  // leave larger holes open instead of throwing
};
/// Closes each boundary loop by the triangulation of least area without new vertices.
/// \throw DataError `open mesh: …` for loops beyond the limits.
void fill_holes(TriangleMesh& mesh, const HoleLimits& limits, DoctorReport& report);

/// Turns each open part into a plate: its faces half the thickness outwards, a reversed copy half the thickness
/// inwards, and walls along the boundary.
void thicken_open_parts(TriangleMesh& mesh, double thickness_m, DoctorReport& report);

/// Removes closed parts that enclose no volume.
/// \throw DataError if there is no other part.
void remove_flat_parts(TriangleMesh& mesh, DoctorReport& report);

/// Counts crossings and removes parts that lie wholly inside another.
void examine_components(TriangleMesh& mesh, DoctorReport& report);

}  // namespace tacipc
