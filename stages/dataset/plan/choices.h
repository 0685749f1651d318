// The files a dataset is made of, so that a different file under the same name is noticed whatever its age.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/dataset/plan/dataset_config.h"

namespace tacipc {

struct ChosenFile {
  std::string role;  // such as sensor, mesh; given once in a choice
  std::filesystem::path file;
};

/// Files that something is made of: gel-<gel>, object-<object>, motion-<motion> (press), render-<gel>; gels of an
/// ensemble's members are some of the first.
struct Choice {
  std::string name;
  std::vector<ChosenFile> files;
};

/// All choices of a dataset. `sensors` are those of its configuration, read. render-<gel> begins with the settings of
/// render; photographs and the sensors of variants follow.
/// \throw DataError, ConfigError if a sensor that a variant of render names cannot be read
std::vector<Choice> choices_of(const DatasetConfig& config, const std::vector<Sensor>& sensors);

/// Writes each choice into `folder`, where it says something else: a line `role hash path` per file. The time of such a
/// file is a prerequisite of what is made, and so later than its last result just when contents are others: the time of
/// the change (ctime) where the same file has other contents, as what was made after that is made of them; now where
/// another file was chosen; as before where only its path differs, as in a copy that was moved.
/// \throw DataError if a file cannot be read or written
void write_choices(const std::vector<Choice>& choices, const std::filesystem::path& folder);

}  // namespace tacipc
