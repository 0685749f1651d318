// A finished press of a gel of six tetrahedra, as files.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "common/format/npy.h"
#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "tests/scratch_folder.h"

namespace tacipc {

/// A cube of a centimetre with its front at z = 0 and glued at z = −0.01. Vertex i + 2 j + 4 k is at its corner
/// (i, j, k), so 4 to 7 are the front; vertex 8 hangs in no tetrahedron's boundary: it is the centre of all.
inline TetMesh cube_gel() {
  TetMesh gel;
  gel.positions.resize(9, 3);
  for (int v = 0; v < 8; ++v) gel.positions.row(v) << 0.01 * (v & 1), 0.01 * (v >> 1 & 1), 0.01 * (v >> 2) - 0.01;
  gel.positions.row(8) << 0.005, 0.005, -0.005;
  const std::array<std::array<int, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  gel.tets.resize(12, 4);
  for (int s = 0; s < 6; ++s) {
    const auto& q = sides[static_cast<std::size_t>(s)];
    gel.tets.row(2 * s) << 8, q[0], q[1], q[2];
    gel.tets.row(2 * s + 1) << 8, q[0], q[2], q[3];
  }
  gel.boundary = boundary_triangles(gel.tets, 9);
  for (Eigen::Index f = 0; f < 12; ++f) {
    const double low = std::min({gel.positions(gel.boundary(f, 0), 2), gel.positions(gel.boundary(f, 1), 2),
                                 gel.positions(gel.boundary(f, 2), 2)});
    const double high = std::max({gel.positions(gel.boundary(f, 0), 2), gel.positions(gel.boundary(f, 1), 2),
                                  gel.positions(gel.boundary(f, 2), 2)});
    gel.tags.push_back(low > -0.001 ? BoundaryTag::front : high < -0.009 ? BoundaryTag::glued : BoundaryTag::side);
  }
  return gel;
}

/// Writes gel.msh, object.ply and press/ with two frames, in the second of which the whole gel is compressed to 80 %
/// along z, the object turned by a right angle about z and moved by (1, 2, 3), vertex 5 sticks and vertex 7 slips.
inline void write_pressed_cube(const ScratchFolder& scratch) {
  const TetMesh gel = cube_gel();
  write_tet_mesh(scratch / "gel.msh", gel);
  write_ply(scratch / "object.ply", {Positions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}},
                                     Triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}});
  scratch.file("press/press.yaml",
               fmt::format("stage: press\ninputs:\n  gel:\n    path: ../gel.msh\n    hash: {}\n  object:\n    path: "
                           "../object.ply\n    hash: {}\n",
                           content_hash(scratch / "gel.msh"), content_hash(scratch / "object.ply")));
  Positions pressed = gel.positions;
  pressed.col(2) = (pressed.col(2).array() + 0.01) * 0.8 - 0.01;
  std::vector<double> positions(gel.positions.data(), gel.positions.data() + 27);
  positions.insert(positions.end(), pressed.data(), pressed.data() + 27);
  write_npy(scratch / "press/positions.npy", {2, 9, 3}, positions.data());
  const std::vector<double> poses{1, 0,  0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                  0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
  write_npy(scratch / "press/object_pose.npy", {2, 4, 4}, poses.data());
  const std::vector<double> times{0.0, 0.01};
  write_npy(scratch / "press/time.npy", {2}, times.data());
  const std::vector<std::int32_t> front{4, 5, 6, 7};
  write_npy(scratch / "press/front_vertices.npy", {4}, front.data());
  std::vector<double> force(2 * 4 * 2 * 3, 0.0);
  for (const std::size_t v : {1u, 3u}) {  // vertices 5 and 7 in frame 1
    force[((4 + v) * 2 + 0) * 3 + 2] = -1.0 - static_cast<double>(v);
    force[((4 + v) * 2 + 1) * 3 + 0] = 0.25 * static_cast<double>(v);
  }
  write_npy(scratch / "press/contact_force.npy", {2, 4, 2, 3}, force.data());
  const std::vector<std::uint8_t> states{0, 0, 0, 0, 0, 1, 0, 2};
  write_npy(scratch / "press/contact_state.npy", {2, 4}, states.data());
}

}  // namespace tacipc
