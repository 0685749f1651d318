#include "stages/gel/press/grasp_spec.h"

#include <numbers>

namespace tacipc {

GraspPhase GraspPhase::read(ConfigReader& in) {
  GraspPhase phase;
  const std::string kind = in.choice("kind", {"approach", "close", "lift", "hold", "shake", "turn", "release"});
  for (std::size_t k = 0; k < kPhaseNames.size(); ++k) {
    if (kind == kPhaseNames[k]) phase.kind = static_cast<PhaseKind>(k);
  }
  if (phase.kind == PhaseKind::approach) phase.gap_m = 1e-3 * in.number("gap_mm", Range::positive());
  if (phase.kind == PhaseKind::close && in.has("width_mm")) {
    phase.width_m = 1e-3 * in.number("width_mm", Range::positive());
    if (in.has("force_n")) in.fault("force_n", "give force_n or width_mm, not both");
  } else if (phase.kind == PhaseKind::close) {
    phase.force_n = in.number("force_n", Range::positive());
  }
  if (phase.kind == PhaseKind::lift || phase.kind == PhaseKind::release)
    phase.distance_m = 1e-3 * in.number("distance_mm", Range::positive());
  if (phase.kind == PhaseKind::shake) {
    phase.amplitude_m = 1e-3 * in.number("amplitude_mm", Range::positive());
    phase.frequency_hz = in.number("frequency_hz", Range::positive());
    phase.axis = in.choice_or("axis", "z", {"y", "z"}) == "y" ? 1 : 2;
  }
  if (phase.kind == PhaseKind::turn) {
    phase.angle_rad = in.number("turn_deg", kAnyTurn) * std::numbers::pi / 180.0;
    phase.axis = in.choice("axis", {"x", "y", "z"})[0] - 'x';
  }
  phase.steps = in.integer("steps", 1, 100000);
  phase.substeps = in.integer_or("substeps", 1, 1, 1000);
  return phase;
}

GraspSpec GraspSpec::read(ConfigReader& in) {
  GraspSpec spec;
  ConfigReader fingers = in.section("fingers");
  spec.turn_rad = fingers.number_or("turn_deg", 0.0, kAnyTurn) * std::numbers::pi / 180.0;
  const auto grip_mm = fingers.numbers_or("grip_mm", {0.0, 0.0, 0.0});
  spec.grip_m = 1e-3 * Vector3(grip_mm[0], grip_mm[1], grip_mm[2]);
  const auto gravity = fingers.numbers_or("gravity_m_s2", {0.0, 0.0, -9.81});
  spec.gravity_m_s2 = {gravity[0], gravity[1], gravity[2]};
  spec.closing_speed_m_s = 1e-3 * fingers.number_or("closing_speed_mm_s", 20.0, Range::positive());
  if (fingers.has("start_gap_mm")) spec.start_gap_m = 1e-3 * fingers.number("start_gap_mm", Range::positive());
  ConfigReader object = in.section("object");
  if (object.has("mass_g")) {
    if (object.has("density_kg_m3")) object.fault("density_kg_m3", "give mass_g or density_kg_m3, not both");
    spec.mass_kg = 1e-3 * object.number("mass_g", Range::positive());
  } else {
    spec.density_kg_m3 = object.number("density_kg_m3", Range::positive());
  }
  bool closed = false;
  for (ConfigReader& phase : in.one_or_more_sections("motion")) {
    spec.motion.push_back(GraspPhase::read(phase));
    const PhaseKind kind = spec.motion.back().kind;
    if (!closed && kind != PhaseKind::close && kind != PhaseKind::approach)
      phase.fault("kind", "fingers close first: nothing is held before");
    if (closed && kind == PhaseKind::approach) phase.fault("kind", "fingers approach before they first close");
    closed = closed || kind == PhaseKind::close;
  }
  if (!closed) in.fault("motion", "fingers never close");
  return spec;
}

}  // namespace tacipc
