#include "verification/stress_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/sample/placement.h"
#include "stages/gel/press/drive/checkpoint.h"

namespace tacipc::verify {
namespace {

using std::numbers::pi;

int steps_for(double way, double step) { return std::max(1, static_cast<int>(std::ceil(way / step - 1e-9))); }

/// Draws the phases of a case one by one while following the object's position.
class MotionDrawer {
 public:
  MotionDrawer(const StressConfig::Motion& ranges, Draws& draws, StressCase& stress)
      : ranges_(ranges), draws_(draws), stress_(stress), step_m_(draws.in(ranges.step_m)) {}

  void draw() {
    const double thickness_m = stress_.gel.shape.thickness_m;
    const double part = draws_.in(ranges_.depth);
    deepest_m_ = ranges_.deep * thickness_m;
    if (contact_radius_m(stress_.object.mesh, part * deepest_m_) >= thickness_m)
      deepest_m_ = ranges_.shallow * thickness_m;
    stress_.depth_m = part * deepest_m_;
    stress_.contact_radius_m = contact_radius_m(stress_.object.mesh, stress_.depth_m);
    placed_ = pose_ = place(stress_.object.mesh.positions,
                            {"-z", 0.0, stress_.sample.center_x_m, stress_.sample.center_y_m}, start_z_m());
    add({.kind = PhaseKind::press,
         .steps = steps_for(stress_.depth_m + start_z_m(), step_m_),
         .depth_m = stress_.depth_m});
    const int further = draws_.below(3);
    for (int i = 0; i < further; ++i) draw_further();
  }

 private:
  double start_z_m() const {
    const Positions& x = stress_.gel.mesh.positions;
    return stress_.press.start_gap_d_hat * stress_.press.relative_d_hat *
           (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
  }

  void draw_further() {
    const double shear_m = draws_.in(ranges_.shear_m), direction = draws_.in({0.0, 2.0 * pi});
    const double twist_rad = draws_.in(ranges_.twist_rad) * (draws_.chance(0.5) ? 1.0 : -1.0);
    const double tilt_rad = draws_.in(ranges_.tilt_rad);
    const double twist_step = draws_.in(ranges_.twist_step_rad), tilt_step = draws_.in(ranges_.tilt_step_rad);
    switch (draws_.below(4)) {
      case 0: break;
      case 1:
        add({.kind = PhaseKind::twist, .steps = steps_for(std::abs(twist_rad), twist_step), .angle_rad = twist_rad});
        return;
      case 2: {
        // Tilt until the object would exceed its depth; shear instead if no travel is left.
        Phase tilt{.kind = PhaseKind::tilt, .steps = 1, .angle_rad = tilt_rad, .direction_rad = direction};
        while (tilt.angle_rad > 0.5 * tilt_step && lowest_z_m(end_of(tilt)) < -deepest_m_) tilt.angle_rad *= 0.9;
        if (tilt.angle_rad <= 0.5 * tilt_step) break;
        tilt.steps = steps_for(tilt.angle_rad, tilt_step);
        add(tilt);
        return;
      }
      default: add({.kind = PhaseKind::release, .steps = steps_for(start_z_m() - lowest_z_m(pose_), step_m_)}); return;
    }
    add({.kind = PhaseKind::shear,
         .steps = steps_for(shear_m, step_m_),
         .shift_m = shear_m * Vector3(std::cos(direction), std::sin(direction), 0.0)});
  }

  double lowest_z_m(const Matrix4& pose) const {
    return transformed(pose, stress_.object.mesh.positions).col(2).minCoeff();
  }

  Matrix4 end_of(const Phase& phase) const {
    const Vector3 reference(stress_.sample.center_x_m, stress_.sample.center_y_m, start_z_m());
    const PhaseStart start{
        .gel_from_object = pose_,
        .placed = placed_,
        .reference_m = placed_.topLeftCorner<3, 3>().transpose() * (reference - placed_.topRightCorner<3, 1>()),
        .lowest_z_m = lowest_z_m(pose_),
        .start_z_m = start_z_m()};
    return goal_of(phase, time_steps(phase), start, stress_.press.time_step_s).gel_from_object;
  }

  void add(const Phase& phase) {
    pose_ = end_of(phase);
    stress_.sample.motion.push_back(phase);
  }

  const StressConfig::Motion& ranges_;
  Draws& draws_;
  StressCase& stress_;
  double step_m_, deepest_m_ = 0.0;
  Matrix4 placed_, pose_;
};

/// Phases close, lift, shake, and sometimes release.
GraspSpec draw_grasp(const StressConfig::Grasp& ranges, double size_m, Draws& draws) {
  GraspSpec grasp;
  grasp.mass_kg = draws.log(ranges.mass_kg);
  grasp.turn_rad = draws.in({0.0, 2.0 * pi});
  for (int c = 1; c < 3; ++c) grasp.grip_m[c] = ranges.off_center * size_m * draws.in({-1.0, 1.0});
  grasp.motion = {{.kind = PhaseKind::close, .steps = 3 + draws.below(6), .force_n = draws.log(ranges.force_n)},
                  {.kind = PhaseKind::lift, .steps = 4 + draws.below(5), .distance_m = draws.in(ranges.lift_m)},
                  {.kind = PhaseKind::shake,
                   .steps = 8,
                   .substeps = 2,
                   .amplitude_m = draws.in(ranges.shake_m),
                   .frequency_hz = draws.in(ranges.shake_hz),
                   .axis = 1 + draws.below(2)}};
  if (draws.chance(ranges.release_share))
    grasp.motion.push_back({.kind = PhaseKind::release, .steps = 4, .distance_m = draws.in(ranges.lift_m)});
  return grasp;
}

/// Counts the frames of a grasp.
class Count final : public FrameStore {
 public:
  explicit Count(StressResult& result) : result_(result) {}
  void save(const std::string&) override { result_.frames = saved_++; }
  std::optional<std::string> load() override { return std::nullopt; }

