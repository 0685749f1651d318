#include "common/sensor/sensor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/units.h"

namespace tacipc {
namespace {

std::array<double, 3> rgb(ConfigReader& in, const std::string& key, const Range& range) {
  const auto values = in.numbers(key, 3, range);
  return {values[0], values[1], values[2]};
}

}  // namespace

GelShape GelShape::read(ConfigReader& in) {
  // A micrometre to ten metres, and no strip: far beyond any sensor, and within the limits of meshing.
  const Range length_mm = Range::between(1e-3, 1e4);
  constexpr double kLongest = 100.0;  // times the shorter side
  GelShape shape;
  const std::string outline = in.choice("outline", {"disc", "rectangle"});
  if (outline == "disc") {
    shape.outline = Outline::disc;
    shape.radius_m = kMillimetre * in.number("radius_mm", length_mm);
  } else {
    shape.outline = Outline::rectangle;
    const auto size = in.numbers("size_mm", 2, length_mm);
    if (std::max(size[0], size[1]) > kLongest * std::min(size[0], size[1]))
      in.fault("size_mm", fmt::format("one side is more than {} times the other", kLongest));
    shape.width_m = kMillimetre * size[0];
    shape.height_m = kMillimetre * size[1];
  }
  shape.thickness_m = kMillimetre * in.number("thickness_mm", length_mm);
  if (const auto dome = in.optional_number("dome_radius_mm", Range::between(1e-3, 1e9))) {
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

bool GelShape::contains(double x, double y) const {
  if (outline == Outline::disc) return std::hypot(x, y) <= radius_m;
  return std::abs(x) <= 0.5 * width_m && std::abs(y) <= 0.5 * height_m;
}

double GelShape::front_z(double x, double y) const {
  if (!dome_radius_m) return 0.0;
  const double squared = x * x + y * y;
  // R − √(R² − r²) = r² / (R + √(R² − r²)), which does not cancel near the apex.
  return -squared / (*dome_radius_m + std::sqrt(std::max(0.0, *dome_radius_m * *dome_radius_m - squared)));
}

Material Material::read(ConfigReader& in) {
  in.accept_sources();
  Material material{.law = in.choice("law", {"neo_hookean", "stvk_hencky"}),
                    .density_kg_m3 = in.number("density_kg_m3", Range::positive()),
                    .youngs_modulus_pa = in.number("youngs_modulus_pa", Range::positive()),
                    .poissons_ratio = in.number("poissons_ratio", Range::between(0.0, 0.4999))};
  double sum = 0.0;
  for (ConfigReader& member : in.sections("relaxation")) {
    const double part = member.number("part", {.low = 0.0, .high = 1.0, .open_low = true, .open_high = true});
    material.relaxation.push_back({part, member.number("time_s", {.low = 0.0, .high = 1e9, .open_low = true})});
    sum += part;
  }
  // The remaining fraction supports the relaxed gel: without it the long-term modulus could not be that of the file.
  if (!(sum < 1.0)) in.fault("relaxation", fmt::format("its parts sum to {:g}, which must be less than 1", sum));
  return material;
}

double Material::lame_lambda_pa() const {
  return youngs_modulus_pa * poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio));
}

double Material::lame_mu_pa() const { return youngs_modulus_pa / (2.0 * (1.0 + poissons_ratio)); }

Mount Mount::read(ConfigReader& in) {
  // At most a metre per newton: a softer spring holds no gel.
  const Range compliance = Range::between(0.0, 1e3);
  return {.compliance_m_per_n = kMillimetre * in.number_or("compliance_mm_per_n", 0.0, compliance),
          .shear_compliance_m_per_n = kMillimetre * in.number_or("shear_compliance_mm_per_n", 0.0, compliance)};
}

MarkerGrid MarkerGrid::read(ConfigReader& in) {
  MarkerGrid grid{.given = true};
  grid.rows = in.integer_or("rows", grid.rows, 1, 1000);
  grid.columns = in.integer_or("columns", grid.columns, 1, 1000);
  grid.pitch_m = kMillimetre * in.number_or("pitch_mm", 1.0, Range::positive());
  const auto center_mm = in.numbers_or("center_mm", {0.0, 0.0});
  grid.center_x_m = kMillimetre * center_mm[0];
  grid.center_y_m = kMillimetre * center_mm[1];
  if (const auto radius_mm = in.optional_number("radius_mm", Range::positive())) {
    grid.radius_m = kMillimetre * *radius_mm;
    grid.albedo = rgb(in, "albedo", Range::between(0.0, 1.0));
  }
  return grid;
}

bool MarkerGrid::covers(double x, double y) const {
  const auto nearest = [&](double at, double center, int count) {
    const double index = std::round((at - center) / pitch_m + 0.5 * (count - 1));
    return static_cast<int>(std::clamp(index, 0.0, count - 1.0));
  };
  const double dx = x - x_m(nearest(x, center_x_m, columns)), dy = y - y_m(nearest(y, center_y_m, rows));
  return dx * dx + dy * dy <= *radius_m * *radius_m;
}

Sensor Sensor::read(ConfigReader& in) {
  in.accept_sources();
  Sensor sensor;
  sensor.name = in.text("name");
  ConfigReader gel = in.section("gel");
  sensor.gel = GelShape::read(gel);
  sensor.friction = gel.optional_number("friction", Range::between(0.0, 10.0));
  sensor.stack = OpticalStack::read(in, gel, sensor.gel.thickness_m);
  ConfigReader material = in.section("material");
  sensor.material = Material::read(material);
  if (auto mount = in.optional_section("mount")) sensor.mount = Mount::read(*mount);
  if (in.has("light_field")) {
    sensor.light_field = LightField::read(in);
  } else {
    ConfigReader coating = in.section("coating");
    sensor.coating = Coating::read(coating);
    if (auto ambient = in.optional_section("ambient")) sensor.ambient_rgb = rgb(*ambient, "rgb", Range::non_negative());
    ConfigReader leds = in.section("leds");
    sensor.leds = Led::read_all(leds, sensor.gel, sensor.stack);
    if (auto diffuser = leds.optional_section("diffuser")) {
      sensor.diffuser = Diffuser::read(*diffuser, sensor.stack, sensor.leds);
    }
    ConfigReader response = in.section("response");
    sensor.response = Response::read(response);
  }
  ConfigReader camera = in.section("camera");
  sensor.camera = Camera::read(camera, sensor.gel, sensor.stack);
  if (auto markers = in.optional_section("markers")) sensor.markers = MarkerGrid::read(*markers);
  if (auto noise = in.optional_section("noise")) sensor.noise = SensorNoise::read(*noise);
  if (const auto reference = in.optional_text("reference_image")) {
    sensor.reference_image = std::filesystem::path(in.source()).parent_path() / *reference;
  }
  if (sensor.light_field) {
    for (const char* key : {"leds", "coating", "ambient", "response"}) {
      if (!in.has(key)) continue;
      in.fault(key, "cannot be combined with a light_field, which defines the change of codes");
      in.ignore(key);
    }
    if (!sensor.reference_image) in.fault("reference_image", "missing: a light_field changes its codes");
    if (sensor.markers.radius_m) in.fault("markers", "a light_field cannot light printed markers: leave radius_mm out");
  }
  for (auto& [path, source] : in.sources()) sensor.sources.push_back({path, source});
  return sensor;
}

}  // namespace tacipc
