#include "common/sensor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc {
namespace {

constexpr double kMillimetre = 1e-3;

std::array<double, 3> rgb(ConfigReader& in, const std::string& key, const Range& range) {
  const auto values = in.numbers(key, 3, range);
  return {values[0], values[1], values[2]};
}

/// Colour of one light: `rgb_linear` or `cct_k`, exactly one, times `intensity`.
std::array<double, 3> light_color(ConfigReader& in) {
  std::array<double, 3> color{1.0, 1.0, 1.0};
  const bool has_rgb = in.has("rgb_linear"), has_cct = in.has("cct_k");
  if (has_rgb) color = rgb(in, "rgb_linear", Range::non_negative());
  if (has_cct) color = color_of_temperature(in.number("cct_k", Range::between(1000.0, 25000.0)));
  if (has_rgb == has_cct) in.fault("rgb_linear", "give either rgb_linear or cct_k");
  const double intensity = in.number("intensity", Range::non_negative());
  for (double& channel : color) channel *= intensity;
  return color;
}

/// Gaussian lobe of the colour-matching fit, with a width for each side.
double lobe(double nanometre, double mean, double left, double right) {
  const double t = (nanometre - mean) * (nanometre < mean ? left : right);
  return std::exp(-0.5 * t * t);
}

}  // namespace

GelShape GelShape::read(ConfigReader& in) {
  GelShape shape;
  const std::string outline = in.choice("outline", {"disc", "rectangle"});
  if (outline == "disc") {
    shape.outline = Outline::disc;
    shape.radius_m = kMillimetre * in.number("radius_mm", Range::positive());
  } else {
    shape.outline = Outline::rectangle;
    const auto size = in.numbers("size_mm", 2, Range::positive());
    shape.width_m = kMillimetre * size[0];
    shape.height_m = kMillimetre * size[1];
  }
  shape.thickness_m = kMillimetre * in.number("thickness_mm", Range::positive());
  if (const auto dome = in.optional_number("dome_radius_mm", Range::positive())) {
    shape.dome_radius_m = kMillimetre * *dome;
    const double reach =
        shape.outline == Outline::disc ? shape.radius_m : std::hypot(shape.width_m, shape.height_m) / 2.0;
    if (reach >= *shape.dome_radius_m) {
      in.fault("dome_radius_mm", fmt::format("must exceed the gel's half width, {} mm", reach / kMillimetre));
      shape.dome_radius_m.reset();
    } else if (-shape.front_z(reach, 0.0) >= shape.thickness_m) {
      in.fault("thickness_mm",
               fmt::format("must exceed the dome's sag, {:.4g} mm", -shape.front_z(reach, 0.0) / kMillimetre));
    }
  }
  return shape;
}

double GelShape::front_z(double x, double y) const {
  if (!dome_radius_m) return 0.0;
  const double squared = x * x + y * y;
  // R − √(R² − r²) = r² / (R + √(R² − r²)), free of cancellation near the apex.
  return -squared / (*dome_radius_m + std::sqrt(std::max(0.0, *dome_radius_m * *dome_radius_m - squared)));
}

Material Material::read(ConfigReader& in) {
  return {.law = in.choice("law", {"neo_hookean", "stvk_hencky"}),
          .density_kg_m3 = in.number("density_kg_m3", Range::positive()),
          .youngs_modulus_pa = in.number("youngs_modulus_pa", Range::positive()),
          .poissons_ratio = in.number("poissons_ratio", Range::between(0.0, 0.4999))};
}

double Material::lame_lambda_pa() const {
  return youngs_modulus_pa * poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio));
}

double Material::lame_mu_pa() const { return youngs_modulus_pa / (2.0 * (1.0 + poissons_ratio)); }

