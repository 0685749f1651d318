#include "stages/image/calibrate/fit_metallic.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/sensor/camera_model.h"
#include "common/sensor/membrane_view.h"
#include "stages/image/calibrate/gauss_newton.h"

namespace tacipc {
namespace {

MetallicLamps lamps_at(MetallicLamps lamps, const Eigen::VectorXd& u) {
  lamps.change_factor = u[0];
  for (std::size_t l = 0; l < lamps.lamps.size(); ++l)
    for (std::size_t c = 0; c < 3; ++c) lamps.lamps[l].rgb[c] = u[1 + 3 * l + c];
  return lamps;
}

/// Intersection of a sample's ray with the object in the gel, and the object's outward normal there.
struct Meeting {
  Vector3 point, normal;
};

/// Samples with light. `object(x, y, ray)` gives a Meeting, or nothing if the ray meets the front first.
template <typename Object>
MetallicSamples lit_samples(const Samples& samples, const std::vector<MetallicLamp>& lamps, const Sensor& sensor,
                            Object&& object) {
  const CameraModel camera(sensor.camera, sensor.stack);
  const Eigen::Index rows = std::ssize(samples.pixels);
  const Eigen::Index columns = std::ssize(lamps);
  MetallicSamples out{.samples = samples, .object = Eigen::MatrixXd(rows, columns), .empty = {}};
  out.empty = out.object;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto [x, y] = samples.pixels[i];
    const CameraRay ray = camera.ray(x + 0.5, y + 0.5).value();
    const Vector3 rest = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
    const std::optional<Meeting> met = object(x, y, ray);
    for (Eigen::Index l = 0; l < columns; ++l) {
      const Vector3& lamp = lamps[l].position_m;
      out.empty(i, l) = metallic_light(rest, -Vector3::UnitZ(), sensor.camera.position_m, lamp);
      out.object(i, l) =
          met ? metallic_light(met->point, met->normal, sensor.camera.position_m, lamp) : out.empty(i, l);
    }
  }
  return out;
}

}  // namespace

MetallicSamples metallic_samples(const Samples& samples, const Vector3& ball_m, double radius_m,
                                 const std::vector<MetallicLamp>& lamps, const Sensor& sensor) {
  return lit_samples(samples, lamps, sensor, [&](int, int, const CameraRay& ray) -> std::optional<Meeting> {
    const Vector3 to_ball = ball_m - ray.origin;
    const double along = to_ball.dot(ray.direction);
    const double squared = along * along - to_ball.squaredNorm() + radius_m * radius_m;
    const Vector3 point = ray.origin + (along - std::sqrt(std::max(squared, 0.0))) * ray.direction;
    if (!(squared > 0.0 && point.z() < 0.0)) return std::nullopt;
    return Meeting{point, (point - ball_m) / radius_m};
  });
}

MetallicSamples metallic_samples(const Samples& samples, const FloatImage& height_m,
                                 const std::vector<MetallicLamp>& lamps, const Sensor& sensor) {
  const MembraneView view = view_height_map(height_m, sensor);
  return lit_samples(samples, lamps, sensor, [&](int x, int y, const CameraRay&) -> std::optional<Meeting> {
    if (!(height_m.at(x, y, 0) > 0.0F)) return std::nullopt;
    const std::size_t i = view.index(x, y);
    return Meeting{view.point[i], -view.normal[i]};
  });
}

double metallic_change(const MetallicSamples& samples, const MetallicLamps& lamps, Eigen::Index i, std::size_t c) {
  double object = 0.0, empty = 0.0;
  for (std::size_t l = 0; l < lamps.lamps.size(); ++l) {
    const auto column = static_cast<Eigen::Index>(l);
    object += lamps.lamps[l].rgb[c] * samples.object(i, column);
    empty += lamps.lamps[l].rgb[c] * samples.empty(i, column);
  }
  return object == empty ? 0.0 : lamps.change_factor * (metallic_code(object) - metallic_code(empty));
}

namespace {

/// Change − photograph of each sample and channel, grey levels; 0 for an unused sample.
Eigen::VectorXd errors_of(const std::vector<MetallicSamples>& balls, const MetallicLamps& lamps) {
  std::vector<double> all;
  for (const MetallicSamples& ball : balls)
    for (Eigen::Index i = 0; i < ball.samples.target.rows(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto column = static_cast<Eigen::Index>(c);
        const double error = metallic_change(ball, lamps, i, c) - ball.samples.target(i, column);
        all.push_back(ball.samples.used(i, column) * error);
      }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), std::ssize(all));
}

}  // namespace

double metallic_rmse(const std::vector<MetallicSamples>& balls, const MetallicLamps& lamps) {
  double squares = 0.0, count = 0.0;
  for (const double error : errors_of(balls, lamps)) squares += error * error;
  for (const MetallicSamples& ball : balls) count += ball.samples.used.sum();
  return std::sqrt(squares / count);
}

MetallicLamps fit_metallic(const std::vector<MetallicSamples>& balls, const MetallicLamps& start) {
  const auto n = static_cast<Eigen::Index>(1 + 3 * start.lamps.size());
  Eigen::VectorXd u(n);
  u[0] = start.change_factor;
  for (std::size_t l = 0; l < start.lamps.size(); ++l)
    for (std::size_t c = 0; c < 3; ++c) u[1 + 3 * l + c] = start.lamps[l].rgb[c];
  constexpr double kLargest = 1e3;  // far beyond white in all channels
  GaussNewtonSettings settings{.step = Eigen::VectorXd::Constant(n, 1e-4),
                               .lower = Eigen::VectorXd::Zero(n),
                               .upper = Eigen::VectorXd::Constant(n, kLargest),
                               .max_iterations = 100};
  settings.lower[0] = 1e-3;
  const auto residuals = [&](const Eigen::VectorXd& at) { return errors_of(balls, lamps_at(start, at)); };
  return lamps_at(start, gauss_newton(residuals, u, settings).parameters);
}

}  // namespace tacipc
