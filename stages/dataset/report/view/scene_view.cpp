#include "stages/dataset/report/view/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/mesh/spatial_order.h"
#include "common/mesh/tet_mesh.h"
#include "common/sample/press_folder.h"
#include "common/sample/render_folder.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/press_report.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Same triangles, each starting from its lowest corner, in ascending order, so that neighbours have similar numbers.
Triangles sorted_triangles(const Triangles& triangles) {
  std::vector<std::array<int, 3>> rows;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    rows.push_back(corners);
  }
  std::sort(rows.begin(), rows.end());
  Triangles sorted(triangles.rows(), 3);
  for (Eigen::Index t = 0; t < sorted.rows(); ++t) {
    const auto& corners = rows[static_cast<std::size_t>(t)];
    sorted.row(t) << corners[0], corners[1], corners[2];
  }
  return sorted;
}

/// Triangles with every corner replaced by `place[corner]`.
Triangles renumbered(Triangles triangles, const std::vector<int>& place) {
  for (Eigen::Index i = 0; i < triangles.size(); ++i)
    triangles.data()[i] = place[static_cast<std::size_t>(triangles.data()[i])];
  return sorted_triangles(triangles);
}

TriangleMesh ordered(const TriangleMesh& mesh) {
  return {mesh.positions(spatial_order(mesh.positions), Eigen::all),
          renumbered(mesh.triangles, spatial_rank(mesh.positions))};
}

/// Part of a mesh's surface: its vertices as rows of the mesh, and its triangles among these.
struct Part {
  std::vector<int> order;  // rows of `vertices`
  std::vector<int> rows;   // the same vertices as rows of the mesh
  Triangles triangles;
};

Part part_of(const TetMesh& mesh, const std::vector<int>& vertices, const Triangles& triangles) {
  Part part{.order = spatial_order(mesh.positions(vertices, Eigen::all)), .rows = {}, .triangles = {}};
  std::vector<int> place(static_cast<std::size_t>(mesh.num_vertices()), -1);
  for (const int v : part.order) {
    const int row = vertices[static_cast<std::size_t>(v)];
    place[static_cast<std::size_t>(row)] = static_cast<int>(part.rows.size());
    part.rows.push_back(row);
  }
  part.triangles = renumbered(triangles, place);
  return part;
}

/// Gel whose press can be shown.
struct ShownGel {
  PressFolder press;
  Part front;
  double bottom_m;
};

/// Path of the gel or object of a press, by its name among the record's inputs.
std::optional<fs::path> input_of(const fs::path& folder, const std::string& input) {
  std::string why;
  return pressed_input(folder, Record::from_file(folder / "press.yaml"), input, why);
}

std::optional<ShownGel> open_gel(const fs::path& folder) {
  if (was_dropped(folder) || !fs::is_regular_file(folder / "press.yaml")) return std::nullopt;
  const auto gel_path = input_of(folder, "gel");
  if (!gel_path) return std::nullopt;
  const TetMesh gel = read_tet_mesh(*gel_path);
  PressFolder press = PressFolder::finished(folder, {{kVertices, static_cast<std::size_t>(gel.num_vertices())}});
  using enum PressArray;
  for (const PressArray array : {positions, object_pose, contact_force, contact_state, front_vertices}) {
    if (!press.has(array)) return std::nullopt;
  }
  press.require_front(gel.vertices(BoundaryTag::front));
  return ShownGel{std::move(press), part_of(gel, gel.vertices(BoundaryTag::front), gel.faces(BoundaryTag::front)),
                  gel.positions.col(2).minCoeff()};
}

ViewedFront read_frame(const ShownGel& gel, std::size_t frame, const Matrix4& world_from_gel) {
  ViewedFront view{.positions = gel.press.positions(frame)(gel.front.rows, Eigen::all),
                   .pressure_pa = {},
                   .state = {},
                   .world_from_gel = world_from_gel};
  const Positions force = gel.press.contact_forces(frame).normal(gel.front.order, Eigen::all);
  view.pressure_pa = vertex_pressures(view.positions, gel.front.triangles, force);
  const std::vector<ContactState> states = gel.press.contact_states(frame);
  for (const int v : gel.front.order) view.state.push_back(states[static_cast<std::size_t>(v)]);
  return view;
}

