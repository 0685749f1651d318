// Writes one HDF5 file of samples, a frame at a time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/format/hdf5_writer.h"
#include "common/sample/dataset_plan.h"
#include "stages/dataset/pack/pack_config.h"
#include "stages/dataset/pack/sample_frames.h"

namespace tacipc {

/// Attributes of a sample's group, in their order.
Value::Map sample_attributes(const PlannedRow& plan, const std::string& sensor_id, const SampleFrames& sample);

/// Writes the samples of a shard, one after the other.
class ShardWriter {
 public:
  /// \param root attributes of the file
  ShardWriter(const std::filesystem::path& path, const PackConfig& config, const Value::Map& root);

  /// Adds the camera of a sensor under /sensors/<id>.
  void add_sensor(const std::string& id, const Value::Map& camera);
  void add_sample(const PlannedRow& plan, const std::string& sensor_id, SampleFrames& sample);
  /// Writes the lists of ids and everything known only at the end, and closes the file.
  void close();

  std::size_t samples() const { return ids_.size(); }
  std::size_t frames() const { return frames_; }

 private:
  void write_field(const Field& field, const std::string& group, SampleFrames& sample);
  void write_section(Section section, const std::string& group, SampleFrames& sample, bool variant);

  const PackConfig& config_;
  Hdf5Writer file_;
  std::vector<std::string> ids_;
  std::vector<std::pair<std::string, std::string>> splits_;  // pairs of list and id
  std::vector<std::pair<std::string, Value::Map>> sensors_;
  std::size_t frames_ = 0;
};

}  // namespace tacipc
