// What the 3-D view shows of a press, a grasp or a scene: fronts of gels and objects in one world, frame by frame.
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

/// A gel in one frame; rows are vertices of its front.
struct ViewedFront {
  Positions positions;              // m, the gel's frame S
  Eigen::VectorXd pressure_pa;      // normal traction per deformed area
  std::vector<ContactState> state;  // none, stick, slip
  Matrix4 world_from_gel;
};

struct ViewedGel {
  std::string name;       // empty where it is the only one
  Triangles front;        // indices into rows of a frame, counter-clockwise seen from outside
  double bottom_m = 0.0;  // lowest z of the gel at rest
  std::vector<ViewedFront> frames;
  std::vector<std::string> pictures = {};  // its tactile images as links from the page, "" where there is none
};

struct ViewedObject {
  std::string name;
  TriangleMesh mesh;
  std::vector<Matrix4> world_from_object;
  bool fixed = false;
  bool robot = false;                    // a part of a robot
  std::vector<Positions> deformed = {};  // m, of a soft body its vertices in the object's frame; else none
};

/// Everything has as many entries per frame as there are `frames`.
struct SceneView {
  std::vector<int> frames;  // of the press; the first is rest
  std::vector<ViewedGel> gels;
  std::vector<ViewedObject> objects;
};

/// Frames of the press that a view has: all, or where they are many as many evenly chosen ones as keep its data small,
/// the first and the last among them. `front_vertices`: of all gels together. \pre frames ≥ 1
std::vector<int> viewed_frames(int frames, std::size_t front_vertices);

/// Pressure p_v = −f_v · n_v / A_v of every vertex, where it is positive, else 0. A_v is a third of the area of the
/// triangles around the vertex, n_v their mean outward normal, f_v (N) the normal contact force on it; Pa.
Eigen::VectorXd vertex_pressures(const Positions& x, const Triangles& triangles, const Positions& normal_force_n);

/// The view of a finished press: its frame S is the world. Nothing where the gel or the object is not there any more or
/// has changed since, or where arrays were dropped. Vertices are ordered along a curve in space, so that neighbours
/// have similar numbers. \throw DataError for what is malformed
std::optional<SceneView> read_press_view(const std::filesystem::path& press_folder);

/// The same of a scene, whose folder this is.
std::optional<SceneView> read_scene_view(const SceneFolder& scene, const std::filesystem::path& folder);

/// Adds the shapes of the robot's bodies, and of what stands around it; not of bodies that the scene has itself.
/// `folder`: of the robot. \throw DataError for a shape that cannot be read \pre the robot has the scene's frames
void add_robot(SceneView& view, const RobotFolder& robot, const std::filesystem::path& folder,
               const SceneFolder& scene);

/// Links every gel's tactile images, those that there are, from a page in `page_folder`. `render_folders`: one per gel.
void link_pictures(SceneView& view, const std::vector<std::filesystem::path>& render_folders,
                   const std::filesystem::path& page_folder);

}  // namespace tacipc
