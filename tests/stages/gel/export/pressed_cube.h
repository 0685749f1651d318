// A finished press of a gel of twelve tetrahedra, as files, a grasp of two of them, and a scene of one among bodies.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

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

/// Writes gel.msh, object.ply and the press folder with two frames, in the second of which the whole gel is compressed
/// to 80 % along z, the object turned by a right angle about z and moved by (1, 2, 3), vertex 5 sticks and vertex 7
/// slips.
inline void write_pressed_cube(const ScratchFolder& scratch, const std::string& press = "press") {
  const TetMesh gel = cube_gel();
  write_tet_mesh(scratch / "gel.msh", gel);
  write_ply(scratch / "object.ply", {Positions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}},
                                     Triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}});
  const std::string up = std::filesystem::path(".").lexically_relative(press).string();
  scratch.file(press + "/press.yaml",
               fmt::format("stage: press\ninputs:\n  gel:\n    path: {0}/gel.msh\n    hash: {1}\n  object:\n    path: "
                           "{0}/object.ply\n    hash: {2}\n",
                           up, content_hash(scratch / "gel.msh"), content_hash(scratch / "object.ply")));
  Positions pressed = gel.positions;
  pressed.col(2) = (pressed.col(2).array() + 0.01) * 0.8 - 0.01;
  std::vector<double> positions(gel.positions.data(), gel.positions.data() + 27);
  positions.insert(positions.end(), pressed.data(), pressed.data() + 27);
  write_npy(scratch / (press + "/positions.npy"), {2, 9, 3}, positions.data());
  const std::vector<double> poses{1, 0,  0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                  0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
  write_npy(scratch / (press + "/object_pose.npy"), {2, 4, 4}, poses.data());
  const std::vector<double> times{0.0, 0.01};
  write_npy(scratch / (press + "/time.npy"), {2}, times.data());
  const std::vector<std::int32_t> front{4, 5, 6, 7};
  write_npy(scratch / (press + "/front_vertices.npy"), {4}, front.data());
  std::vector<double> force(2 * 4 * 2 * 3, 0.0);
  for (const std::size_t v : {1u, 3u}) {  // vertices 5 and 7 in frame 1
    force[((4 + v) * 2 + 0) * 3 + 2] = -1.0 - static_cast<double>(v);
    force[((4 + v) * 2 + 1) * 3 + 0] = 0.25 * static_cast<double>(v);
  }
  write_npy(scratch / (press + "/contact_force.npy"), {2, 4, 2, 3}, force.data());
  const std::vector<std::uint8_t> states{0, 0, 0, 0, 0, 1, 0, 2};
  write_npy(scratch / (press + "/contact_state.npy"), {2, 4}, states.data());
}

/// World from left and right finger of the scene below, in each of its two frames: their z axes along x and −x, moving.
inline std::vector<Matrix4> pressed_scene_fingers() {
  const auto finger = [](double side, double x, double z) {
    Matrix4 pose = Matrix4::Identity();
    pose.topLeftCorner<3, 3>() << 0, 0, side, -side, 0, 0, 0, -1, 0;  // columns: x, y = down, z
    pose.topRightCorner<3, 1>() << x, 0.001, z;
    return pose;
  };
  return {finger(1, -0.02, 0), finger(-1, 0.02, 0), finger(1, -0.015, 0.005), finger(-1, 0.015, 0.005)};
}

/// Writes the gel, the object and a grasp's folder scene/ with two such presses in it; the object falls by 3 mm.
inline void write_pressed_scene(const ScratchFolder& scratch) {
  for (const char* side : {"left", "right"}) write_pressed_cube(scratch, fmt::format("scene/{}/press", side));
  scratch.file("scene/press.yaml",
               fmt::format("stage: press\ninputs:\n  gel:\n    path: ../gel.msh\n    hash: {}\n  object:\n    path: "
                           "../object.ply\n    hash: {}\n",
                           content_hash(scratch / "gel.msh"), content_hash(scratch / "object.ply")));
  const std::vector<double> times{0.0, 0.01};
  write_npy(scratch / "scene/time.npy", {2}, times.data());
  const auto write_poses = [&](const char* file, const std::vector<std::size_t>& shape,
                               const std::vector<Matrix4>& poses) {
    std::vector<double> values;
    for (const Matrix4& pose : poses)
      for (int i = 0; i < 16; ++i) values.push_back(pose(i / 4, i % 4));
    write_npy(scratch / file, shape, values.data());
  };
  write_poses("scene/finger_pose.npy", {2, 2, 4, 4}, pressed_scene_fingers());
  Matrix4 fallen = Matrix4::Identity();
  fallen(2, 3) = -0.003;
  write_poses("scene/object_world_pose.npy", {2, 4, 4}, {Matrix4::Identity(), fallen});
}

