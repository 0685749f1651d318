#include "stages/rival/baseline/marker_mode.h"

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "common/base/error.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"
#include "common/sensor/markers.h"
#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/marker_motion.h"
#include "stages/rival/baseline/object_depth.h"

namespace tacipc {
namespace {

/// Depth of an object at points of the front, seen straight from above.
class DepthAt {
 public:
  DepthAt(const Sensor& sensor, TriangleMesh object, std::string name)
      : sensor_(sensor), camera_(sensor, ObjectRays::parallel), object_(std::move(object)), name_(std::move(name)) {}

  void place(const Matrix4& pose) {
    depth_m_ = protrusion(camera_.see(object_, Positions(), pose, name_).depth, camera_.front());
  }
  /// Depth by bilinear interpolation between pixels; 0 outside the image.
  double operator()(const Eigen::Vector2d& point_m) const {
    const Camera& c = sensor_.camera;
    const double x = (point_m.x() / c.window_width_m + 0.5) * c.width_px - 0.5;
    const double y = (point_m.y() / c.window_height_m + 0.5) * c.height_px - 0.5;
    if (!(x >= 0.0 && y >= 0.0 && x < c.width_px - 1 && y < c.height_px - 1)) return 0.0;
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double u = x - x0, v = y - y0;
    return (1 - v) * ((1 - u) * depth_m_.at(x0, y0) + u * depth_m_.at(x0 + 1, y0)) +
           v * ((1 - u) * depth_m_.at(x0, y0 + 1) + u * depth_m_.at(x0 + 1, y0 + 1));
  }

 private:
  const Sensor& sensor_;
  ObjectCamera camera_;
  TriangleMesh object_;
  std::string name_;
  Raster depth_m_;
};

using MarkerField = std::function<Eigen::Vector2d(std::size_t)>;

/// Positions of FOTS's own markers, m; pixels count from the image's corner.
std::vector<Eigen::Vector2d> own_markers(const FotsMotion& model, const Camera& camera) {
  std::vector<Eigen::Vector2d> places;
  for (int row = 0; row < model.rows; ++row)
    for (int column = 0; column < model.columns; ++column) {
      const Eigen::Vector2d px = model.first_px + model.pitch_px.cwiseProduct(Eigen::Vector2d(column, row));
      places.emplace_back((px.x() / camera.width_px - 0.5) * camera.window_width_m,
                          (px.y() / camera.height_px - 0.5) * camera.window_height_m);
    }
  return places;
}

/// One folder: poses, phases and marker positions of all frames.
struct MovedPress {
  std::vector<Matrix4> poses;
  std::vector<PhaseKind> phases;
  std::vector<Positions> markers;
  std::size_t press_end = 0;

