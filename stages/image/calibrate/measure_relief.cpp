#include "stages/image/calibrate/measure_relief.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

/// Bilinear value of a view's field; outside, the nearest border value.
template <typename Of>
auto between(const MembraneView& view, const Eigen::Vector2d& pixel, const Of& of) {
  const double u = std::clamp(pixel.x(), 0.0, view.width - 1.001), v = std::clamp(pixel.y(), 0.0, view.height - 1.001);
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const double a = u - x, b = v - y;
  return ((1 - b) * ((1 - a) * of(view.index(x, y)) + a * of(view.index(x + 1, y))) +
          b * ((1 - a) * of(view.index(x, y + 1)) + a * of(view.index(x + 1, y + 1))))
      .eval();
}

/// Pixel that sees the membrane at (x, y).
Eigen::Vector2d pixel_over(const MembraneView& view, double x, double y, double pixel_m) {
  Eigen::Vector2d pixel((x - view.rest[0].x()) / pixel_m, (y - view.rest[0].y()) / pixel_m);
  for (int step = 0; step < 6; ++step) {
    const Vector3 there = between(view, pixel, [&](std::size_t i) -> const Vector3& { return view.point[i]; });
    pixel += Eigen::Vector2d(x - there.x(), y - there.y()) / pixel_m;
  }
  return pixel;
}

/// Slopes that the print adds to the membrane at touching pixels: one Gauss–Newton step per pixel, with a prior of
/// standard deviation slope_sigma. Zero elsewhere.
std::vector<Eigen::Vector2d> measure_slopes(const KnownObject& object, const ByteImage& photograph,
                                            const ByteImage& background, const LightField& light,
                                            const std::vector<char>& touched, double slope_sigma) {
  constexpr double kStep = 0.03;
  const MembraneView& view = object.view;
  double squares = 0.0, count = 0.0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      if (!object.known.inside(x, y))
        for (int c = 0; c < 3; ++c, count += 1.0)
          squares += std::pow(int{photograph.at(x, y, c)} - int{background.at(x, y, c)} - object.samples.drift[c], 2);
  const double variance = std::max(squares / std::max(count, 1.0), 1.0);

  const FloatImage change = code_change(light, view);
  const LightFeatures of(light.geometry, view);
  std::vector<Eigen::Vector2d> slopes(view.point.size(), Eigen::Vector2d::Zero());
  tbb::parallel_for(0, view.height, [&](int y) {
    Eigen::VectorXd features(light.geometry.num_features());
    for (int x = 0; x < view.width; ++x) {
      const std::size_t i = view.index(x, y);
      if (!touched[i]) continue;
      const auto codes = [&](const Vector3& normal) {
        of.at(x, y, normal, features.data());
        return Vector3(light.weights.transpose() * features);
      };
      const Vector3 here = codes(view.normal[i]);
      Eigen::Matrix<double, 3, 2> jacobian;
      for (int k = 0; k < 2; ++k) {
        const Vector3 normal = steeper(view.normal[i], k == 0 ? kStep : 0.0, k == 1 ? kStep : 0.0);
        jacobian.col(k) = (codes(normal) - here) / kStep;
      }
      Vector3 residual;
      for (int c = 0; c < 3; ++c) {
        const int code = photograph.at(x, y, c), rest = background.at(x, y, c);
        residual[c] = code - rest - object.samples.drift[c] - double{change.at(x, y, c)};
        if (code > 0 && code < 255 && rest > 0 && rest < 255) continue;
        jacobian.row(c).setZero();
      }
      Eigen::Matrix2d system = jacobian.transpose() * jacobian;
      system.diagonal().array() += variance / (slope_sigma * slope_sigma);
      const double most = 3.0 * slope_sigma;
      slopes[i] = (system.inverse() * (jacobian.transpose() * residual)).cwiseMax(-most).cwiseMin(most);
    }
  });
  return slopes;
}

}  // namespace

PrintRelief measure_relief(const KnownObject& object, const ByteImage& photograph, const ByteImage& background,
                           const LightField& light, const Sensor& sensor, double slope_sigma) {
  constexpr double kTouching = 12e-6;
  const double pixel = sensor.camera.window_width_m / sensor.camera.width_px;
  const MembraneView& view = object.view;
  PrintRelief relief{.map = FloatImage(view.width, view.height, 3), .pixel_m = pixel};
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) relief.map.at(x, y, 0) = 1.0f;
  if (object.front_before.rows() == 0) return relief;
  KnownObject earlier = object;
  earlier.front = object.front_before;
  const MembraneView before = view_object(earlier, sensor);

  // Contact of the object, as a map over the object.
  std::vector<char> touched(view.point.size(), 0);
  const double cosine = std::cos(object.yaw_rad), sine = std::sin(object.yaw_rad);
  const auto height = [](const MembraneView& in, const Eigen::Vector2d& at) {
    return between(in, at, [&](std::size_t i) -> const Vector3& { return in.point[i]; }).z();
  };
  FloatImage where(view.width, view.height, 2);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const double dx = (x - 0.5 * (view.width - 1)) * pixel, dy = (y - 0.5 * (view.height - 1)) * pixel;
      const double px = object.x_m + cosine * dx - sine * dy, py = object.y_m + sine * dx + cosine * dy;
      if (std::abs(px) > 0.5 * sensor.camera.window_width_m || std::abs(py) > 0.5 * sensor.camera.window_height_m)
        continue;
      const Eigen::Vector2d now = pixel_over(view, px, py, pixel);
      const double z = height(view, now);
      const double z_before = height(before, pixel_over(before, px, py, pixel));
      if (!(std::abs(z - object.origin_z_m - (z_before - object.origin_z_before_m)) < kTouching)) continue;
      relief.map.at(x, y, 0) = static_cast<float>(z - object.origin_z_m);
      where.at(x, y, 0) = static_cast<float>(now.x());
      where.at(x, y, 1) = static_cast<float>(now.y());
      for (const int u : {0, 1})
        for (const int v : {0, 1})
          touched[view.index(std::clamp(static_cast<int>(now.x()) + u, 0, view.width - 1),
                             std::clamp(static_cast<int>(now.y()) + v, 0, view.height - 1))] = 1;
    }
  }

  const std::vector<Eigen::Vector2d> slopes =
      measure_slopes(object, photograph, background, light, touched, slope_sigma);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      if (relief.map.at(x, y, 0) == 1.0f) continue;
      const Eigen::Vector2d in_s = between(view, {where.at(x, y, 0), where.at(x, y, 1)},
                                           [&](std::size_t i) -> const Eigen::Vector2d& { return slopes[i]; });
      relief.map.at(x, y, 1) = static_cast<float>(cosine * in_s.x() + sine * in_s.y());
      relief.map.at(x, y, 2) = static_cast<float>(cosine * in_s.y() - sine * in_s.x());
    }
  return relief;
}

}  // namespace tacipc
