#include "stages/gel/press/drive/grasp_spec.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "common/base/error.h"
#include "common/sample/body_keys.h"

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
  if (auto draw = fingers.optional_section("draw")) {
    spec.draw = GraspDraw::read(*draw);
    for (const char* key : {"rotation_xyzw", "turn_deg", "grip_mm"})
      if (fingers.has(key)) fingers.fault(key, "is drawn: give it or draw, not both"), fingers.ignore(key);
  } else {
    spec.rotation = read_rotation(fingers);
    spec.turn_rad = fingers.number_or("turn_deg", 0.0, kAnyTurn) * std::numbers::pi / 180.0;
    spec.grip_m = read_triple(fingers, "grip_mm", 1e-3);
  }
  const auto gravity = fingers.numbers_or("gravity_m_s2", {0.0, 0.0, -9.81});
  spec.gravity_m_s2 = {gravity[0], gravity[1], gravity[2]};
  spec.closing_speed_m_s = 1e-3 * fingers.number_or("closing_speed_mm_s", 20.0, Range::positive());
  if (fingers.has("start_gap_mm")) spec.start_gap_m = 1e-3 * fingers.number("start_gap_mm", Range::positive());
  if (auto mount = fingers.optional_section("mount")) {
    spec.mount.mass_kg = 1e-3 * mount->number_or("mass_g", 0.0, Range::non_negative());
    spec.mount.damping_n_s_m = mount->number_or("damping_n_s_m", 0.0, Range::non_negative());
  }
  spec.drive_each = fingers.choice_or("drive", "one", {"one", "each"}) == "each";
  ConfigReader object = in.section("object");
  const auto only = [&](const char* key, std::initializer_list<const char*> others) {
    for (const char* other : others)
      if (object.has(other)) object.fault(other, fmt::format("give {} or {}, not both", key, other));
  };
  if (object.has("mass_g")) {
    only("mass_g", {"density_kg_m3", "friction_margin"});
    spec.mass_kg = 1e-3 * object.number("mass_g", Range::positive());
  } else if (object.has("friction_margin")) {
    only("friction_margin", {"density_kg_m3"});
    spec.friction_margin = object.number("friction_margin", Range::positive());
    if (spec.gravity_m_s2.isZero()) object.fault("friction_margin", "nothing has weight without gravity_m_s2");
  } else {
    spec.density_kg_m3 = object.number("density_kg_m3", Range::positive());
  }
  if (object.has("friction")) spec.friction_coefficient = object.number("friction", FrictionConfig::coefficients());
  spec.center_shift_m = read_triple(object, "center_of_mass_shift_mm", 1e-3);
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

PressConfig GraspSpec::pressed_with(const PressConfig& config) const {
  if (!friction_coefficient) return config;
  if (!config.friction)
    throw UsageError("object.friction: the press file has no friction section, which says how slow counts as sticking");
  PressConfig with = config;
  with.friction->coefficient = *friction_coefficient;
  return with;
}

MassProperties GraspSpec::mass_of(const TriangleMesh& object) const {
  MassProperties mass = mass_properties(object.positions, object.triangles);
  mass.center_m += center_shift_m;
  const Eigen::AlignedBox3d box(object.positions.colwise().minCoeff().transpose(),
                                object.positions.colwise().maxCoeff().transpose());
  if (!box.contains(mass.center_m)) {
    const Vector3 at = 1e3 * mass.center_m, low = 1e3 * box.min(), high = 1e3 * box.max();
    throw DataError(
        "object.center_of_mass_shift_mm: the centre of mass would be at ({:.3g}, {:.3g}, {:.3g}) mm, outside of the "
        "object, which reaches from ({:.3g}, {:.3g}, {:.3g}) to ({:.3g}, {:.3g}, {:.3g}) mm",
        at.x(), at.y(), at.z(), low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
  }
  return mass;
}

GraspPose GraspSpec::pose_of(const TriangleMesh& object, const MassProperties& mass, const GelShape& front,
                             double friction) const {
  if (draw) return draw_grasp(object, mass.center_m, front, friction, *draw);
  const Matrix3 turn = Eigen::AngleAxisd(turn_rad, Vector3::UnitZ()).toRotationMatrix();
  return {.world_from_object = turn * rotation.toRotationMatrix(),
          .grip_m = grip_m - center_shift_m,
          .width_m = std::nullopt,
          .patch_m = std::nullopt};
}

double GraspSpec::density_of(double volume_m3, double friction) const {
  if (mass_kg) return *mass_kg / volume_m3;
  if (!friction_margin) return density_kg_m3;
  if (friction == 0.0) throw UsageError("object.friction_margin: the press file has no friction");
  const auto close = std::find_if(motion.begin(), motion.end(),
                                  [](const GraspPhase& phase) { return phase.kind == PhaseKind::close; });
  if (!(close->force_n > 0.0))
    throw UsageError("object.friction_margin: the first `close` of the motion has no force_n to take it from");
  return 2.0 * friction * close->force_n / (*friction_margin * gravity_m_s2.norm()) / volume_m3;
}

}  // namespace tacipc
