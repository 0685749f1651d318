#include "stages/rival/mpm/height_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sensor/camera_model.h"

namespace tacipc {
namespace height_map_rays_test {

/// A camera 12 mm behind a gel of 2 mm under 5 mm of acrylic, 15 × 11.25 mm of the front on 160 × 120 pixels.
Sensor behind_acrylic() {
  Sensor sensor;
  sensor.camera.position_m = {0.0, 0.0, -12e-3};
  sensor.camera.width_px = 160;
  sensor.camera.height_px = 120;
  sensor.camera.window_width_m = 15e-3;
  sensor.camera.window_height_m = 11.25e-3;
  sensor.gel.thickness_m = sensor.stack.gel_thickness_m = 2e-3;
  sensor.stack.gel_ior = 1.41;
  sensor.stack.layers = {{.name = "acrylic", .thickness_m = 5e-3, .ior = 1.49}};
  return sensor;
}

FloatImage map_of(const Sensor& sensor, PixelPlaces places, const auto& indentation) {
  FloatImage map(sensor.camera.width_px, sensor.camera.height_px, 1);
  const PixelLine columns(0.0, sensor.camera.window_width_m, map.width, places);
  const PixelLine rows(0.0, sensor.camera.window_height_m, map.height, places);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.at(x, y, 0) = static_cast<float>(indentation(columns.place(x), rows.place(y)));
  return map;
}

TEST(SeenAlongRays, ASlopeIsMetWhereRayAndPlaneMeet) {
  const Sensor sensor = behind_acrylic();
  const CameraModel rays(sensor.camera, sensor.stack);
  const auto plane = [](double x, double y) { return 0.5e-3 + 0.04 * x - 0.02 * y; };
  for (const auto places : {PixelPlaces::centres, PixelPlaces::ends}) {
    const FloatImage seen = seen_along_rays(map_of(sensor, places, plane), sensor, places);
    for (int y = 10; y < 110; ++y) {
      for (int x = 10; x < 150; ++x) {
        const double depth = seen.at(x, y, 0);
        const CameraRay ray = rays.ray(x + 0.5, y + 0.5).value();
        const Vector3 point = ray.origin + (-depth - ray.origin.z()) / ray.direction.z() * ray.direction;
        ASSERT_NEAR(depth, plane(point.x(), point.y()), 1e-9) << x << ", " << y;
      }
    }
  }
}

TEST(SeenAlongRays, ALevelFrontStaysLevel) {
  const Sensor sensor = behind_acrylic();
  const auto level = [](double, double) { return 0.25e-3; };
  for (const float depth :
       seen_along_rays(map_of(sensor, PixelPlaces::centres, level), sensor, PixelPlaces::centres).pixels)
    ASSERT_FLOAT_EQ(depth, 0.25e-3f);
}

TEST(SeenAlongRays, WhatComesNearerLooksLarger) {
  // A disc of 5 mm radius pressed 1 mm deep: its rim is seen where the camera sees a point of that depth there.
  const Sensor sensor = behind_acrylic();
  const double depth = 1e-3, radius = 5e-3;
  const auto disc = [&](double x, double y) { return std::hypot(x, y) < radius ? depth : 0.0; };
  const FloatImage seen = seen_along_rays(map_of(sensor, PixelPlaces::centres, disc), sensor, PixelPlaces::centres);
  const CameraModel rays(sensor.camera, sensor.stack);
  const double rim = rays.project({radius, 0.0, -depth}).value().x();
  const double flat_rim = rays.project({radius, 0.0, 0.0}).value().x();
  ASSERT_GT(rim, flat_rim + 2.0);
  int last = 80;
  while (seen.at(last, 60, 0) > 0.999f * static_cast<float>(depth)) ++last;
  EXPECT_NEAR(last, rim, 1.6);
  EXPECT_EQ(seen.at(155, 60, 0), 0.0f);
}

}  // namespace height_map_rays_test
}  // namespace tacipc
