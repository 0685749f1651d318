// Origins of the samples of a shard: sensors, gels, objects, programs, limits.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/sample/dataset_plan.h"
#include "stages/dataset/pack/sample_frames.h"

namespace tacipc {

/// Name of a sensor in the packed dataset: that of the plan. If the plan gives a sample its own sensor file (other than
/// `<sensor>.yaml`), the first eight digits of the file's hash are appended.
std::string sensor_id_of(const PlannedRow& plan, const SampleFrames& sample);

/// Collects the origins of a shard's samples.
class Origins {
 public:
  /// Adds a sample.
  /// \throw DataError if two samples use one name for different files
  void add(const PlannedRow& plan, const std::string& sensor_id, const SampleFrames& sample);
  /// Lines `sensors`, `objects` (each with the paths and hashes of its files, relative to `folder`, the shard's
  /// folder), `versions` and `limits` (each distinct set once).
  Value::Map lines(const std::filesystem::path& folder) const;
  /// Files of samples that the shard stores as its own, by their names in its folder. A sample's files may be dropped
  /// after packing, and the download is assembled after that.
  std::map<std::string, std::filesystem::path> copies() const;

 private:
  struct File {
    std::filesystem::path path;
    std::string hash;
    std::string copy = {};  // name of the copy among the shard's own files
  };
  /// name → file's role → file
  using Files = std::map<std::string, std::map<std::string, File>>;
  static void add_file(Files& files, const std::string& name, const std::string& role, const File& file);
  static Value::List lines_of(const Files& files, const std::filesystem::path& folder);

  Files sensors_;
  Files objects_;
  std::set<std::string> versions_;
  std::map<std::string, Value::Map> limits_;  // distinct limits, by their text
};

}  // namespace tacipc
