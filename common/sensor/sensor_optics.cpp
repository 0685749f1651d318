// Reads the optical half of a sensor file: layers, paint, lights, camera, response.
#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "common/base/units.h"
#include "common/sensor/camera_model.h"
#include "common/sensor/light_color.h"
#include "common/sensor/sensor.h"

namespace tacipc {
namespace {

std::array<double, 3> triple(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

/// Reads a number for a square, or two: radial and tangential about the sensor's axis.
std::array<double, 2> emitter_size(ConfigReader& in, const std::array<double, 2>& otherwise) {
  if (in.has("size_mm") && in.is_list("size_mm")) {
    const auto size = in.numbers("size_mm", 2, Range::non_negative());
    return {kMillimetre * size[0], kMillimetre * size[1]};
  }
  if (!in.has("size_mm")) return otherwise;
  const double size = kMillimetre * in.number("size_mm", Range::non_negative());
  return {size, size};
}

/// Reads the keys that an LED, or the section for all LEDs, may give.
Led emitter(ConfigReader& in, Led led) {
  const std::vector<std::string> names = {"lambertian", "isotropic", "cosine_power"};
  const std::string emission = in.choice_or("emission", names[static_cast<std::size_t>(led.emission)], names);
  led.emission = static_cast<Emission>(std::ranges::find(names, emission) - names.begin());
  led.size_m = emitter_size(in, led.size_m);
  if (in.has("emission_exponent")) {
    led.emission_exponent = in.number("emission_exponent", Range::non_negative());
    if (led.emission != Emission::cosine_power) in.fault("emission_exponent", "belongs to emission: cosine_power only");
  }
  return led;
}

void read_color(ConfigReader& in, Led& led, std::vector<Led>& leds) {
  led.rgb = read_light_color(in);
  led.intensity = in.number("intensity", Range::non_negative());
  led.group = in.optional_text("group").value_or("");
  for (const Led& other : leds) {
    if (led.group.empty() || other.group != led.group || other.rgb == led.rgb) continue;
    in.fault("group", fmt::format("LEDs of the group {} must have one colour", led.group));
    break;
  }
  leds.push_back(led);
}

/// Reports an LED at a position from which light cannot be traced.
void check_place(ConfigReader& in, const std::string& key, const Led& led, const GelShape& gel,
                 const OpticalStack& stack) {
  const double x = led.position_m.x(), y = led.position_m.y(), z = led.position_m.z();
  const double back_mm = -gel.thickness_m / kMillimetre;
  if (z > -gel.thickness_m && z <= 0.0 && gel.contains(x, y)) {
    in.fault(key, fmt::format("the LED lies inside the gel (which reaches to z = {:g} mm)", back_mm));
  } else if (stack.refracts() && z >= -gel.thickness_m) {
    in.fault(key, fmt::format("the LED must lie behind the gel (z < {:g} mm) where light is refracted", back_mm));
  }
}

}  // namespace

std::array<double, 3> read_light_color(ConfigReader& in) {
  const int ways = in.has("rgb_linear") + in.has("cct_k") + in.has("wavelength_nm");
  std::array<double, 3> color{1.0, 1.0, 1.0};
  if (in.has("rgb_linear")) color = triple(in.numbers("rgb_linear", 3, Range::non_negative()));
  if (in.has("cct_k")) color = color_of_temperature(in.number("cct_k", Range::between(1000.0, 25000.0)));
  if (in.has("wavelength_nm")) {
    const double peak_nm = in.number("wavelength_nm", Range::between(400.0, 700.0));
    color = color_of_line(peak_nm, in.number("fwhm_nm", Range::between(1.0, 200.0)));
    const double largest = std::max({color[0], color[1], color[2]});
    for (double& channel : color) channel = std::max(0.0, channel) / largest;
  }
  if (ways != 1) in.fault("rgb_linear", "give one of rgb_linear, cct_k and wavelength_nm");
  return color;
}

OpticalStack OpticalStack::read(ConfigReader& sensor, ConfigReader& gel, double gel_thickness_m) {
  const Range index = Range::between(1.0, 3.0);
  OpticalStack stack{.gel_thickness_m = gel_thickness_m, .gel_ior = gel.optional_number("ior", index)};
  for (ConfigReader& item : sensor.sections("layers")) {
    stack.layers.push_back({.name = item.text("name"),
                            .thickness_m = kMillimetre * item.number("thickness_mm", Range::positive()),
                            .ior = item.number("ior", index)});
  }
  if (!stack.layers.empty() && !stack.gel_ior) gel.fault("ior", "missing: light is refracted where there are layers");
  if (stack.layers.size() + 2 > LayerStack::kMaxLayers)
    sensor.fault("layers", fmt::format("at most {} layers", LayerStack::kMaxLayers - 2));
  return stack;
}

double OpticalStack::back_z_m() const {
  double z = -gel_thickness_m;
  for (const Layer& layer : layers) z -= layer.thickness_m;
  return z;
}

LayerStack OpticalStack::from(double z_m) const {
  assert(refracts() && z_m < -gel_thickness_m);
  std::size_t holding = 0;  // layer that contains z_m, or the number of layers for air
  double top = -gel_thickness_m;
  while (holding < layers.size() && z_m < top - layers[holding].thickness_m) top -= layers[holding++].thickness_m;
  LayerStack stack;
  stack.add(top - z_m, holding < layers.size() ? layers[holding].ior : 1.0);
  while (holding-- > 0) stack.add(layers[holding].thickness_m, layers[holding].ior);
  stack.add(gel_thickness_m, *gel_ior);
  return stack;
}

Coating Coating::read(ConfigReader& in) {
  Coating coating{.albedo = triple(in.numbers("albedo", 3, Range::between(0.0, 1.0)))};
  coating.specular_f0 = in.number_or("specular_f0", 0.0, Range::between(0.0, 1.0));
  if (coating.specular_f0 > 0.0) coating.ggx_alpha = in.number("ggx_alpha", Range::between(0.02, 1.0));
  for (const double albedo : coating.albedo) {
    if (albedo + coating.specular_f0 <= 1.0) continue;
    in.fault("specular_f0", "albedo and specular_f0 add up to more than 1");
    break;
  }
  return coating;
}

std::vector<Led> Led::read_all(ConfigReader& in, const GelShape& gel, const OpticalStack& stack) {
  std::vector<Led> leds;
  const Led common = emitter(in, {});
  if (auto ring = in.optional_section("ring")) {
    const double radius_m = kMillimetre * ring->number("radius_mm", Range::positive());
    const double z_m = kMillimetre * ring->number("z_mm", {.high = 0.0, .open_high = true});
    const int count = ring->integer("count", 1, 1024);
    const double first_rad = kDegree * ring->number_or("first_azimuth_deg", 0.0);
    const double tilt_rad = kDegree * ring->number_or("tilt_deg", 0.0, Range::between(0.0, 180.0));
    std::vector<bool> lit(count, false);
    for (ConfigReader& item : ring->sections("lit")) {
      const int index = item.integer("index", 0, count - 1);
      if (lit[index]) item.fault("index", fmt::format("LED {} is given twice", index));
      lit[index] = true;
      const double azimuth = first_rad + 2.0 * std::numbers::pi * index / count;
      Led led = emitter(item, common);
      led.position_m = {radius_m * std::cos(azimuth), radius_m * std::sin(azimuth), z_m};
      led.normal = {-std::sin(tilt_rad) * std::cos(azimuth), -std::sin(tilt_rad) * std::sin(azimuth),
                    std::cos(tilt_rad)};
      if (leds.empty()) check_place(*ring, "z_mm", led, gel, stack);  // all LEDs of a ring have equal positions in z
      read_color(item, led, leds);
    }
    if (leds.empty()) ring->fault("lit", "no LED is lit");
  }
  for (ConfigReader& item : in.sections("list")) {
    Led led = emitter(item, common);
    led.position_m = kMillimetre * item.vector3("position_mm");
    if (item.has("normal")) {
      led.normal = item.vector3("normal");
      if (led.normal.norm() < 1e-9) item.fault("normal", "must not be zero");
      led.normal.normalize();
    }
    check_place(item, "position_mm", led, gel, stack);
    read_color(item, led, leds);
  }
  if (leds.empty() && !in.has("ring")) in.fault("ring", "give a ring or a list of LEDs");
  return leds;
}

std::vector<LightGroup> light_groups(const std::vector<Led>& leds) {
  std::vector<LightGroup> groups;
  for (std::size_t i = 0; i < leds.size(); ++i) {
    auto group =
        std::ranges::find_if(groups, [&](const LightGroup& g) { return !g.name.empty() && g.name == leds[i].group; });
    if (group == groups.end()) {
      groups.push_back({.name = leds[i].group, .rgb = leds[i].rgb});
      group = groups.end() - 1;
    }
    group->leds.push_back(static_cast<int>(i));
  }
  return groups;
}

Diffuser Diffuser::read(ConfigReader& in, const OpticalStack& stack, const std::vector<Led>& leds) {
  Diffuser diffuser{.inner_radius_m = kMillimetre * in.number("inner_radius_mm", Range::non_negative()),
                    .outer_radius_m = kMillimetre * in.number("outer_radius_mm", Range::positive()),
                    .z_m = kMillimetre * in.number("z_mm", {.high = 0.0, .open_high = true}),
                    .transmittance = in.number("transmittance", {.low = 0.0, .high = 1.0, .open_low = true})};
  if (diffuser.outer_radius_m <= diffuser.inner_radius_m) in.fault("outer_radius_mm", "must exceed inner_radius_mm");
  if (diffuser.z_m > stack.back_z_m() + 1e-9)
    in.fault("z_mm", fmt::format("must lie behind gel and layers (z <= {:g} mm)", stack.back_z_m() / kMillimetre));
  for (const Led& led : leds) {
    if (led.position_m.z() < diffuser.z_m - 1e-4) continue;
    in.fault("z_mm", "must lie at least 0.1 mm before every LED");
    break;
  }
  return diffuser;
}

namespace {

/// Returns the keys of the file that define the camera's view; exactly one is allowed.
std::vector<std::string> ways_given(const ConfigReader& in) {
  std::vector<std::string> given;
  for (const char* key : {"window_mm", "intrinsics_px", "horizontal_fov_deg"})
    if (in.has(key)) given.emplace_back(key);
  return given;
}

}  // namespace

Camera Camera::read(ConfigReader& in, const GelShape& gel, const OpticalStack& stack) {
  Camera camera;
  const std::string model = in.choice_or("model", "pinhole", {"pinhole", "fisheye", "rectified"});
  camera.model = model == "pinhole" ? Model::pinhole : model == "fisheye" ? Model::fisheye : Model::rectified;
  camera.position_m = kMillimetre * in.vector3("position_mm");
  const bool behind = stack.refracts() ? camera.position_m.z() < -gel.thickness_m : camera.position_m.z() < 0.0;
  if (!behind) {
    in.fault("position_mm", stack.refracts() ? fmt::format("the camera must lie behind the gel (z < {:g} mm)",
                                                           -gel.thickness_m / kMillimetre)
                                             : "the camera must lie behind the front face (z < 0)");
    camera.position_m.z() = stack.back_z_m() - 1.0;
  }
  const auto rotation_deg = in.numbers_or("rotation_deg", {0.0, 0.0, 0.0}, Range::between(-180.0, 180.0));
  camera.rotation_rad = kDegree * Vector3(rotation_deg[0], rotation_deg[1], rotation_deg[2]);
  camera.width_px = in.integer("width_px", 1, 16384);
  camera.height_px = in.integer("height_px", 1, 16384);
  const bool fisheye = camera.model == Model::fisheye, rectified = camera.model == Model::rectified;
  const std::vector<std::string> ways = ways_given(in);
  if (ways.empty()) in.fault("window_mm", "give one of window_mm, intrinsics_px and horizontal_fov_deg");
  if (ways.size() > 1) in.fault(ways[1], fmt::format("the file also has {}: give one of the two", ways[0]));
  if (rectified && ways.size() == 1 && !in.has("window_mm"))
    in.fault(ways[0], "not of a rectified camera, which has a window instead (window_mm)");
  if (rectified && (rotation_deg[0] != 0.0 || rotation_deg[1] != 0.0))
    in.fault("rotation_deg", "a rectified picture turns about z only");
  if (in.has("window_mm")) {
    const auto window = in.numbers("window_mm", 2, Range::positive());
    camera.window_width_m = kMillimetre * window[0];
    camera.window_height_m = kMillimetre * window[1];
  }
  if (in.has("intrinsics_px")) {
    const auto px = in.numbers("intrinsics_px", 4, Range::positive());
    camera.intrinsics_px = {px[0], px[1], px[2], px[3]};
  } else if (in.has("horizontal_fov_deg")) {
    const double half = 0.5 * kDegree * in.number("horizontal_fov_deg", Range::between(1.0, fisheye ? 178.0 : 170.0));
    const double focal = 0.5 * camera.width_px / (fisheye ? half : std::tan(half));
    camera.intrinsics_px = {focal, focal, 0.5 * camera.width_px, 0.5 * camera.height_px};
  }
  if (auto distortion = in.optional_section("distortion")) {
    camera.radial = triple(distortion->numbers_or("radial", {0.0, 0.0, 0.0}));
    const auto p = distortion->numbers_or("tangential", {0.0, 0.0});
    camera.tangential = {p[0], p[1]};
    if (rectified) in.fault("distortion", "a rectified picture has none");
    if (fisheye && camera.tangential != std::array<double, 2>{})
      distortion->fault("tangential", "not of a fisheye camera");
  }
  if (auto vignetting = in.optional_section("vignetting")) {
    camera.vignetting = {vignetting->number_or("v2", 0.0), vignetting->number_or("v4", 0.0)};
    const auto [v2, v4] = camera.vignetting;
    const double turn = v4 != 0.0 ? -0.5 * v2 / v4 : 1.0;  // ρ² at which the polynomial has its extremum
    const double least = std::min(1.0 + v2 + v4, turn > 0.0 && turn < 1.0 ? 1.0 + 0.5 * v2 * turn : 1.0);
    if (least <= 0.0) in.fault("vignetting", "leaves no light somewhere in the image");
  }
  const CameraModel rays(camera, stack);
  if (camera.intrinsics_px) {
    const double w = camera.width_px, h = camera.height_px;
    const auto left = rays.on_plane(0.0, 0.5 * h), right = rays.on_plane(w, 0.5 * h), top = rays.on_plane(0.5 * w, 0.0),
               bottom = rays.on_plane(0.5 * w, h);
    if (left && right && top && bottom) {
      camera.window_width_m = (*right - *left).norm();
      camera.window_height_m = (*bottom - *top).norm();
    } else {
      in.fault(ways[0], "the edges of the picture do not see the plane of the front face");
    }
  }
  int seen = 0;
  for (int i = 0; i < 33 * 33; ++i) {
    const auto point = rays.on_plane(camera.width_px * (i % 33 + 0.5) / 33, camera.height_px * (i / 33 + 0.5) / 33);
    seen += point && gel.contains(point->x(), point->y());
  }
  if (seen == 0 && behind && ways.size() == 1) in.fault("position_mm", "the camera sees nothing of the gel");
  return camera;
}

Response Response::read(ConfigReader& in) {
  Response response;
  if (in.has("exposure")) {
    response.exposure = in.number("exposure", Range::positive());
    if (in.has("mean_level")) in.fault("mean_level", "give either mean_level or exposure");
    in.ignore("mean_level");
  } else {
    response.mean_level = in.number("mean_level", {.low = 0.0, .high = 1.0, .open_low = true, .open_high = true});
  }
  response.curve = in.choice("curve", {"srgb", "linear", "gamma"});
  if (response.curve == "gamma") response.gamma = in.number("gamma", Range::between(0.2, 5.0));
  response.white_balance = triple(in.numbers_or("white_balance", {1.0, 1.0, 1.0}, Range::positive()));
  const auto matrix = in.numbers_or("color_matrix", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  std::ranges::copy(matrix, response.color_matrix.begin());
  return response;
}

SensorNoise SensorNoise::read(ConfigReader& in) {
  return {.full_well_e = in.number("full_well_e", Range::positive()),
          .read_e = in.number("read_e", Range::non_negative())};
}

}  // namespace tacipc
