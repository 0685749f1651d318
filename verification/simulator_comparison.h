// Compares the markers of several simulators under the same moving object: tables, curves, arrows, and the influence of
// single parameters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "verification/marker_motion.h"

namespace tacipc::verify {

/// Names of a simulator.
struct Simulator {
  std::string name;   // name in file names
  std::string label;  // name in tables
};

/// Content of configs/studies/paper/markers/*.yaml.
struct SimulatorComparison {
  std::string title;  // title, which file names also start with
  MarkerChoice chosen;
  std::vector<std::string> motions;   // names of the motions
  std::vector<Simulator> simulators;  // compared simulators; the first is the reference for the others
  double reported_below =
      0.0;  // fraction of the first simulator's displacement below which the paper calls a result clearly shorter

  static SimulatorComparison read(ConfigReader& in);
};

/// Result folder of a press or of another simulator, or the reason why it has no motion.
struct SimulatorRun {
  std::string name;   // name of its record
  std::string stage;  // stage that made it
  std::optional<MarkerMotion> motion;
  std::string failure;                                             // reason if there is no motion
  std::vector<std::pair<std::string, std::string>> settings = {};  // path and value of each numerical setting
  std::optional<double> half_speed_change = std::nullopt;          // change of the markers at half speed

  /// Reads a folder.
  /// \throw DataError if files do not fit together
  static SimulatorRun read(const std::filesystem::path& folder);
};

/// List of differing settings as "path value (value of the other)", joined by commas.
std::string differing_settings(const SimulatorRun& run, const SimulatorRun& from);
/// Run of the same stage with the fewest differing settings; null if there is none.
const SimulatorRun* nearest_run(const SimulatorRun& run, const std::vector<const SimulatorRun*>& others);

/// All data of the page.
struct ComparedRuns {
  SimulatorComparison config;
  std::vector<SimulatorRun> runs;     // run of each simulator and motion; index at(simulator, motion)
  std::vector<SimulatorRun> factors;  // runs of the first motion with one changed parameter

  const SimulatorRun& at(std::size_t simulator, std::size_t motion) const {
    return runs[simulator * config.motions.size() + motion];
  }
};

/// The page: for each motion a table, a sentence, the curves and the arrows of every simulator; then the influence of
/// single parameters. Pictures are linked as `<pictures>/<title>_<motion>_….svg`.
std::string comparison_page(const ComparedRuns& all, const std::string& pictures);
/// Plot of the mean displacement over the object's travel, for all simulators of a motion and for markers that stick to
/// the object.
std::string comparison_curve_svg(const ComparedRuns& all, std::size_t motion);
/// CSV with a line per simulator and frame from the end of the press, columns simulator,frame,way,mean_displacement_um.
std::string comparison_curve_csv(const ComparedRuns& all, std::size_t motion);

}  // namespace tacipc::verify
