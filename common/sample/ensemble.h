// Ensembles: sensors that explain the same measurements equally well, each a list of changes to one sensor file; and
// the part of an ensemble that a dataset uses. The only unit that reads or writes these files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// One sensor of an ensemble: a draw from the distribution of its parameters given the measurements.
struct EnsembleMember {
  std::string name = {};
  std::vector<std::pair<std::string, std::string>> set = {};  // keys of the sensor file and their values as YAML
};

/// A sensor file and the members that change it.
struct Ensemble {
  std::string title = {};
  std::filesystem::path sensor = {};  // sensor file that the members change, relative to the working directory
  std::vector<EnsembleMember> members = {};

  /// Reads a file `title`, `sensor` (relative to the file), `members: [{name, set: {key: value, …}}, …]`.
  /// \throw ConfigError if there are fewer than two members, or a name repeats, cannot name a folder, or is kNominal
  static Ensemble read(ConfigReader& in);
  /// Returns the text of such a file in this folder.
  std::string yaml(const std::filesystem::path& folder) const;
};

/// Returns the text of a member's sensor file.
/// \throw ConfigError, with the member as name of the file, if the sensor has no such key or its values are not allowed
std::string sensor_of(const Ensemble& ensemble, const EnsembleMember& member);

/// Name of the unchanged sensor in the members' gel mesh, pressed in addition to the members.
inline constexpr const char* kNominal = "nominal";

/// File `ensemble.yaml` of a dataset, written by `plan`: the sensor whose samples members of an ensemble also press,
/// and the members.
struct DatasetEnsemble {
  std::string title = {};
  std::string sensor = {};                // name of the sensor in the plan
  std::string mesh = {};                  // name of the members' gel mesh; empty: the sample's mesh
  std::vector<std::string> members = {};  // names of the members, without kNominal

  /// Reads the file.
  static DatasetEnsemble read(ConfigReader& in);
  /// Returns the text of the file.
  std::string yaml() const;
  /// Returns the names of all additional press runs of a sample: the members, and kNominal if the members have a mesh.
  std::vector<std::string> presses() const;
};

/// Reads the ensemble of a dataset.
/// \return nothing if the dataset has none
std::optional<DatasetEnsemble> ensemble_of_dataset(const std::filesystem::path& dataset);

inline constexpr const char* kEnsembleFile = "ensemble.yaml";
/// Returns the folder of all members' press runs of a sample, or of one member's.
std::filesystem::path member_presses(const std::filesystem::path& sample_folder);
std::filesystem::path member_press(const std::filesystem::path& sample_folder, const std::string& member);

}  // namespace tacipc
