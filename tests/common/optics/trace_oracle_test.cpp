// The ray tracer against a plain one that tries every triangle, in double precision, without any tree.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/optics/trace.h"
#include "tests/common/optics/test_surfaces.h"

namespace tacipc {
namespace trace_oracle_test {

struct Crossing {
  double t = std::numeric_limits<double>::infinity();
  int triangle = -1;
  Vector3 weights = Vector3::Zero();
};

/// Nearest crossing in (0, t_end) by Cramer's rule on o + t d = v0 + b1 e1 + b2 e2.
Crossing cross_all(const Membrane& m, const Vector3& o, const Vector3& d, double t_end) {
  Crossing nearest;
  for (int f = 0; f < m.triangles.rows(); ++f) {
    const Vector3 v0 = m.positions.row(m.triangles(f, 0)).transpose();
    const Vector3 e1 = m.positions.row(m.triangles(f, 1)).transpose() - v0;
    const Vector3 e2 = m.positions.row(m.triangles(f, 2)).transpose() - v0;
    const Vector3 p = d.cross(e2), s = o - v0;
    const double det = e1.dot(p);
    const double b1 = s.dot(p) / det;
    if (!(b1 >= 0.0 && b1 <= 1.0)) continue;
    const Vector3 q = s.cross(e1);
    const double b2 = d.dot(q) / det;
    if (!(b2 >= 0.0 && b1 + b2 <= 1.0)) continue;
    const double t = e2.dot(q) / det;
    if (t > 0.0 && t < t_end && t < nearest.t) nearest = {t, f, {1.0 - b1 - b2, b1, b2}};
  }
  return nearest;
}

/// Radiance of one light along one ray, written out from the model: Lambert coating, square Lambertian light of 3 × 3
/// points with one side along the direction away from the axis, tangent-plane lift of the shadow ray's start.
double radiance(const Membrane& m, const Vector3& o, const Vector3& d, const Led& led) {
  const Crossing hit = cross_all(m, o, d, std::numeric_limits<double>::infinity());
  if (hit.triangle < 0) return 0.0;
  const Vector3 point = o + hit.t * d;
  Vector3 normal = Vector3::Zero(), lift = Vector3::Zero();
  Matrix3 v;
  for (int k = 0; k < 3; ++k) {
    const int row = m.triangles(hit.triangle, k);
    v.col(k) = m.positions.row(row).transpose();
    const Vector3 n = -m.normals.row(row).transpose();
    normal += hit.weights[k] * n;
    const double height = n.dot(point - v.col(k));
    if (height < 0.0) lift += hit.weights[k] * -height * n;
  }
  normal.normalize();
  const Vector3 face = (v.col(2) - v.col(0)).cross(v.col(1) - v.col(0)).normalized();
  const Vector3 start = point + lift + 1e-7 * face;
  const Vector3 away = Vector3(led.position_m.x(), led.position_m.y(), 0.0).normalized();
  const Vector3 across = Vector3::UnitZ().cross(away);
  double sum = 0.0;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      const Vector3 source = led.position_m + led.size_m[0] / 3.0 * (a * away + b * across);
      const Vector3 w = source - point;
      const double distance = w.norm(), cosine = normal.dot(w) / distance, emission = -w.z() / distance;
      if (cosine <= 0.0 || cross_all(m, start, source - start, 1.0).triangle >= 0) continue;
      sum += cosine * emission / (distance * distance) / 9.0 / std::numbers::pi;
    }
  }
  return sum;
}

TEST(Trace, AgreesWithBruteForceOnASmallPress) {
  // A steep square stamp with a tilt: shadows, slopes to 60°, nothing symmetric.
  const auto stamp = [](double x, double y) {
    const double edge = std::max(std::abs(x - 2e-4), std::abs(y + 1e-4)) - 1e-3;
    return -(0.8e-3 + 0.1 * x) / (1.0 + std::exp(edge / 1.2e-4));
  };
  const Membrane press = height_field(2.4e-3, 1.8e-3, 1.9e-4, stamp);
  ASSERT_GT(press.triangles.rows(), 1800);
  Sensor sensor = plain_sensor(32, 24);
  sensor.leds = {{.position_m = {8e-3, 3e-3, -7e-3}, .rgb = {1, 1, 1}, .size_m = {5e-3, 5e-3}},
                 {.position_m = {-6e-3, 6e-3, -9e-3}, .rgb = {1, 1, 1}, .size_m = {3e-3, 3e-3}}};
  // Lambertian too, but of 3 × 3 points from every place.
  for (Led& led : sensor.leds) led.emission = Emission::cosine_power;
  const TraceResult result = trace(press, sensor, {});
  for (int led = 0; led < 2; ++led) {
    double squared_error = 0.0, squared = 0.0;
    int shadowed = 0;
    for (int row = 0; row < 24; ++row) {
      for (int column = 0; column < 32; ++column) {
        double expected = 0.0;
        for (const double j : {0.25, 0.75}) {
          for (const double i : {0.25, 0.75}) {
            const Vector3 o = sensor.camera.position_m;
            const Vector3 target(4e-3 * ((column + i) / 32 - 0.5), 3e-3 * ((row + j) / 24 - 0.5), 0.0);
            expected += radiance(press, o, target - o, sensor.leds[static_cast<std::size_t>(led)]) / 4.0;
          }
        }
        squared_error += std::pow(result.basis.at(column, row, led) - expected, 2.0);
        squared += expected * expected;
        shadowed += expected == 0.0;
      }
    }
    EXPECT_LT(std::sqrt(squared_error / squared), 1e-4) << "light " << led;
    EXPECT_GT(shadowed, 3) << "light " << led;
  }
}

