// One case of the stress campaign: drawn from seed and index, run and judged.
#pragma once

#include <optional>
#include <string>

#include "common/stage/record_lines.h"
#include "stages/gel/press/drive/grasp.h"
#include "stages/gel/press/drive/simulate.h"
#include "verification/stress_shapes.h"

namespace tacipc::verify {

struct StressCase {
  Sensor sensor;
  StressGel gel;
  StressObject object;
  PressConfig press;
  SampleSpec sample;
  std::optional<GraspSpec> grasp;  // instead of that
  double depth_m = 0.0;
  double contact_radius_m = 0.0;  // of the object at that depth

  /// What was drawn, for the record.
  Value description() const;
};

/// \throw DataError where a gel cannot be meshed
StressCase draw_case(const StressConfig& config, std::uint64_t seed, std::uint64_t index);

/// How a case ended. `intersected` and `inverted` are what must never happen, by the exact tests of the verdict.
enum class StressOutcome { converged, not_converged, intersected, inverted };
const char* name_of(StressOutcome outcome);

/// Sums and extremes over the frames that a case has reached, frame 0 included.
struct StressTotals {
  int time_steps = 0;
  int planned_steps = 0;  // time steps of the motion up to there, each counted once however often it was divided
  int newton_iterations = 0, moving_iterations = 0, lag_iterations = 0;
  std::optional<double> min_distance_m = {};  // absent where nothing was ever near
  double min_volume_ratio = 1.0;
  double press_force_n = 0.0;  // largest

  static constexpr auto keys() {
    using Lines = StressTotals;
    return std::tuple(RECORD_KEY(time_steps), RECORD_KEY(planned_steps), RECORD_KEY(newton_iterations),
                      RECORD_KEY(moving_iterations), RECORD_KEY(lag_iterations), RECORD_KEY(min_distance_m),
                      RECORD_KEY(min_volume_ratio), RECORD_KEY(press_force_n));
  }
};

struct StressResult {
  StressOutcome outcome = StressOutcome::converged;
  std::string reason = {};                  // the solver's words, unless it converged
  int frames_asked = 0;                     // beyond frame 0
  int frames = 0;                           // that were reached
  std::optional<StressTotals> totals = {};  // a grasp that ends early leaves no frames to sum up

  Value::Map lines() const;
  /// \throw DataError naming file and key
  static StressResult read(const Record& summary);
};

/// Runs a case. What the solver or the verdict refuse is a result.
StressResult run_stress_case(const StressCase& stress, const ProgressObserver& observe);

}  // namespace tacipc::verify
