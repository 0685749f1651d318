// Markers of several simulators under the same dragged or turned object: tables, curves, arrows, and the influence of
// single values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "verification/marker_motion.h"

namespace tacipc::verify {

struct Simulator {
  std::string name;   // in names of files
  std::string label;  // in tables
};

/// configs/studies/paper/markers/*.yaml
struct SimulatorComparison {
  std::string title;  // and the beginning of the names of files
  MarkerChoice chosen;
  std::vector<std::string> motions;   // names
  std::vector<Simulator> simulators;  // the others are measured by the first
  double reported_below = 0.0;        // of the first one's: what the paper calls clearly shorter

  static SimulatorComparison read(ConfigReader& in);
};

/// The folder of a press or of another simulator, or why there is nothing in it.
struct SimulatorRun {
  std::string name;   // of its record
  std::string stage;  // that made it
  std::optional<MarkerMotion> motion;
  std::string failure;                                             // where there is no motion
  std::vector<std::pair<std::string, std::string>> settings = {};  // path and value of each key of its numerics
  std::optional<double> half_speed_change = std::nullopt;          // of the markers

  /// \throw DataError if files do not fit together
  static SimulatorRun read(const std::filesystem::path& folder);
};

/// "path value (value of the other)" of every setting that differs, joined by commas.
std::string differing_settings(const SimulatorRun& run, const SimulatorRun& from);
/// Of runs of the same stage the one with the fewest differing settings, else nothing.
const SimulatorRun* nearest_run(const SimulatorRun& run, const std::vector<const SimulatorRun*>& others);

/// Everything the page is made of.
struct ComparedRuns {
  SimulatorComparison config;
  std::vector<SimulatorRun> runs;     // simulators in order, each with every motion
  std::vector<SimulatorRun> factors;  // runs of the first motion with a changed value

  const SimulatorRun& at(std::size_t simulator, std::size_t motion) const {
    return runs[simulator * config.motions.size() + motion];
  }
};

/// The page: for each motion a table, a sentence, the curves and the arrows of every simulator; then the factors.
/// Pictures are linked as `<pictures>/<title>_<motion>_….svg`.
std::string comparison_page(const ComparedRuns& all, const std::string& pictures);
/// Mean displacement over the object's travel, all simulators of a motion, and what markers stuck to the object would
/// do.
std::string comparison_curve_svg(const ComparedRuns& all, std::size_t motion);
/// simulator,frame,way,mean_displacement_um: a line per simulator and frame from the end of the press.
std::string comparison_curve_csv(const ComparedRuns& all, std::size_t motion);

}  // namespace tacipc::verify
