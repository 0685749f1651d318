// Motion of markers under an object that is dragged or turned over the gel, and its evenness.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "verification/marker_motion.h"

namespace tacipc::verify {

/// Which markers are evaluated, and when their curve counts as smooth.
struct MarkerCurveConfig {
  MarkerChoice chosen;
  double settled_load = 0.0;  // of the largest friction load after the press: from here on sliding is settled
  double second_difference_limit = 0.0;  // of the largest first difference

  static MarkerCurveConfig read(ConfigReader& in);
};

/// The motion of a press folder after the press; frames count from the end of the press, entry 0.
struct SlidingRun : MarkerMotion {
  std::string verdict;
  int gel_vertices = 0;
  std::vector<double> press_force_n;     // against z
  std::vector<double> load;              // tangential force, N, or torque about the object's axis, N m
  std::vector<double> sticking;          // share of the touching front vertices that stick
  std::optional<double> gross_slip_way;  // where all touching vertices first slip
  double max_balance_relative = 0.0, min_distance_m = 0.0, min_volume_ratio = 0.0;
};

/// Reads the outputs of the press stage. \throw DataError if nothing follows the press, or files do not fit together
SlidingRun read_sliding_run(const std::filesystem::path& press);

/// The mean length of the displacement of the chosen markers and the evenness of that curve.
struct MarkerCurve {
  std::vector<double> mean_m;          // per frame from the end of the press, L_0 = 0
  double largest_first_m = 0.0;        // max |L_i − L_{i−1}| over all frames after the press
  int settled = 0;                     // first frame from which the friction load stays above its share of the largest
  double largest_second_m = 0.0;       // max |L_{i+1} − 2 L_i + L_{i−1}| with i − 1 ≥ settled
  double largest_second_ever_m = 0.0;  // the same over all frames but the first, where motion sets in
  double ratio() const { return largest_first_m > 0.0 ? largest_second_m / largest_first_m : 0.0; }
};

/// \throw DataError if none of the chosen markers is there, or fewer than three frames are settled
MarkerCurve marker_curve(const SlidingRun& run, const MarkerCurveConfig& config);

/// The page, the curve (beside it those of `others`, motions of the same kind by other simulators) with its
/// differences.
std::string marker_curve_svg(const SlidingRun& run, const MarkerCurve& curve, const std::vector<MarkerMotion>& others,
                             const MarkerCurveConfig& config);
std::string marker_difference_svg(const SlidingRun& run, const MarkerCurve& curve);
std::string marker_curve_csv(const SlidingRun& run, const MarkerCurve& curve);
/// The evenness of each run in one line.
std::string marker_curve_found(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                               const MarkerCurveConfig& config);
std::string marker_curve_page(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                              const std::vector<MarkerMotion>& others, const MarkerCurveConfig& config);

}  // namespace tacipc::verify
