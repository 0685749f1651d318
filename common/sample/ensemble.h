// What measurements leave open about a sensor: sensors that explain them alike, each a list of changes of one sensor
// file. Also what a dataset takes of that. The only place that knows these files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// One draw from what is known of a sensor.
struct EnsembleMember {
  std::string name = {};
  std::vector<std::pair<std::string, std::string>> set = {};  // key of the sensor file, its value as YAML
};

struct Ensemble {
  std::string title = {};
  std::filesystem::path sensor = {};  // that the members change, as seen from where the program runs
  std::vector<EnsembleMember> members = {};

  /// A file `title`, `sensor` (relative to it), `members: [{name, set: {key: value, …}}, …]`, at least two of different
  /// names that are names of folders, other than kNominal.
  static Ensemble read(ConfigReader& in);
  /// The text of such a file in this folder.
  std::string yaml(const std::filesystem::path& folder) const;
};

/// The text of a member's sensor file. \throw ConfigError, with the ensemble's member as the name of the file, if the
/// sensor has no such key or the values make no sensor
std::string sensor_of(const Ensemble& ensemble, const EnsembleMember& member);

/// Beside the members, the sensor itself in the gel mesh of these.
inline constexpr const char* kNominal = "nominal";

/// `ensemble.yaml` in the folder of a dataset: whose samples are pressed by members, too, and by which. Written by
/// `plan`.
struct DatasetEnsemble {
  std::string title = {};
  std::string sensor = {};                // name of the sensor in the plan
  std::string mesh = {};                  // name of the members' mesh; empty: that of the sample
  std::vector<std::string> members = {};  // kNominal is one more where there is a mesh

  static DatasetEnsemble read(ConfigReader& in);
  std::string yaml() const;
  /// Names of everything that is pressed beside a sample.
  std::vector<std::string> presses() const;
};

/// That of a dataset, if it has one.
std::optional<DatasetEnsemble> ensemble_of_dataset(const std::filesystem::path& dataset);

inline constexpr const char* kEnsembleFile = "ensemble.yaml";
/// Where presses of members of a sample are, and that of one.
std::filesystem::path member_presses(const std::filesystem::path& sample_folder);
std::filesystem::path member_press(const std::filesystem::path& sample_folder, const std::string& member);

}  // namespace tacipc
