#include "stages/image/render/render_config.h"

#include <numbers>
#include <set>

#include "common/base/rng.h"
#include "common/base/units.h"

namespace tacipc {
namespace {

std::filesystem::path beside(const ConfigReader& in, const std::string& name) {
  return std::filesystem::path(in.source()).parent_path() / name;
}

/// True for a text that may name a folder.
bool plain(const std::string& word) {
  return !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
                              std::string::npos;
}

}  // namespace

Perturbation Perturbation::read(ConfigReader& in) {
  const Range spread = Range::non_negative();
  return {.seed = in.integer("seed", 0),
          .led_position_m = kMillimetre * in.number_or("led_position_mm", 0.0, spread),
          .led_intensity = in.number_or("led_intensity", 0.0, Range::between(0.0, 1.0)),
          .camera_position_m = kMillimetre * in.number_or("camera_position_mm", 0.0, spread),
          .camera_rotation_rad = in.number_or("camera_rotation_deg", 0.0, spread) * std::numbers::pi / 180.0,
          .coating_albedo = in.number_or("coating_albedo", 0.0, Range::between(0.0, 1.0))};
}

Variant Variant::read(ConfigReader& in) {
  Variant variant{.name = in.text("name")};
  if (!plain(variant.name)) in.fault("name", "must be letters, digits, _ and -");
  if (const auto file = in.optional_text("sensor")) variant.sensor = beside(in, *file);
  for (ConfigReader& light : in.sections("lights")) {
    const std::string group = light.text("group");
    std::array<double, 3> color = read_light_color(light);
    const double intensity = light.number_or("intensity", 1.0, Range::non_negative());
    for (double& channel : color) channel *= intensity;
    variant.lights.push_back({group, color});
  }
  if (in.has("coating_albedo")) {
    const auto albedo = in.numbers("coating_albedo", 3, Range::between(0.0, 1.0));
    variant.coating_albedo = {albedo[0], albedo[1], albedo[2]};
  }
  if (const auto file = in.optional_text("reference_image")) variant.reference_image = beside(in, *file);
  if (auto unit = in.optional_section("unit")) variant.perturbation = Perturbation::read(*unit);
  if (!variant.sensor && variant.lights.empty() && !variant.coating_albedo && !variant.reference_image &&
      !variant.perturbation) {
    in.fault("name", "the variant changes nothing: give sensor, lights, coating_albedo, reference_image or unit");
  }
  return variant;
}

RenderConfig RenderConfig::read(ConfigReader& in) {
  RenderConfig config;
  config.frames = read_rendered_frames(in);
  config.trace.subpixels = in.integer_or("subpixels", config.trace.subpixels, 1, 16);
  config.trace.led_samples = in.integer_or("led_samples", config.trace.led_samples, 1, 16);
  config.trace.refract = in.choice_or("refraction", "layered", {"layered", "straight"}) == "layered";
  config.trace.indirect_rays = in.integer_or("indirect_rays", config.trace.indirect_rays, 0, 65536);
  config.basis_images = in.flag_or("basis_images", false);
  const std::string transfer = in.choice_or("transfer", "encoded", {"encoded", "linear", "none"});
  config.transfer = transfer == "encoded"  ? Transfer::encoded
                    : transfer == "linear" ? Transfer::linear
                                           : Transfer::none;
  ConfigReader noise = in.section("noise");
  config.noise_seed = static_cast<std::uint64_t>(noise.integer("seed", 0));
  config.noise_in_every_frame = noise.flag_or("every_frame", false);
  std::set<std::string> names;
  for (ConfigReader& item : in.sections("variants")) {
    config.variants.push_back(Variant::read(item));
    if (!names.insert(config.variants.back().name).second) item.fault("name", "given twice");
  }
  return config;
}

std::uint64_t noise_seed_of_sample(std::uint64_t noise_seed, std::uint64_t sample_seed) {
  return random_bits(sample_seed, hash_of("render"), noise_seed);
}

}  // namespace tacipc