 private:
  StressResult& result_;
  int saved_ = 0;
};

/// Number of time steps per frame for each phase.
template <typename Phases>
std::vector<int> substeps_of(const Phases& phases) {
  std::vector<int> substeps;
  for (const auto& phase : phases) substeps.push_back(phase.substeps);
  return substeps;
}

/// Sums over frames as they are judged; stores none.
class Tally final : public FrameStore {
 public:
  Tally(StressResult& result, std::vector<int> substeps) : result_(result), substeps_(std::move(substeps)) {}

  void save(const std::string& bytes) override {
    Frame frame;
    PressProgress progress;
    unpack_frame(bytes, frame, progress);
    add(frame);
  }
  std::optional<std::string> load() override { return std::nullopt; }

  void add(const Frame& frame) {
    if (!result_.totals)
      result_.totals.emplace();
    else
      ++result_.frames;
    StressTotals& totals = *result_.totals;
    if (frame.min_gap_m)
      totals.min_distance_m = std::min(totals.min_distance_m.value_or(*frame.min_gap_m), *frame.min_gap_m);
    totals.min_volume_ratio = std::min(totals.min_volume_ratio, frame.min_volume_ratio);
    totals.press_force_n = std::max(totals.press_force_n, -frame.force_n.z());
    totals.time_steps += frame.solver.time_steps;
    if (frame.phase_index >= 0) totals.planned_steps += substeps_.at(static_cast<std::size_t>(frame.phase_index));
    totals.newton_iterations += frame.solver.newton_iterations;
    totals.moving_iterations += frame.solver.moving_iterations;
    totals.lag_iterations += frame.solver.lag_iterations;
  }