/// Writes a scene's folder bodies/ of two frames: the gel `pad` pressed as above, a soft cube `ball` of the same
/// tetrahedra half a metre higher, whose vertices all rise by 1 mm, a rigid `peg` that falls by 3 mm and a fixed `wall`
/// whose mesh is the peg's in millimetres. In frame 1 the peg pushes the pad down with 2 N and the wall along x with 1
/// N.
inline void write_pressed_bodies(const ScratchFolder& scratch) {
  write_pressed_cube(scratch, "bodies/gels/pad/press");
  TetMesh soft = cube_gel();
  soft.tags.assign(soft.tags.size(), BoundaryTag::free);
  write_tet_mesh(scratch / "ball.msh", soft);
  std::string record = "stage: press\ninputs:\n";
  for (const auto& [input, file] : {std::pair{"gel", "gel.msh"},
                                    {"body_ball", "ball.msh"},
                                    {"body_peg", "object.ply"},
                                    {"body_wall", "object.ply"}})
    record += fmt::format("  {}:\n    path: ../{}\n    hash: {}\n", input, file, content_hash(scratch / file));
  record +=
      "summary:\n  bodies:\n    - {name: pad, kind: gel}\n    - {name: ball, kind: soft}\n"
      "    - {name: peg, kind: rigid, metres_per_unit: 1, mass_kg: 0.1}\n"
      "    - {name: wall, kind: fixed, metres_per_unit: 0.001}\n"
      "  held:\n    - {body: peg, freed_frame: 0, slip_m: 0.003, turn_rad: 0, rise_m: -0.003, hand_rise_m: 0}\n"
      "  per_frame:\n    - {time_s: 0, phase: -1}\n    - {time_s: 0.01, phase: 0}\n";
  scratch.file("bodies/press.yaml", record);
  const std::vector<double> times{0.0, 0.01};
  write_npy(scratch / "bodies/time.npy", {2}, times.data());
  std::vector<double> poses, positions;
  for (int frame = 0; frame < 2; ++frame) {
    for (int body = 0; body < 4; ++body) {
      Matrix4 pose = Matrix4::Identity();
      if (body == 2) pose(2, 3) = -0.003 * frame;
      for (int i = 0; i < 16; ++i) poses.push_back(pose(i / 4, i % 4));
    }
    for (Eigen::Index v = 0; v < soft.num_vertices(); ++v) {
      const Vector3 x = soft.positions.row(v).transpose() + Vector3(0, 0, 0.5 + 1e-3 * frame);
      positions.insert(positions.end(), x.begin(), x.end());
    }
  }
  write_npy(scratch / "bodies/body_pose.npy", {2, 4, 4, 4}, poses.data());
  scratch.file("bodies/soft/ball/world_positions.npy", "");
  write_npy(scratch / "bodies/soft/ball/world_positions.npy", {2, 9, 3}, positions.data());
  std::vector<double> wrenches(2 * 4 * 4 * 6, 0.0), energies(16, 0.0);
  const auto push = [&](std::size_t on, std::size_t by, std::size_t axis, double force) {
    wrenches[((4 + on) * 4 + by) * 6 + axis] = force;
    wrenches[((4 + by) * 4 + on) * 6 + axis] = -force;
  };
  push(0, 2, 2, -2.0);
  push(2, 3, 0, 1.0);
  write_npy(scratch / "bodies/pair_wrench.npy", {2, 4, 4, 6}, wrenches.data());
  write_npy(scratch / "bodies/energy.npy", {2, 8}, energies.data());
}

}  // namespace tacipc
