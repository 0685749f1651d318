// Content of the 3-D view of a press, a grasp or a scene: fronts of gels and objects in one world, frame by frame.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/contact_state.h"
#include "common/sample/robot_folder.h"
#include "common/sample/scene_folder.h"

namespace tacipc {

/// Gel in one frame; rows are vertices of its front.
struct ViewedFront {
  Positions positions;              // positions in the gel's frame S, m
  Eigen::VectorXd pressure_pa;      // normal traction per deformed area
  std::vector<ContactState> state;  // none, stick, slip
  Matrix4 world_from_gel;
};

/// A gel in all frames of the view.
struct ViewedGel {
  std::string name;       // empty for a single gel
  Triangles front;        // indices of the rows of a frame, counter-clockwise seen from outside
  double bottom_m = 0.0;  // lowest z of the gel at rest
  std::vector<ViewedFront> frames;
  std::vector<std::string> pictures = {};  // links from the page to its tactile images, "" for a missing one
};

/// An object in all frames of the view.
struct ViewedObject {
  std::string name;
  TriangleMesh mesh;
  std::vector<Matrix4> world_from_object;
  bool fixed = false;
  bool robot = false;                    // part of a robot
  std::vector<Positions> deformed = {};  // vertices of a soft body in the object's frame, m; empty for rigid ones
};

/// Content of the view. All lists over frames have as many entries as `frames`.
struct SceneView {
  std::vector<int> frames;  // frames of the press; the first is at rest
  std::vector<ViewedGel> gels;
  std::vector<ViewedObject> objects;
};

/// Frames of the press that a view has: all of them, or evenly spread ones that keep its data small, including the
/// first and the last. `front_vertices` is the sum over all gels.
/// \pre frames ≥ 1
std::vector<int> viewed_frames(int frames, std::size_t front_vertices);

/// Pressure of every vertex, Pa: p_v = −f_v · n_v / A_v if positive, otherwise 0. A_v is a third of the area of the
/// triangles around the vertex, n_v their mean outward normal, f_v (N) the normal contact force on the vertex.
Eigen::VectorXd vertex_pressures(const Positions& x, const Triangles& triangles, const Positions& normal_force_n);

/// View of a finished press, whose frame S is the world. Nothing if the gel or the object is missing or has changed, or
/// if arrays were dropped. Vertices are ordered along a space-filling curve, so that neighbours have similar numbers.
/// \throw DataError for malformed content
std::optional<SceneView> read_press_view(const std::filesystem::path& press_folder);

/// View of the scene in `folder`; nothing for the reasons of read_press_view.
std::optional<SceneView> read_scene_view(const SceneFolder& scene, const std::filesystem::path& folder);

/// Adds the shapes of the robot's bodies and of its surroundings, but not of bodies that the scene itself has.
/// \param folder folder of the robot
/// \throw DataError for a shape that cannot be read
/// \pre the robot has the scene's frames
void add_robot(SceneView& view, const RobotFolder& robot, const std::filesystem::path& folder,
               const SceneFolder& scene);

/// Links every gel's existing tactile images from a page in `page_folder`. `render_folders`: one per gel.
void link_pictures(SceneView& view, const std::vector<std::filesystem::path>& render_folders,
                   const std::filesystem::path& page_folder);

}  // namespace tacipc