 private:
  StressResult& result_;
  std::vector<int> substeps_;  // time steps per frame of each phase
};

constexpr StressOutcome kOutcomes[] = {StressOutcome::converged, StressOutcome::not_converged,
                                       StressOutcome::intersected, StressOutcome::inverted};

StressOutcome outcome_of(const Miss& miss) {
  if (miss.check == "intersections" || miss.check == "smallest_distance") return StressOutcome::intersected;
  if (miss.check == "inverted_tets" || miss.check == "volume_ratio") return StressOutcome::inverted;
  return StressOutcome::not_converged;
}

}  // namespace

const char* name_of(StressOutcome outcome) {
  static const char* const kNames[] = {"converged", "not_converged", "intersected", "inverted"};
  return kNames[static_cast<int>(outcome)];
}

StressCase draw_case(const StressConfig& config, std::uint64_t seed, std::uint64_t index) {
  Draws draws(seed, index);
  StressCase stress;
  stress.gel = draw_gel(config.gel, config.object.exact_share, draws);
  const GelShape& shape = stress.gel.shape;
  stress.sensor.name = "stress";
  stress.sensor.gel = shape;
  stress.sensor.material.law = draws.chance(config.material.stvk_hencky_share) ? "stvk_hencky" : "neo_hookean";
  stress.sensor.material.density_kg_m3 = config.material.density_kg_m3;
  stress.sensor.material.youngs_modulus_pa = draws.log(config.material.youngs_modulus_pa);
  stress.sensor.material.poissons_ratio = draws.in(config.material.poissons_ratio);
  stress.object = draw_object(config.object, stress.gel.front_edge_m, draws);

  // The lowest point comes to lie within a fraction of the half width. Placement refers to the bounding box.
  const Positions& x = stress.object.mesh.positions;
  const double reach = config.object.place * 0.5 * std::min(shape.width_m, shape.height_m);
  const double radius = reach * std::sqrt(draws.unit()), angle = draws.in({0.0, 2.0 * pi});
  Eigen::Vector2d at = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  if (draws.chance(config.object.exact_share)) at.setZero();
  Eigen::Index lowest = 0;
  x.col(2).minCoeff(&lowest);
  const Eigen::Vector2d middle =
      0.5 * (x.leftCols<2>().colwise().minCoeff() + x.leftCols<2>().colwise().maxCoeff()).transpose();
  const Eigen::Vector2d center = at + middle - x.row(lowest).head<2>().transpose();
  stress.sample.may_miss = true;
  stress.sample.center_x_m = center.x();
  stress.sample.center_y_m = center.y();

  stress.press = config.press;
  const bool frictionless = draws.chance(config.friction.none_share),
             iterated = draws.chance(config.friction.iterated_share);
  const double coefficient = draws.in(config.friction.coefficient);
  if (!frictionless) {
    ConfigReader numerics =
        ConfigReader::from_text(iterated ? "coefficient: 0\nlag: iterated\n" : "coefficient: 0\n", "friction");
    stress.press.friction = FrictionConfig::read(numerics);
    stress.press.friction->coefficient = coefficient;
  }
  if (config.grasp) {
    stress.grasp = draw_grasp(*config.grasp, stress.object.size_m, draws);
  } else {
    MotionDrawer(config.motion, draws, stress).draw();
  }
  stress.press.pair_counting.once = draws.chance(config.pairs_once_share);
  return stress;
}

Value StressCase::description() const {
  constexpr double kDegrees = 180.0 / pi;
  Value::Map out{{"gel", gel.shape.outline == GelShape::Outline::disc ? "disc" : "rectangle"},
                 {"gel_vertices", static_cast<std::int64_t>(gel.mesh.num_vertices())},
                 {"thickness_mm", 1e3 * gel.shape.thickness_m},
                 {"front_edge_mm", 1e3 * gel.front_edge_m},
                 {"law", sensor.material.law},
                 {"youngs_modulus_pa", sensor.material.youngs_modulus_pa},
                 {"poissons_ratio", sensor.material.poissons_ratio},
                 {"object", object.kind},
                 {"object_vertices", static_cast<std::int64_t>(object.mesh.num_vertices())},
                 {"size_mm", 1e3 * object.size_m},
                 {"half_angle_deg", kDegrees * object.half_angle_rad},
                 {"tilt_deg", kDegrees * object.tilt_rad},
                 {"depth_mm", 1e3 * depth_m},
                 {"contact_radius_mm", 1e3 * contact_radius_m},
                 {"friction", press.friction ? press.friction->coefficient : 0.0},
                 {"lag", !press.friction            ? "none"
                         : press.friction->iterated ? "iterated"
                                                    : "once"},
                 {"pairs", press.pair_counting.once ? "once" : "every"}};
  Value::List phases;
  if (grasp) {
    out.emplace_back("mass_g", 1e3 * *grasp->mass_kg);
    for (const GraspPhase& phase : grasp->motion) {
      Value::Map line{{"kind", name_of(phase.kind)}, {"steps", phase.steps}};
      if (phase.kind == PhaseKind::close) line.emplace_back("force_n", phase.force_n);
      phases.emplace_back(std::move(line));
    }
  }
  for (const Phase& phase : sample.motion) {
    Value::Map line{{"kind", name_of(phase.kind)}, {"steps", phase.steps}};
    if (phase.kind == PhaseKind::shear) line.emplace_back("distance_mm", 1e3 * phase.shift_m.norm());
    if (phase.angle_rad != 0.0) line.emplace_back("angle_deg", kDegrees * phase.angle_rad);
    phases.emplace_back(std::move(line));
  }
  out.emplace_back("motion", std::move(phases));
  return out;
}

Value::Map StressResult::lines() const {
  Value::Map out{{"outcome", name_of(outcome)}};
  if (outcome != StressOutcome::converged) out.emplace_back("reason", reason);
  out.emplace_back("frames_asked", frames_asked);
  out.emplace_back("frames", frames);
  if (totals) std::ranges::move(record_lines(*totals), std::back_inserter(out));
  return out;
}

StressResult StressResult::read(const Record& summary) {
  StressResult result;
  const std::string name = summary.required_text("outcome");
  const auto* outcome =
      std::ranges::find_if(kOutcomes, [&](const StressOutcome known) { return name == name_of(known); });
  if (outcome == std::end(kOutcomes)) throw DataError("summary.outcome: '{}' is no outcome of stress_case", name);
  result.outcome = *outcome;
  result.reason = summary.text("reason").value_or("");
  result.frames_asked = summary.required_count("frames_asked");
  result.frames = summary.required_count("frames");
  if (summary.has(key_of(&StressTotals::time_steps))) result.totals = RecordLines<StressTotals>(summary).all();
  return result;
}

StressResult run_stress_case(const StressCase& stress, const ProgressObserver& observe) {
  StressResult result;
  for (const Phase& phase : stress.sample.motion) result.frames_asked += phase.steps;
  if (stress.grasp) {
    for (const GraspPhase& phase : stress.grasp->motion) result.frames_asked += phase.steps;
  }
  Tally tally(result, stress.grasp ? substeps_of(stress.grasp->motion) : substeps_of(stress.sample.motion));
  Count count(result);
  try {
    if (stress.grasp) {
      const Grasp done =
          grasp(stress.sensor, stress.gel.mesh, stress.object.mesh, stress.press, *stress.grasp, observe, &count);
      for (const Simulation& finger : done.fingers) {
        for (const Frame& frame : finger.frames) tally.add(frame);
      }
      // Both fingers have the same frames, and each has the solver's numbers.
      result.frames = result.frames_asked;
      StressTotals& totals = *result.totals;
      for (int* of_both : {&totals.time_steps, &totals.planned_steps, &totals.newton_iterations,
                           &totals.moving_iterations, &totals.lag_iterations})
        *of_both /= 2;
      return result;
    }
    simulate(stress.sensor, stress.gel.mesh, stress.object.mesh, stress.press, stress.sample, "-z", observe, &tally);
  } catch (const VerdictError& error) {
    result.outcome = outcome_of(error.miss());
    result.reason = error.what();
  } catch (const SolverError& error) {
    result.outcome = StressOutcome::not_converged;
    result.reason = error.what();
  }
  return result;
}

}  // namespace tacipc::verify