/// p = n sin θ of the path that goes r sideways through air, acrylic and gel, by bisection.
double ray_parameter(double r, double air, double acrylic, double gel) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double p = 0.5 * (low + high);
    const double reached = air * p / std::sqrt(1.0 - p * p) + acrylic * p / std::sqrt(1.49 * 1.49 - p * p) +
                           gel * p / std::sqrt(1.41 * 1.41 - p * p);
    (reached < r ? low : high) = p;
  }
  return low;
}

/// Transmittance of both interfaces at p, from the angles themselves.
double transmitted(double p) {
  const double a = std::asin(p), b = std::asin(p / 1.49), c = std::asin(p / 1.41);
  const auto through = [](double in, double out) {
    const double rs = std::sin(in - out) / std::sin(in + out), rp = std::tan(in - out) / std::tan(in + out);
    return 1.0 - 0.5 * (rs * rs + rp * rp);
  };
  return through(a, b) * through(b, c);
}

TEST(Trace, AgreesWithBruteForceThroughLayers) {
  // The light's solid angle per area comes from differences of neighbouring paths instead of the closed form.
  const auto stamp = [](double x, double y) {
    const double edge = std::max(std::abs(x - 2e-4), std::abs(y + 1e-4)) - 1e-3;
    return -(0.8e-3 + 0.1 * x) / (1.0 + std::exp(edge / 1.2e-4));
  };
  const Membrane press = height_field(2.4e-3, 1.8e-3, 1.9e-4, stamp);
  Sensor sensor = plain_sensor(32, 24);
  sensor.stack = {
      .gel_thickness_m = 2e-3, .gel_ior = 1.41, .layers = {{.name = "acrylic", .thickness_m = 5e-3, .ior = 1.49}}};
  sensor.camera.model = Camera::Model::rectified;
  const Vector3 light(14e-3, 5e-3, -9e-3);
  sensor.leds = {{.position_m = light, .rgb = {1, 1, 1}}};
  const TraceResult result = trace(press, sensor, {.subpixels = 1});
  double squared_error = 0.0, squared = 0.0;
  int shadowed = 0;
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 32; ++column) {
      const Vector3 target(4e-3 * ((column + 0.5) / 32 - 0.5), 3e-3 * ((row + 0.5) / 24 - 0.5), 0.0);
      const double seen = ray_parameter(target.norm(), 5e-3, 5e-3, 2e-3), sine = seen / 1.41;
      const Vector3 outwards = target.normalized();
      const Vector3 d(sine * outwards.x(), sine * outwards.y(), std::sqrt(1.0 - sine * sine));
      const Vector3 o = target - d * (2e-3 / d.z());
      const Crossing hit = cross_all(press, o, d, std::numeric_limits<double>::infinity());
      ASSERT_GE(hit.triangle, 0);
      const Vector3 point = o + hit.t * d;
      Vector3 normal = Vector3::Zero(), lift = Vector3::Zero();
      Matrix3 v;
      for (int k = 0; k < 3; ++k) {
        const int vertex = press.triangles(hit.triangle, k);
        v.col(k) = press.positions.row(vertex).transpose();
        const Vector3 n = -press.normals.row(vertex).transpose();
        normal += hit.weights[k] * n;
        const double height = n.dot(point - v.col(k));
        if (height < 0.0) lift += hit.weights[k] * -height * n;
      }
      normal.normalize();
      const Vector3 face = (v.col(2) - v.col(0)).cross(v.col(1) - v.col(0)).normalized();
      const Vector3 start = point + lift + 1e-7 * face;

      const Eigen::Vector2d sideways = (light - point).head<2>();
      const double r = sideways.norm(), gel = point.z() + 2e-3, step = 1e-7;
      const double p = ray_parameter(r, 2e-3, 5e-3, gel);
      const double before = std::asin(ray_parameter(r - step, 2e-3, 5e-3, gel));
      const double after = std::asin(ray_parameter(r + step, 2e-3, 5e-3, gel));
      const double spread = p * (after - before) / (2.0 * step) / r;
      const double in_gel = p / 1.41, cosine_gel = std::sqrt(1.0 - in_gel * in_gel);
      const Vector3 w(in_gel * sideways.x() / r, in_gel * sideways.y() / r, -cosine_gel);
      double expected = 0.0;
      if (normal.dot(w) > 0.0 && cross_all(press, start, w, gel / cosine_gel).triangle < 0) {
        expected = std::sqrt(1.0 - p * p) * transmitted(p) * spread / cosine_gel * normal.dot(w) / std::numbers::pi *
                   transmitted(seen);
      }
      squared_error += std::pow(result.basis.at(column, row, 0) - expected, 2.0);
      squared += expected * expected;
      shadowed += expected == 0.0;
    }
  }
  EXPECT_LT(std::sqrt(squared_error / squared), 1e-4);
  EXPECT_GT(shadowed, 3);
}

}  // namespace trace_oracle_test
}  // namespace tacipc
