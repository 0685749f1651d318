#include "common/sample/sample_spec.h"

#include <numbers>

#include "common/sample/placement.h"

namespace tacipc {

SampleSpec SampleSpec::read(ConfigReader& in) {
  SampleSpec spec;
  if (auto placement = in.optional_section("placement")) {
    if (placement->has("face")) spec.face = placement->choice("face", face_names());
    spec.rotate_rad = placement->number_or("rotate_deg", 0.0, kAnyTurn) * std::numbers::pi / 180.0;
    const auto center_mm = placement->numbers_or("center_mm", {0.0, 0.0});
    spec.center_x_m = 1e-3 * center_mm[0];
    spec.center_y_m = 1e-3 * center_mm[1];
    spec.may_miss = placement->flag_or("may_miss", false);
  }
  if (auto object = in.optional_section("object"))
    spec.density_kg_m3 = object->number("density_kg_m3", Range::positive());
  for (ConfigReader& phase : in.one_or_more_sections("motion")) {
    spec.motion.push_back(Phase::read(phase));
    if (!spec.motion.back().load_n || spec.density_kg_m3) continue;
    if (spec.motion.back().kind == PhaseKind::free)
      phase.fault("kind", "the object is free only if its object.density_kg_m3 is given");
    else
      phase.fault("force_n", "a force moves the object only if its object.density_kg_m3 is given");
  }
  return spec;
}

PhaseStart phase_start(const SampleSpec& sample, const Positions& object_positions, const Matrix4& placed,
                       const Matrix4& gel_from_object, double start_z_m) {
  const Vector3 reference(sample.center_x_m, sample.center_y_m, start_z_m);
  return {.gel_from_object = gel_from_object,
          .placed = placed,
          .reference_m = placed.topLeftCorner<3, 3>().transpose() * (reference - placed.topRightCorner<3, 1>()),
          .lowest_z_m = transformed(gel_from_object, object_positions).col(2).minCoeff(),
          .start_z_m = start_z_m};
}

std::optional<std::size_t> press_end_frame(const SampleSpec& sample, const std::vector<int>& phase_of_frame) {
  std::optional<std::size_t> end;
  for (std::size_t f = 1; f < phase_of_frame.size(); ++f) {
    if (sample.motion[static_cast<std::size_t>(phase_of_frame[f])].kind != PhaseKind::press) {
      if (end) break;
      continue;
    }
    if (end && phase_of_frame[*end] != phase_of_frame[f]) break;
    end = f;
  }
  return end;
}

}  // namespace tacipc
