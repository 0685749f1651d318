#include "stages/dataset/report/view/robot_view.h"

#include <algorithm>

namespace tacipc {
namespace {

constexpr const char* kWorld = "world";  // MuJoCo's name of what does not move

bool has_body(const SceneFolder& scene, const std::string& name) {
  const auto named = [&](const auto& body) { return body.name == name; };
  return std::any_of(scene.objects.begin(), scene.objects.end(), named) ||
         std::any_of(scene.soft.begin(), scene.soft.end(), named);
}

/// A body that carries a gel ends behind it: MuJoCo's pad, a shape of the body, lies where the gel is, which the view
/// has itself. Vertices in the gel's place go back to its bottom.
void make_room(TriangleMesh& shape, const Matrix4& gel_from_body, const ViewedGel& gel) {
  constexpr double kInFront_m = 5e-4, kAround = 1.2;  // a pad may stand out, and be wider
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
      constexpr double kStill = 1e-6;  // m; what carries the gel does not move as seen from it
      const Matrix4 first = gel_from_body(0), last = gel_from_body(view.frames.size() - 1);
      if (object.robot && (last - first).cwiseAbs().maxCoeff() < kStill) make_room(object.mesh, first, gel);
    }
    view.objects.push_back(std::move(object));
  };
  add(kWorld, [](std::size_t) -> Matrix4 { return Matrix4::Identity(); });
  for (std::size_t b = 0; b < robot.parts.bodies.size(); ++b)
    add(robot.parts.bodies[b], [&](std::size_t frame) { return robot.frames[frame].body_pose[b]; });
}

}  // namespace tacipc