std::vector<Led> Led::read_all(ConfigReader& in) {
  std::vector<Led> leds;
  const bool lambertian = in.choice_or("emission", "lambertian", {"lambertian", "isotropic"}) == "lambertian";
  const double size_m = kMillimetre * in.number_or("size_mm", 0.0, Range::non_negative());
  if (auto ring = in.optional_section("ring")) {
    const double radius_m = kMillimetre * ring->number("radius_mm", Range::positive());
    const double z_m = kMillimetre * ring->number("z_mm", {.high = 0.0, .open_high = true});
    const int count = ring->integer("count", 1, 1024);
    const double first_rad = ring->number_or("first_azimuth_deg", 0.0) * std::numbers::pi / 180.0;
    std::vector<bool> lit(static_cast<std::size_t>(count), false);
    for (ConfigReader& item : ring->sections("lit")) {
      const int index = item.integer("index", 0, count - 1);
      if (lit[static_cast<std::size_t>(index)]) item.fault("index", fmt::format("LED {} is given twice", index));
      lit[static_cast<std::size_t>(index)] = true;
      const double azimuth = first_rad + 2.0 * std::numbers::pi * index / count;
      leds.push_back({.position_m = {radius_m * std::cos(azimuth), radius_m * std::sin(azimuth), z_m},
                      .rgb = light_color(item),
                      .size_m = {size_m, size_m},
                      .lambertian = lambertian});
    }
    if (leds.empty()) ring->fault("lit", "no LED is lit");
  }
  for (ConfigReader& item : in.sections("list")) {
    Led led{
        .position_m = kMillimetre * item.vector3("position_mm"), .size_m = {size_m, size_m}, .lambertian = lambertian};
    if (item.has("normal")) {
      led.normal = item.vector3("normal");
      if (led.normal.norm() < 1e-9) item.fault("normal", "must not be zero");
      led.normal.normalize();
    }
    led.rgb = light_color(item);
    leds.push_back(led);
  }
  if (leds.empty() && !in.has("ring")) in.fault("ring", "give a ring or a list of LEDs");
  return leds;
}

Camera Camera::read(ConfigReader& in) {
  Camera camera;
  camera.position_m = kMillimetre * in.vector3("position_mm");
  if (camera.position_m.z() >= 0.0) in.fault("position_mm", "the camera must lie behind the front face (z < 0)");
  camera.width_px = in.integer("width_px", 1, 16384);
  camera.height_px = in.integer("height_px", 1, 16384);
  const auto window = in.numbers("window_mm", 2, Range::positive());
  camera.window_width_m = kMillimetre * window[0];
  camera.window_height_m = kMillimetre * window[1];
  return camera;
}

Response Response::read(ConfigReader& in) {
  return {.mean_level = in.number("mean_level", {.low = 0.0, .high = 1.0, .open_low = true, .open_high = true}),
          .curve = in.choice("curve", {"srgb", "linear"})};
}

MarkerGrid MarkerGrid::read(ConfigReader& in) {
  MarkerGrid grid{.given = true};
  grid.rows = in.integer_or("rows", grid.rows, 1, 1000);
  grid.columns = in.integer_or("columns", grid.columns, 1, 1000);
  grid.pitch_m = kMillimetre * in.number_or("pitch_mm", 1.0, Range::positive());
  const auto center_mm = in.numbers_or("center_mm", {0.0, 0.0});
  grid.center_x_m = kMillimetre * center_mm[0];
  grid.center_y_m = kMillimetre * center_mm[1];
  return grid;
}

Sensor Sensor::read(ConfigReader& in) {
  Sensor sensor;
  sensor.name = in.text("name");
  ConfigReader gel = in.section("gel");
  sensor.gel = GelShape::read(gel);
  ConfigReader material = in.section("material");
  sensor.material = Material::read(material);
  ConfigReader coating = in.section("coating");
  sensor.coating_albedo = rgb(coating, "albedo", Range::between(0.0, 1.0));
  if (auto ambient = in.optional_section("ambient")) sensor.ambient_rgb = rgb(*ambient, "rgb", Range::non_negative());
  ConfigReader leds = in.section("leds");
  sensor.leds = Led::read_all(leds);
  ConfigReader camera = in.section("camera");
  sensor.camera = Camera::read(camera);
  if (auto markers = in.optional_section("markers")) sensor.markers = MarkerGrid::read(*markers);
  ConfigReader response = in.section("response");
  sensor.response = Response::read(response);
  if (const auto reference = in.optional_text("reference_image")) {
    sensor.reference_image = std::filesystem::path(in.source()).parent_path() / *reference;
  }
  return sensor;
}

std::array<double, 3> color_of_temperature(double kelvin) {
  constexpr double kSecondRadiation = 1.438776877e7;  // nm K
  Vector3 xyz = Vector3::Zero();
  for (int nanometre = 380; nanometre <= 780; nanometre += 5) {
    const double w = nanometre;
    const double planck = std::pow(w / 560.0, -5.0) / std::expm1(kSecondRadiation / (w * kelvin));
    const Vector3 cmf(1.056 * lobe(w, 599.8, 0.0264, 0.0323) + 0.362 * lobe(w, 442.0, 0.0624, 0.0374) -
                          0.065 * lobe(w, 501.1, 0.0490, 0.0382),
                      0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
                      1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725));
    xyz += planck * cmf;
  }
  Matrix3 srgb_from_xyz;
  srgb_from_xyz << 3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434, -0.2040259,
      1.0572252;
  const Vector3 color = (srgb_from_xyz * xyz).cwiseMax(0.0);
  return {color.x() / color.maxCoeff(), color.y() / color.maxCoeff(), color.z() / color.maxCoeff()};
}

}  // namespace tacipc
