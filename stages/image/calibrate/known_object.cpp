#include "stages/image/calibrate/known_object.h"

#include <tuple>

#include "common/base/units.h"
#include "common/optics/seen_membrane.h"
#include "stages/image/calibrate/gauss_newton.h"

namespace tacipc {

KnownObjectsConfig KnownObjectsConfig::read(ConfigReader& in) {
  KnownObjectsConfig config;
  for (ConfigReader& item : in.one_or_more_sections("objects")) {
    KnownObjectConfig object{
        .name = item.text("name"), .photograph = item.text("photograph"), .frame = item.integer("frame", 0, 1000000)};
    const auto center = item.numbers("center_px", 2);
    object.center_px = {center[0], center[1]};
    const auto box = item.numbers("box_px", 4, Range::between(0.0, 1e6));
    for (std::size_t i = 0; i < 4; ++i) object.box_px[i] = static_cast<int>(box[i]);
    if (object.box_px[2] < 1 || object.box_px[3] < 1) item.fault("box_px", "expected at least one pixel");
    object.fit_yaw = item.flag("yaw");
    config.objects.push_back(object);
  }
  return config;
}

KnownObjectConfig KnownObjectConfig::grown(int margin_px) const {
  KnownObjectConfig out = *this;
  out.box_px = {box_px[0] - margin_px, box_px[1] - margin_px, box_px[2] + 2 * margin_px, box_px[3] + 2 * margin_px};
  return out;
}

Samples object_samples(const KnownObjectConfig& known, const ByteImage& photograph, const ByteImage& background,
                       int stride) {
  return make_samples(
      photograph, background, known.photograph, [&](int x, int y) { return known.inside(x, y); },
      [&](int x, int y) { return !known.inside(x, y); }, stride);
}

MembraneView view_object(const KnownObject& object, const Sensor& sensor) {
  return view_membrane(moved(object.front, object.x_m, object.y_m, object.yaw_rad), object.triangles, sensor);
}

void fit_object(KnownObject& object, const Sensor& sensor, const LightField& light) {
  const double pixel = sensor.camera.window_width_m / sensor.camera.width_px;
  const double reach = 10.0 * pixel, turn = object.known.fit_yaw ? 10.0 * kDegree : 0.0;
  const Eigen::Vector3d start(object.x_m, object.y_m, object.yaw_rad);
  const auto at = [&](const Eigen::VectorXd& u) {
    KnownObject moved = object;
    std::tie(moved.x_m, moved.y_m, moved.yaw_rad) = std::tuple(u[0], u[1], u[2]);
    moved.view = view_object(moved, sensor);
    return moved;
  };
  const auto residuals = [&](const Eigen::VectorXd& u) {
    const KnownObject there = at(u);
    return residuals_of(there.samples, feature_matrix(light.geometry, there.view, there.samples), light.weights);
  };
  const GaussNewtonSettings settings{.step = Eigen::Vector3d(0.25 * pixel, 0.25 * pixel, 0.25 * kDegree),
                                     .lower = start - Eigen::Vector3d(reach, reach, turn),
                                     .upper = start + Eigen::Vector3d(reach, reach, turn),
                                     .max_iterations = 4,
                                     .relative_decrease = 1e-3};
  object = at(gauss_newton(residuals, start, settings).parameters);
}

}  // namespace tacipc