/// Surface of a soft body, with its vertices in the view's frames.
ViewedObject soft_object(const SceneSoft& soft, const fs::path& path, std::size_t frames,
                         const std::vector<int>& shown) {
  const TetMesh tets = read_object_tet_mesh(path);
  const std::vector<Positions> all = soft.positions(frames, static_cast<std::size_t>(tets.num_vertices()));
  const Part surface = part_of(tets, tets.vertices(BoundaryTag::free), tets.boundary);
  ViewedObject object{.name = soft.name,
                      .mesh = {all.front()(surface.rows, Eigen::all), surface.triangles},
                      .world_from_object = std::vector<Matrix4>(shown.size(), Matrix4::Identity())};
  for (const int frame : shown)
    object.deformed.emplace_back(all[static_cast<std::size_t>(frame)](surface.rows, Eigen::all));
  return object;
}

/// \param gels in the order of the scene's
/// \param bodies meshes of the scene's objects, then of its soft bodies
SceneView view_of(const SceneFolder& scene, const std::vector<ShownGel>& gels, const std::vector<fs::path>& bodies) {
  std::size_t vertices = 0;
  for (const ShownGel& gel : gels) vertices += gel.front.rows.size();
  SceneView view{.frames = viewed_frames(static_cast<int>(scene.times_s.size()), vertices), .gels = {}, .objects = {}};
  const auto shown = [&](const std::vector<Matrix4>& poses, auto&& take) {
    for (const int frame : view.frames)
      take(static_cast<std::size_t>(frame), poses.at(static_cast<std::size_t>(frame)));
  };
  for (std::size_t g = 0; g < gels.size(); ++g) {
    ViewedGel& gel =
        view.gels.emplace_back(ViewedGel{scene.gels[g].name, gels[g].front.triangles, gels[g].bottom_m, {}, {}});
    shown(scene.gels[g].world_from_gel,
          [&](std::size_t frame, const Matrix4& pose) { gel.frames.push_back(read_frame(gels[g], frame, pose)); });
  }
  const std::size_t objects = scene.objects.size();
  for (std::size_t o = 0; o < objects; ++o) {
    const SceneObject& of = scene.objects[o];
    ViewedObject& object = view.objects.emplace_back(
        ViewedObject{of.name, ordered(read_triangle_mesh(bodies[o], of.metres_per_unit)), {}, of.fixed});
    shown(of.world_from_object, [&](std::size_t, const Matrix4& pose) { object.world_from_object.push_back(pose); });
  }
  for (std::size_t i = 0; i < scene.soft.size(); ++i)
    view.objects.push_back(soft_object(scene.soft[i], bodies[objects + i], scene.times_s.size(), view.frames));
  return view;
}

constexpr const char* kWorld = "world";  // MuJoCo's name of everything that does not move

bool has_body(const SceneFolder& scene, const std::string& name) {
  const auto named = [&](const auto& body) { return body.name == name; };
  return std::any_of(scene.objects.begin(), scene.objects.end(), named) ||
         std::any_of(scene.soft.begin(), scene.soft.end(), named);
}

/// Makes room for a gel in the body that supports it. MuJoCo's pad, a shape of the body, occupies the gel's position,
/// but the view draws the gel itself. Vertices inside the gel move back to its bottom.
void make_room(TriangleMesh& shape, const Matrix4& gel_from_body, const ViewedGel& gel) {
  constexpr double kInFront_m = 5e-4, kAround = 1.2;  // tolerances: a pad may protrude and be wider
  const Positions& front = gel.frames.front().positions;
  const Eigen::RowVector2d middle = 0.5 * (front.colwise().minCoeff() + front.colwise().maxCoeff()).leftCols<2>();
  const double radius = kAround * (front.leftCols<2>().rowwise() - middle).rowwise().norm().maxCoeff();
  const Matrix3 rotation = gel_from_body.topLeftCorner<3, 3>();
  const Vector3 origin = gel_from_body.topRightCorner<3, 1>();
  for (Eigen::Index v = 0; v < shape.positions.rows(); ++v) {
    Vector3 in_gel = rotation * shape.positions.row(v).transpose() + origin;
    const bool inside = in_gel.z() > gel.bottom_m && in_gel.z() < front.col(2).maxCoeff() + kInFront_m &&
                        (in_gel.head<2>().transpose() - middle).norm() < radius;
    if (!inside) continue;
    in_gel.z() = gel.bottom_m;
    shape.positions.row(v) = (rotation.transpose() * (in_gel - origin)).transpose();
  }
}

}  // namespace

std::vector<int> viewed_frames(int frames, std::size_t front_vertices) {
  constexpr std::size_t kMostRows = 400'000;  // about 2 MB of data
  const auto most = static_cast<int>(std::max<std::size_t>(2, kMostRows / std::max<std::size_t>(1, front_vertices)));
  const int count = std::min(frames, most);
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : static_cast<int>(std::lround(double(i) * (frames - 1) / (count - 1))));
  return chosen;
}

