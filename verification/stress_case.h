// One case of the stress campaign: drawn from seed and index, run and judged.
#pragma once

#include <optional>
#include <string>

#include "common/stage/record_lines.h"
#include "stages/gel/press/drive/grasp.h"
#include "stages/gel/press/drive/simulate.h"
#include "verification/stress_shapes.h"

namespace tacipc::verify {

/// All inputs of a case.
struct StressCase {
  Sensor sensor;
  StressGel gel;
  StressObject object;
  PressConfig press;
  SampleSpec sample;
  std::optional<GraspSpec> grasp;  // grasp that replaces `sample`
  double depth_m = 0.0;
  double contact_radius_m = 0.0;  // contact radius of the object at that depth, m

  /// All drawn values, for the record.
  Value description() const;
};

/// Draws a case.
/// \throw DataError if its gel cannot be meshed
StressCase draw_case(const StressConfig& config, std::uint64_t seed, std::uint64_t index);

/// Outcome of a case. `intersected` and `inverted` must never occur; the exact tests of the verdict detect them.
enum class StressOutcome { converged, not_converged, intersected, inverted };
const char* name_of(StressOutcome outcome);

/// Sums and extremes over the frames that a case reached, including frame 0.
struct StressTotals {
  int time_steps = 0;
  int planned_steps = 0;  // planned time steps of these frames, each counted once even if it was divided
  int newton_iterations = 0, moving_iterations = 0, lag_iterations = 0;
  std::optional<double> min_distance_m = {};  // absent if no pair ever came near
  double min_volume_ratio = 1.0;
  double press_force_n = 0.0;  // largest press force, N

  static constexpr auto keys() {
    using Lines = StressTotals;
    return std::tuple(RECORD_KEY(time_steps), RECORD_KEY(planned_steps), RECORD_KEY(newton_iterations),
                      RECORD_KEY(moving_iterations), RECORD_KEY(lag_iterations), RECORD_KEY(min_distance_m),
                      RECORD_KEY(min_volume_ratio), RECORD_KEY(press_force_n));
  }
};

/// Result of a case, as stored in its record.
struct StressResult {
  StressOutcome outcome = StressOutcome::converged;
  std::string reason = {};                  // solver message, unless the case converged
  int frames_asked = 0;                     // requested frames, without frame 0
  int frames = 0;                           // reached frames
  std::optional<StressTotals> totals = {};  // absent for a grasp that ends early and leaves no frames

  Value::Map lines() const;
  /// Reads the summary of a record.
  /// \throw DataError naming file and key
  static StressResult read(const Record& summary);
};

/// Runs a case. An error of the solver or a failed verdict is a result, not an exception.
StressResult run_stress_case(const StressCase& stress, const ProgressObserver& observe);

}  // namespace tacipc::verify
