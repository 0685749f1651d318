#include "common/benchmark/image_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/benchmark/benchmark_cases.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

/// Returns the mean square residual in the box.
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

ImagePlaces ImagePlaces::read(ConfigReader& in) {
  ImagePlaces config;
  if (auto ball = in.optional_section("ball"))
    config.ball_radius_m = 1e-3 * ball->number("radius_mm", Range::positive());
  for (ConfigReader& item : in.one_or_more_sections("images")) {
    NamedFrame image{.name = item.text("name"), .frame = 0, .contact = std::nullopt};
    if (config.ball_radius_m) {
      const auto center = item.numbers("center_px", 2);
      image.contact = ContactPlace{.center = {.x_px = center[0], .y_px = center[1]},
                                   .radius_px = item.number("contact_px", Range::positive())};
    } else {
      image.frame = item.integer("frame", 0, 1000000);
    }
    config.images.push_back(image);
    if (std::ranges::count(config.images, config.images.back().name, &NamedFrame::name) > 1)
      item.fault("name", "is given twice");
  }
  if (config.ball_radius_m) return config;
  ConfigReader place = in.section("place");
  const auto center = place.numbers("center_px", 2);
  config.place = {
      .x_px = center[0], .y_px = center[1], .yaw_rad = place.number_or("yaw_deg", 0.0) * std::numbers::pi / 180.0};
  if (auto fit = in.optional_section("fit")) {
    PlaceFit wanted{.image = fit->text("image"), .box_px = {}, .yaw = fit->flag("yaw")};
    wanted.box_px = pixel_box(*fit, "box_px");
    if (std::ranges::count(config.images, wanted.image, &NamedFrame::name) == 0)
      fit->fault("image", "is not one of the images");
    config.fit = wanted;
  }
  return config;
}

Matrix4 place_pose(const ImagePlace& place, const Sensor& sensor) {
  const auto point = CameraModel(sensor.camera, sensor.stack).on_plane(place.x_px + 0.5, place.y_px + 0.5);
  if (!point)
    throw DataError("place ({}, {}) px: the camera does not see the front face there", place.x_px, place.y_px);
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(place.yaw_rad, Vector3::UnitZ()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = Vector3(point->x(), point->y(), 0.0);
  return pose;
}

Value FittedPlace::to_value(const std::string& image) const {
  return Value::Map{
      {"image", image}, {"rmse_codes_before", rmse_before}, {"rmse_codes_after", rmse_after}, {"views", views}};
}

FittedPlace search_place(const ImagePlace& start, const PlaceFit& fit, const ByteImage& photograph,
                         const std::function<ByteImage(const ImagePlace&)>& image_at) {
  constexpr double kSmallestStep = 1.0 / 32.0;
  FittedPlace result{.place = start};
  const auto score = [&](const ImagePlace& place) {
    ++result.views;
    return mismatch(image_at(place), photograph, fit.box_px);
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