Eigen::VectorXd vertex_pressures(const Positions& x, const Triangles& triangles, const Positions& normal_force_n) {
  Positions area = Positions::Zero(x.rows(), 3);  // Σ of a third of each triangle's area vector, per vertex
  Eigen::VectorXd size = Eigen::VectorXd::Zero(x.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector3 a = x.row(triangles(t, 0)), b = x.row(triangles(t, 1)), c = x.row(triangles(t, 2));
    const Vector3 third = (b - a).cross(c - a) / 6.0;
    for (int k = 0; k < 3; ++k) {
      area.row(triangles(t, k)) += third.transpose();
      size[triangles(t, k)] += third.norm();
    }
  }
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(x.rows());
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double length = area.row(v).norm();
    if (size[v] > 0.0 && length > 0.0)
      pressure[v] = std::max(0.0, -normal_force_n.row(v).dot(area.row(v)) / (length * size[v]));
  }
  return pressure;
}

std::optional<SceneView> read_press_view(const fs::path& folder) {
  auto gel = open_gel(folder);
  if (!gel) return std::nullopt;
  const auto object_path = input_of(folder, "object");
  if (!object_path) return std::nullopt;
  const std::vector<Matrix4> poses = gel->press.poses();
  const SceneFolder scene{.times_s = std::vector<double>(poses.size()),
                          .gels = {{"", folder.parent_path(), std::vector<Matrix4>(poses.size(), Matrix4::Identity())}},
                          .objects = {{"object", poses}}};
  std::vector<ShownGel> gels;
  gels.push_back(std::move(*gel));
  return view_of(scene, gels, {*object_path});
}

std::optional<SceneView> read_scene_view(const SceneFolder& scene, const fs::path& folder) {
  std::vector<ShownGel> gels;
  for (const SceneGel& placed : scene.gels) {
    auto gel = open_gel(placed.press());
    if (!gel) return std::nullopt;
    gels.push_back(std::move(*gel));
  }
  std::vector<std::string> inputs;
  for (const SceneObject& object : scene.objects) inputs.push_back(object.input);
  for (const SceneSoft& soft : scene.soft) inputs.push_back(soft.input);
  std::vector<fs::path> bodies;
  for (const std::string& input : inputs) {
    const auto path = input_of(folder, input);
    if (!path) return std::nullopt;
    bodies.push_back(*path);
  }
  return view_of(scene, gels, bodies);
}

void add_robot(SceneView& view, const RobotFolder& robot, const std::filesystem::path& folder,
               const SceneFolder& scene) {
  const auto add = [&](const std::string& name, auto&& pose_in) {
    const std::filesystem::path shape = robot_shape(folder, name);
    if (has_body(scene, name) || !std::filesystem::is_regular_file(shape)) return;
    ViewedObject object{.name = name, .mesh = read_triangle_mesh(shape, 1.0), .world_from_object = {}};
    for (const int frame : view.frames) object.world_from_object.push_back(pose_in(static_cast<std::size_t>(frame)));
    object.fixed = name == kWorld;
    object.robot = !object.fixed;
    for (const ViewedGel& gel : view.gels) {
      const auto gel_from_body = [&](std::size_t f) -> Matrix4 {
        return gel.frames[f].world_from_gel.inverse() * object.world_from_object[f];
      };
      constexpr double kStill = 1e-6;  // m; the body that supports a gel does not move relative to it
      const Matrix4 first = gel_from_body(0), last = gel_from_body(view.frames.size() - 1);
      if (object.robot && (last - first).cwiseAbs().maxCoeff() < kStill) make_room(object.mesh, first, gel);
    }
    view.objects.push_back(std::move(object));
  };
  add(kWorld, [](std::size_t) -> Matrix4 { return Matrix4::Identity(); });
  for (std::size_t b = 0; b < robot.parts.bodies.size(); ++b)
    add(robot.parts.bodies[b], [&](std::size_t frame) { return robot.frames[frame].body_pose[b]; });
}

void link_pictures(SceneView& view, const std::vector<fs::path>& render_folders, const fs::path& page_folder) {
  for (std::size_t g = 0; g < view.gels.size(); ++g) {
    for (const int frame : view.frames) {
      const fs::path picture = frame_path(render_folders[g], static_cast<std::size_t>(frame), FrameFile::tactile);
      view.gels[g].pictures.push_back(fs::is_regular_file(picture) ? html_link(picture, page_folder) : "");
    }
  }
}

}  // namespace tacipc
