// What the 3-D view shows of a press: front face and object, frame by frame.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/base/types.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/contact_state.h"

namespace tacipc {

/// One frame; rows are vertices of the front.
struct ViewFrame {
  int frame = 0;                    // of the press
  Positions positions;              // m, frame S
  Eigen::VectorXd pressure_pa;      // normal traction per deformed area
  std::vector<ContactState> state;  // none, stick, slip
  Matrix4 gel_from_object;
};

struct PressView {
  Triangles front;  // indices into rows of a frame, counter-clockwise seen from outside
  double bottom_m = 0.0;
  std::vector<ViewFrame> frames;  // the first is rest
  TriangleMesh object;
};

/// Frames of the press that a view has: all, or where they are many as many evenly chosen ones as keep its data small,
/// the first and the last among them. \pre frames ≥ 1
std::vector<int> viewed_frames(int frames, std::size_t front_vertices);

/// Pressure p_v = −f_v · n_v / A_v of every vertex, where it is positive, else 0. A_v is a third of the area of the
/// triangles around the vertex, n_v their mean outward normal, f_v (N) the normal contact force on it; Pa.
Eigen::VectorXd vertex_pressures(const Positions& x, const Triangles& triangles, const Positions& normal_force_n);

/// The view of a finished press. Nothing where the gel or the object is not there any more or has changed since, or
/// where arrays were dropped. Vertices are ordered along a curve in space, so that neighbours have similar numbers.
/// \throw DataError for what is malformed
std::optional<PressView> read_press_view(const std::filesystem::path& press_folder);

}  // namespace tacipc
