// Records the source files of a dataset, so that a different file under the same name is noticed regardless of its age.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/dataset/plan/dataset_config.h"

namespace tacipc {

/// One source file and its role.
struct ChosenFile {
  std::string role;  // role such as sensor or mesh; unique in a choice
  std::filesystem::path file;
};

/// Source files of one result: gel-<gel>, object-<object>, motion-<motion> (press) or render-<gel>. Gels of an
/// ensemble's members are among the first kind.
struct Choice {
  std::string name;
  std::vector<ChosenFile> files;
};

/// All choices of a dataset. render-<gel> begins with the settings of render; photographs and the sensors of variants
/// follow.
/// \param sensors sensors of the configuration, already read
/// \throw DataError, ConfigError if a sensor that a variant of render names cannot be read
std::vector<Choice> choices_of(const DatasetConfig& config, const std::vector<Sensor>& sensors);

/// Writes each choice into `folder` if its text changed: a line `role hash path` per file. The time of such a file is a
/// prerequisite of the results, so it must be newer than the last result exactly if contents differ.
/// - The same file with other contents: the time of the change (ctime), because later results used the new contents.
/// - Another file was chosen: now.
/// - Only the path differs, as in a copy that was moved: the previous time.
/// \throw DataError if a file cannot be read or written
void write_choices(const std::vector<Choice>& choices, const std::filesystem::path& folder);

}  // namespace tacipc
