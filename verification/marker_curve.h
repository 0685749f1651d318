// Marker displacement under an object that is moved sideways or turned on the gel, and the smoothness of that curve.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "verification/marker_motion.h"

namespace tacipc::verify {

/// Selects the evaluated markers, and defines when their curve counts as smooth.
struct MarkerCurveConfig {
  MarkerChoice chosen;
  double settled_load = 0.0;  // fraction of the largest friction load after the press; sliding counts as settled from
                              // the frame that reaches it
  double second_difference_limit =
      0.0;  // limit of the second differences, as a fraction of the largest first difference

  static MarkerCurveConfig read(ConfigReader& in);
};

/// Motion of a press folder after the press. Entry 0 is the end of the press.
struct SlidingRun : MarkerMotion {
  std::string verdict;
  int gel_vertices = 0;
  std::vector<double> press_force_n;     // press force, N, positive against z
  std::vector<double> load;              // tangential force, N, or torque about the object's axis, N m
  std::vector<double> sticking;          // fraction of the touching front vertices that stick
  std::optional<double> gross_slip_way;  // travel at which all touching vertices first slip, m or rad
  double max_balance_relative = 0.0, min_distance_m = 0.0, min_volume_ratio = 0.0;
};

/// Reads the outputs of the press stage.
/// \throw DataError if nothing follows the press, or files do not fit together
SlidingRun read_sliding_run(const std::filesystem::path& press);

/// Mean displacement length of the chosen markers, and the smoothness of that curve.
struct MarkerCurve {
  std::vector<double> mean_m;    // per frame from the end of the press, L_0 = 0
  double largest_first_m = 0.0;  // max |L_i − L_{i−1}| over all frames after the press, m
  int settled = 0;  // first frame from which the friction load stays above `settled_load` times its largest value
  double largest_second_m = 0.0;  // max |L_{i+1} − 2 L_i + L_{i−1}| with i − 1 ≥ settled, m
  double largest_second_ever_m =
      0.0;  // max |L_{i+1} − 2 L_i + L_{i−1}| over all frames but the first, where motion sets in, m
  double ratio() const { return largest_first_m > 0.0 ? largest_second_m / largest_first_m : 0.0; }
};

/// Computes the curve.
/// \throw DataError if no chosen marker exists, or fewer than three frames are settled
MarkerCurve marker_curve(const SlidingRun& run, const MarkerCurveConfig& config);

/// Parts of the results page: the curve, its differences, the table and the text. The plot of the curve also shows
/// `others`, motions of the same kind by other simulators.
std::string marker_curve_svg(const SlidingRun& run, const MarkerCurve& curve, const std::vector<MarkerMotion>& others,
                             const MarkerCurveConfig& config);
std::string marker_difference_svg(const SlidingRun& run, const MarkerCurve& curve);
std::string marker_curve_csv(const SlidingRun& run, const MarkerCurve& curve);
/// Smoothness of each run, as one line of text.
std::string marker_curve_found(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                               const MarkerCurveConfig& config);
std::string marker_curve_page(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                              const std::vector<MarkerMotion>& others, const MarkerCurveConfig& config);

}  // namespace tacipc::verify