  void add(const Matrix4& pose, PhaseKind phase, const Positions& rest, const MarkerField& field) {
    poses.push_back(pose);
    phases.push_back(phase);
    markers.push_back(rest);
    for (Eigen::Index m = 0; m < rest.rows(); ++m)
      markers.back().row(m).head<2>() += field(static_cast<std::size_t>(m)).transpose();
  }
  void write(Stage& stage, const std::string& folder) const {
    const ArrayWriter writer(
        stage, {{kFrames, poses.size()}, {kMarkers, static_cast<std::size_t>(markers.front().rows())}}, folder);
    writer.write(PressArray::object_pose, poses, [](const Matrix4& pose) { return pose; });
    writer.write(PressArray::phase, phases, [](PhaseKind phase) { return phase; });
    writer.write(PressArray::markers, markers, std::identity());
    writer.write(PressArray::marker_displacement, marker_displacements(markers, press_end));
  }
};

}  // namespace

void move_markers(Stage& stage) {
  const auto config = stage.read_config<MarkerMotionConfig>("--config");
  const auto sensor = stage.read_config<Sensor>("--sensor");
  const auto mesh = stage.optional_input("--object"), source = stage.optional_input("--press");
  if (!mesh || !source) throw UsageError("markers: need --object and --press, a press of it whose way they go");
  const bool superposed = config.model == MarkerMotionConfig::Model::superposition;
  const auto response_folder = stage.optional_input("--response");
  if (superposed != response_folder.has_value())
    throw UsageError(superposed ? "--response: needed for a superposition"
                                : "--response: is for a superposition alone");
  PressFolder press(*source);
  const std::vector<Matrix4> poses = press.poses();
  const std::vector<PhaseKind> phases = press.phases();
  const Positions rest = press.markers(0);
  std::size_t press_end = 0;
  while (press_end + 1 < phases.size() && phases[press_end + 1] <= PhaseKind::press) ++press_end;
  if (press_end == 0) throw DataError("{}: does not begin with a press", source->string());
  if (superposed && rest.rows() != sensor.markers.rows * sensor.markers.columns)
    throw DataError("{}: its markers are not the sensor's lattice", source->string());
  std::optional<UnitResponse> response;
  if (superposed) response = UnitResponse::read(*response_folder, sensor.markers);

  DepthAt depth(sensor, read_triangle_mesh(*mesh, 1.0), mesh->string());
  const std::vector<Eigen::Vector2d> own = own_markers(config.fots, sensor.camera);
  const auto rest_of = [&](std::size_t m) -> Eigen::Vector2d { return rest.row(m).head<2>().transpose(); };
  // Marker displacement by an object pressed as in a frame, as a function of its motion since.
  const auto pressed = [&](const Matrix4& pose) -> std::function<MarkerField(const ObjectMotion&)> {
    depth.place(pose);
    if (superposed) {
      std::vector<double> depths;
      for (std::size_t m = 0; m < static_cast<std::size_t>(rest.rows()); ++m) depths.push_back(depth(rest_of(m)));
      const auto loads = std::make_shared<Superposition>(*response, sensor.markers, depths);
      return [loads](const ObjectMotion& motion) -> MarkerField {
        return [all = loads->displacement(motion.shift_m)](std::size_t m) { return all[m]; };
      };
    }
    std::vector<ContactPoint> contact;
    for (const Eigen::Vector2d& place : own)
      if (const double h = depth(place); h > 0.0) contact.push_back({place, h});
    return [&, contact](const ObjectMotion& motion) -> MarkerField {
      return
          [&, contact, motion](std::size_t m) { return fots_displacement(rest_of(m), contact, motion, config.fots); };
    };
  };
  const auto motion_since = [&](const Matrix4& start, const Matrix4& now) {
    const Matrix3 turn = now.topLeftCorner<3, 3>() * start.topLeftCorner<3, 3>().transpose();
    return ObjectMotion{.center_m = start.topRightCorner<2, 1>(),
                        .shift_m = (now - start).topRightCorner<3, 1>().head<2>(),
                        .turn_rad = std::atan2(turn(1, 0), turn(0, 0))};
  };
  MovedPress so_far;
  so_far.add(poses[0], phases[0], rest, [](std::size_t) { return Eigen::Vector2d::Zero(); });
  for (std::size_t end = 1; end <= press_end; ++end) {
    const auto moved_by = pressed(poses[end]);
    so_far.add(poses[end], phases[end], rest, moved_by(motion_since(poses[end], poses[end])));
    so_far.press_end = end;
    MovedPress run = so_far;
    for (std::size_t f = press_end + 1; f < poses.size(); ++f) {
      Matrix4 pose = poses[f];  // the subsequent motion, at this depth
      pose(2, 3) += poses[end](2, 3) - poses[press_end](2, 3);
      run.add(pose, phases[f], rest, moved_by(motion_since(poses[end], pose)));
    }
    run.write(stage, fmt::format("depth_{:04}", end));
  }
  stage.summarize({{"depths", press_end}, {"markers", rest.rows()}});
}

}  // namespace tacipc
