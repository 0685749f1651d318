#include "verification/stress_config.h"

#include <cmath>

#include "common/base/rng.h"
#include "common/base/units.h"

namespace tacipc::verify {
namespace {

const Range kShare = Range::between(0.0, 1.0);

}  // namespace

const std::vector<std::string>& stress_kinds() {
  static const std::vector<std::string> kinds{"cone", "pyramid", "wedge", "box", "sphere", "cylinder", "blob", "torus"};
  return kinds;
}

Span Span::read(ConfigReader& in, const std::string& key, const Range& range, double unit) {
  const auto ends = in.numbers(key, 2, range);
  if (ends[0] > ends[1]) in.fault(key, "the first number must not exceed the second");
  return {unit * ends[0], unit * ends[1]};
}

double Draws::unit() { return random_uniform(seed_, index_, counter_++); }
double Draws::in(const Span& span) { return span.low + (span.high - span.low) * unit(); }
double Draws::log(const Span& span) { return span.low * std::pow(span.high / span.low, unit()); }
int Draws::below(int count) { return std::min(count - 1, static_cast<int>(count * unit())); }

StressConfig StressConfig::read(ConfigReader& in) {
  StressConfig config;
  ConfigReader gel = in.section("gel");
  config.gel = {.disc_share = gel.number("disc_share", kShare),
                .thickness_m = Span::read(gel, "thickness_mm", Range::positive(), kMillimetre),
                .width_thicknesses = Span::read(gel, "width_thicknesses", Range::between(2.0, 100.0)),
                .vertices = Span::read(gel, "vertices", Range::between(200.0, 20000.0)),
                .growth = Span::read(gel, "growth", Range::between(1.0, 2.0)),
                .jitter = Span::read(gel, "jitter", Range::between(0.0, 0.5))};
  ConfigReader material = in.section("material");
  config.material = {.stvk_hencky_share = material.number("stvk_hencky_share", kShare),
                     .density_kg_m3 = material.number("density_kg_m3", Range::positive()),
                     .youngs_modulus_pa = Span::read(material, "youngs_modulus_pa", Range::positive()),
                     .poissons_ratio = Span::read(material, "poissons_ratio", Range::between(0.0, 0.4999))};
  ConfigReader object = in.section("object");
  for (const auto& kind : stress_kinds()) {
    if (object.flag_or(kind, true)) config.object.kinds.push_back(kind);
  }
  if (config.object.kinds.empty()) object.fault(stress_kinds().front(), "leave at least one kind of object");
  config.object.size_m = Span::read(object, "size_mm", Range::positive(), kMillimetre);
  config.object.half_angle_rad = Span::read(object, "half_angle_deg", Range::between(1.0, 80.0), kDegree);
  config.object.edges_over_gel = Span::read(object, "edges_over_gel", Range::positive());
  config.object.tilt_rad = kDegree * object.number("tilt_deg", Range::between(0.0, 89.0));
  config.object.place = object.number("place", kShare);
  config.object.exact_share = object.number("exact_share", kShare);
  config.object.max_vertices = object.integer("max_vertices", 100);
  if (auto grasp = in.optional_section("grasp")) {
    config.grasp = Grasp{.mass_kg = Span::read(*grasp, "mass_g", Range::positive(), 1e-3),
                         .force_n = Span::read(*grasp, "force_n", Range::positive()),
                         .lift_m = Span::read(*grasp, "lift_mm", Range::positive(), kMillimetre),
                         .shake_m = Span::read(*grasp, "shake_mm", Range::positive(), kMillimetre),
                         .shake_hz = Span::read(*grasp, "shake_hz", Range::positive()),
                         .off_center = grasp->number("off_center", kShare),
                         .release_share = grasp->number("release_share", kShare)};
  } else {
    ConfigReader motion = in.section("motion");
    config.motion = {
        .step_m = Span::read(motion, "step_mm", Range::positive(), kMillimetre),
        .depth = Span::read(motion, "depth", {.low = 0.0, .high = 1.0, .open_low = true}),
        .shear_m = Span::read(motion, "shear_mm", Range::positive(), kMillimetre),
        .twist_rad = Span::read(motion, "twist_deg", {.low = 0.0, .high = 180.0, .open_low = true}, kDegree),
        .tilt_rad = Span::read(motion, "tilt_deg", {.low = 0.0, .high = 80.0, .open_low = true}, kDegree),
        .deep = motion.number("deep", Range::between(0.01, 0.95)),
        .shallow = motion.number("shallow", Range::between(0.01, 0.95)),
        .twist_step_rad = Span::read(motion, "twist_step_deg", Range::positive(), kDegree),
        .tilt_step_rad = Span::read(motion, "tilt_step_deg", Range::positive(), kDegree)};
  }
  ConfigReader friction = in.section("friction");
  config.friction = {.none_share = friction.number("none_share", kShare),
                     .iterated_share = friction.number("iterated_share", kShare),
                     .coefficient = Span::read(friction, "coefficient", Range::between(0.0, 10.0))};
  ConfigReader press = in.section("press");
  config.press = PressConfig::read(press);
  if (press.has("friction")) press.fault("friction", "is drawn for each case, from the section friction");
  config.pairs_once_share = in.number("pairs_once_share", kShare);
  return config;
}

}  // namespace tacipc::verify
