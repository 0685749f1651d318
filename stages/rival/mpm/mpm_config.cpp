#include "stages/rival/mpm/mpm_config.h"

#include <map>

#include "common/base/units.h"

namespace tacipc {
namespace {

constexpr int kMaxCount = 4096;

std::array<int, 3> read_counts(ConfigReader& in) {
  std::array<int, 3> counts{};
  const auto numbers = in.numbers("counts", 3, Range::between(2, kMaxCount));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    counts[axis] = static_cast<int>(numbers[axis]);
    if (counts[axis] != numbers[axis]) in.fault("counts", "must be whole numbers");
  }
  return counts;
}

/// Tolerance of the front's depth in a frame; the published programs use three values.
double read_frame_within_m(ConfigReader& in) {
  static const std::map<std::string, double> kWithin{
      {"beyond", 0.0}, {"within_1um", 1e-6}, {"within_10um", 1e-5}, {"within_100um", 1e-4}};
  return kWithin.at(in.choice_or("frame_criterion", "beyond", {"beyond", "within_1um", "within_10um", "within_100um"}));
}

}  // namespace

LatticeConfig LatticeConfig::read(ConfigReader& in) {
  LatticeConfig config;
  if (in.choice("lattice", {"sensor", "block"}) == "block") config.counts = read_counts(in);
  config.spacing_m = kMillimetre * in.number("spacing_mm", Range::positive());
  config.on_faces = in.choice("particles", {"on_faces", "inside"}) == "on_faces";
  if (const auto volume = in.optional_number("volume_mm3", Range::positive())) config.volume_m3 = 1e-9 * *volume;
  if (in.choice("glued", {"nodes", "layers"}) == "layers")
    config.fixed_layers = in.integer("fixed_layers", 1, kMaxCount);
  return config;
}

ObjectPointsConfig ObjectPointsConfig::read(ConfigReader& in) {
  ObjectPointsConfig config;
  config.samples_per_m2 = 1e6 * in.number("samples_per_mm2", Range::positive());
  config.mass_ratio = in.number("mass_ratio", Range::positive());
  config.press_speed_m_s = kMillimetre * in.number("press_speed_mm_s", Range::positive());
  config.move_speed_m_s = kMillimetre * in.number("move_speed_mm_s", Range::positive());
  config.start_gap_m = kMillimetre * in.number("start_gap_mm", Range::non_negative());
  config.seed = static_cast<std::uint64_t>(in.integer_or("seed", 1, 0));
  return config;
}

MpmConfig MpmConfig::read(ConfigReader& in) {
  MpmConfig config;
  config.gel = in.read<LatticeConfig>("gel");
  if (auto material = in.optional_section("material")) {
    config.density_kg_m3 = material->optional_number("density_kg_m3", Range::positive());
    config.youngs_modulus_pa = material->optional_number("youngs_modulus_pa", Range::positive());
    config.poissons_ratio = material->optional_number("poissons_ratio", Range::between(0.0, 0.4999));
  }
  ConfigReader grid = in.section("grid");
  config.grid_spacing_m = kMillimetre * grid.number("spacing_mm", Range::positive());
  if (grid.has("origin_mm")) config.grid_origin_m = kMillimetre * grid.vector3("origin_mm");
  ConfigReader time = in.section("time");
  if (time.has("step_s")) {
    config.step_s = time.number("step_s", Range::positive());
    if (time.has("courant")) {
      time.fault("courant", "give step_s or courant, not both");
      time.ignore("courant");
    }
  } else {
    config.courant = time.number("courant", {.low = 0.0, .high = 1.0, .open_low = true});
  }
  config.damping_per_s = time.number_or("damping_per_s", 0.0, Range::non_negative());
  config.object = in.read<ObjectPointsConfig>("object");
  ConfigReader motion = in.section("motion");
  config.depth_of_gel = motion.choice("depth_of", {"gel", "object"}) == "gel";
  config.frame_within_m = read_frame_within_m(motion);
  config.check_every = motion.integer_or("check_every", 1, 1, 1000);
  config.hold_frame_s = motion.number("hold_frame_s", Range::positive());
  const std::string pixels = in.choice("pixels", {"ends", "centres", "none"});
  config.pixels_at_ends = pixels == "ends";
  config.height_maps = pixels != "none";
  if (auto check = in.optional_section("half_speed"))
    config.largest_change = check->number("largest_change", Range::positive());
  return config;
}

}  // namespace tacipc
