// Reads samples of packed shards as episodes: one per sample, and one for both fingers of a grasp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/format/hdf5_reader.h"

namespace tacipc {

/// Sample in its shard; `group` is its group there, "/data/<id>".
struct SampleAt {
  const Hdf5Reader& shard;
  std::string group;

  std::string field(const std::string& name) const { return group + "/obs/" + name; }
  bool has(const std::string& name) const { return shard.has(field(name)); }
  std::vector<double> numbers(const std::string& name, std::size_t frame) const {
    return from_bytes(shard.type(field(name)), shard.read_frame(field(name), frame));
  }
};

/// Episode of a sample, or of the left and the right finger of a grasp.
class Episode {
 public:
  /// \param id id of the sample, or of the left finger, which is also the grasp's
  /// \throw DataError if the fingers of a grasp have images of different frames or no times, or a field of episodes
  /// does not have the type and shape that pack gives it
  Episode(std::string id, std::vector<SampleAt> samples);

  const std::string& id() const { return id_; }
  std::size_t frames() const { return frames_; }
  /// Times of the frames, s.
  /// \throw DataError if `time_s` is not packed
  const std::vector<double>& times_s() const;
  const SampleAt& sample(std::size_t finger = 0) const { return samples_[finger]; }
  bool is_grasp() const { return samples_.size() == 2; }
  /// Kind of episodes with the same fields: the sensor, followed by "_grasp" for fingers.
  std::string kind() const;
  /// Attribute of the sample, or of the left finger.
  std::string text(const std::string& attribute) const;
  /// Attribute that names a file or folder, reduced to its name.
  std::string name_of(const std::string& attribute) const;
  /// Numbers of a field of `series` in a frame of the episode.
  /// \pre is_grasp()
  std::vector<double> series(const std::string& field, std::size_t frame) const;

 private:
  std::string id_;
  std::vector<SampleAt> samples_;
  std::size_t frames_ = 0;
  std::vector<double> times_s_;
  std::vector<std::size_t> rows_;  // row of `series` for each frame
};

/// Gives the path at which to write a file of this name.
using OutputPath = std::function<std::filesystem::path(const std::string& name)>;

/// Takes an episode and the number of the shard that holds it, or its left finger.
using TakeEpisode = std::function<void(std::size_t shard, const Episode& episode)>;

/// Visits all episodes: shards of train, val and test in that order, sorted by the names of shards and samples. Fingers
/// of a grasp may be in two shards; a finger whose partner is in no shard is left out.
/// \return number of fingers left out
/// \throw DataError if a file is not a shard
std::size_t for_each_episode(std::vector<std::filesystem::path> shards, const TakeEpisode& take);

}  // namespace tacipc
