#include "stages/image/shade/fit_place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/optics/seen_membrane.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

Vector3 plane_point(const ImagePlace& place, const Sensor& sensor) {
  const auto point = CameraModel(sensor.camera, sensor.stack).on_plane(place.x_px + 0.5, place.y_px + 0.5);
  if (!point)
    throw DataError("place ({}, {}) px: the camera does not see the front face there", place.x_px, place.y_px);
  return {point->x(), point->y(), 0.0};
}

/// Mean square residual in the box.
double mismatch(const ByteImage& image, const ByteImage& photograph, const std::array<int, 4>& box) {
  double squares = 0.0;
  std::int64_t inside = 0;
  for (int c = 0; c < image.channels; ++c) {
    double outside_sum = 0.0, sum = 0.0, square = 0.0;
    std::int64_t outside_count = 0, count = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double difference = int{photograph.at(x, y, c)} - int{image.at(x, y, c)};
        if (x >= box[0] && x < box[0] + box[2] && y >= box[1] && y < box[1] + box[3]) {
          sum += difference;
          square += difference * difference;
          ++count;
        } else {
          outside_sum += difference;
          ++outside_count;
        }
      }
    }
    const double drift = outside_count > 0 ? outside_sum / static_cast<double>(outside_count) : 0.0;
    squares += square - 2.0 * drift * sum + static_cast<double>(count) * drift * drift;
    inside += count;
  }
  return squares / static_cast<double>(inside);
}

}  // namespace

Positions at_place(const Positions& front, const ImagePlace& place, const Sensor& sensor) {
  const Vector3 to = plane_point(place, sensor);
  return moved(front, to.x(), to.y(), place.yaw_rad);
}

Matrix4 place_pose(const ImagePlace& place, const Sensor& sensor) {
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(place.yaw_rad, Vector3::UnitZ()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = plane_point(place, sensor);
  return pose;
}

MembraneView view_at(const FrontFrames& press, int frame, const ImagePlace& place, const PrintRelief* relief,
                     const Sensor& sensor) {
  const auto at = static_cast<std::size_t>(frame);
  MembraneView view = view_membrane(at_place(press.frames[at], place, sensor), press.triangles, sensor);
  if (!relief) return view;
  const Vector3 axis = plane_point(place, sensor);
  apply_relief(*relief, {axis.x(), axis.y(), place.yaw_rad, press.gel_from_object[at](2, 3)}, view);
  return view;
}

FittedPlace fit_place(const FrontFrames& press, int frame, const ImagePlace& start, const PlaceFit& fit,
                      const ByteImage& photograph, const ByteImage& background, const LightField& light,
                      const Sensor& sensor, const PrintRelief* relief) {
  constexpr double kSmallestStep = 1.0 / 32.0;
  FittedPlace result{.place = start};
  const auto score = [&](const ImagePlace& place) {
    ++result.views;
    const MembraneView view = view_at(press, frame, place, relief, sensor);
    return mismatch(add_change(background, code_change(light, view)), photograph, fit.box_px);
  };
  double best = score(start);
  result.rmse_before = std::sqrt(best);
  for (double step = 1.0; step >= kSmallestStep; step /= 2.0) {
    for (bool paid = true; paid;) {
      paid = false;
      for (int parameter = 0; parameter < (fit.yaw ? 3 : 2); ++parameter) {
        for (const double sign : {1.0, -1.0}) {
          ImagePlace tried = result.place;
          if (parameter == 0) tried.x_px += sign * step;
          if (parameter == 1) tried.y_px += sign * step;
          if (parameter == 2) tried.yaw_rad += sign * step * kDegree;
          const double value = score(tried);
          if (!(value < best)) continue;
          best = value;
          result.place = tried;
          paid = true;
          break;
        }
      }
    }
  }
  result.rmse_after = std::sqrt(best);
  return result;
}

}  // namespace tacipc
