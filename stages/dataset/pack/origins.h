// What the samples of a shard were made from and by: sensors, gels, objects, programs, limits.
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

/// Name of a sensor in the packed dataset: the plan's, and where the plan gives a sample a sensor file of its own (any
/// but `<sensor>.yaml`) also the first eight digits of its hash.
std::string sensor_id_of(const PlannedRow& plan, const SampleFrames& sample);

class Origins {
 public:
  /// \throw DataError if two samples mean different files by one name
  void add(const PlannedRow& plan, const std::string& sensor_id, const SampleFrames& sample);
  /// Lines `sensors`, `objects` (each with the paths and hashes of its files, as seen from `folder`, that of the
  /// shard), `versions` and `limits` (each different one once).
  Value::Map lines(const std::filesystem::path& folder) const;
  /// Files of samples that the lines name as the shard's own, by the name in its folder: a sample's may be dropped once
  /// it is packed, and the download is put together after that.
  std::map<std::string, std::filesystem::path> copies() const;

 private:
  struct File {
    std::filesystem::path path;
    std::string hash;
    std::string copy = {};  // its name among the shard's own files
  };
  /// name → file's role → file
  using Files = std::map<std::string, std::map<std::string, File>>;
  static void add_file(Files& files, const std::string& name, const std::string& role, const File& file);
  static Value::List lines_of(const Files& files, const std::filesystem::path& folder);

  Files sensors_;
  Files objects_;
  std::set<std::string> versions_;
  std::map<std::string, Value::Map> limits_;  // by their text
};

}  // namespace tacipc
