#include "common/optics/seen_membrane.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>

#include "common/base/error.h"
#include "common/optics/camera_hits.h"
#include "common/sensor/camera_model.h"

namespace tacipc {

MembraneView view_membrane(const Positions& positions, const Triangles& triangles, const Sensor& sensor) {
  const CameraModel camera(sensor.camera, sensor.stack);
  MembraneView view = flat_view(camera, sensor.camera);
  const Membrane membrane = make_membrane(positions, positions, triangles);
  const RayScene scene(membrane.positions, membrane.triangles);
  std::vector<std::optional<int>> fallen(view.height);
  tbb::parallel_for(0, view.height, [&](int y) {
    const FlushDenormals flush;
    HitCounts counts;
    RayPacket packet;
    for (int first = 0; first < view.width; first += kLanes) {
      Pack columns;
      for (int l = 0; l < kLanes; ++l) columns[l] = first + l + 0.5;
      const CameraRays rays = camera.rays(columns, y + 0.5);
      const auto found = find_hits(scene, membrane, rays, std::min(kLanes, view.width - first), packet, counts);
      if (found.fallen) fallen[y] = first + *found.fallen;
      for (int l = 0; l < kLanes && first + l < view.width; ++l) {
        const auto& hit = found.hits[l];
        if (!hit) continue;
        const std::size_t i = view.index(first + l, y);
        view.point[i] = hit->point;
        view.normal[i] = -hit->inner_normal;
      }
    }
  });
  for (int y = 0; y < view.height; ++y) {
    if (const auto& x = fallen[y])
      throw DataError("a camera ray slips through the front face at pixel ({}, {}), even after a retry", *x, y);
  }
  bound_depth(view);
  return view;
}

MembraneView view_of(const TraceResult& traced, const Sensor& sensor, bool refract) {
  const CameraModel camera(sensor.camera, sensor.stack, refract);
  MembraneView view = flat_view(camera, sensor.camera);
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) {
      const double depth = traced.depth.at(x, y, 0);
      if (std::isnan(depth)) continue;
      const std::size_t i = view.index(x, y);
      view.point[i] = point_at_z(camera, x, y, sensor.camera.position_m.z() + depth);
      view.normal[i] = Vector3(traced.normal.at(x, y, 0), traced.normal.at(x, y, 1), traced.normal.at(x, y, 2));
    }
  });
  bound_depth(view);
  return view;
}

}  // namespace tacipc
