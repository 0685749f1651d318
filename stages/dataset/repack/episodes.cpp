#include "stages/dataset/repack/episodes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>

#include "common/base/error.h"
#include "common/base/log.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

std::vector<double> all_numbers(const Hdf5Reader& shard, const std::string& path) {
  return from_bytes(shard.type(path), shard.read(path));
}

/// Train before val before test, by the shards' names; within a split by name.
void sort_by_split(std::vector<fs::path>& shards) {
  const auto rank = [](const fs::path& shard) {
    const std::string name = shard.filename().string();
    return name.starts_with("train") ? 0 : name.starts_with("val") ? 1 : name.starts_with("test") ? 2 : 3;
  };
  std::sort(shards.begin(), shards.end(), [&](const fs::path& a, const fs::path& b) {
    return std::pair(rank(a), a.filename()) < std::pair(rank(b), b.filename());
  });
}

bool is_finger(const Hdf5Reader& shard, const std::string& sample) { return shard.has(sample + "/series"); }

/// Finds the right finger of a grasp, whatever shard it is in.
class RightFingers {
 public:
  /// \throw DataError if a file is not a shard
  explicit RightFingers(const std::vector<fs::path>& shards) : shards_(shards) {
    for (std::size_t s = 0; s < shards.size(); ++s) {
      const Hdf5Reader shard(shards[s]);
      if (!shard.has("/data")) throw DataError("{}: is not a shard of pack", shards[s].string());
      for (const std::string& id : shard.names("/data")) {
        const std::string sample = "/data/" + id;
        if (!is_finger(shard, sample)) continue;
        ++fingers_;
        if (shard.text_attribute(sample, "finger") == "right")
          at_.emplace(shard.text_attribute(sample, "grasp"), std::pair(s, sample));
      }
    }
  }

  /// Appends the right finger of the grasp whose left one is `id`; false if that is not a left finger, or alone.
  bool add(const std::string& id, std::vector<SampleAt>& samples) {
    const auto found = at_.find(id);
    if (found == at_.end()) return false;
    const auto& [shard, group] = found->second;
    if (!open_ || open_->first != shard)
      open_ = std::make_unique<Open>(std::piecewise_construct, std::tuple(shard), std::tuple(shards_[shard]));
    samples.push_back({open_->second, group});
    paired_ += 2;
    return true;
  }

  std::size_t alone() const { return fingers_ - paired_; }

 private:
  using Open = std::pair<std::size_t, Hdf5Reader>;

  const std::vector<fs::path>& shards_;
  std::map<std::string, std::pair<std::size_t, std::string>> at_;  // by the grasp: shard and group
  std::unique_ptr<Open> open_;
  std::size_t fingers_ = 0, paired_ = 0;
};

}  // namespace

Episode::Episode(std::string id, std::vector<SampleAt> samples) : id_(std::move(id)), samples_(std::move(samples)) {
  for (std::size_t finger = 0; finger < samples_.size(); ++finger) {
    const SampleAt& sample = samples_[finger];
    if (!sample.has("time_s")) continue;
    std::vector<double> times_s = all_numbers(sample.shard, sample.field("time_s"));
    if (finger > 0 && times_s != times_s_) throw DataError("{}: its fingers have images of different frames", id_);
    times_s_ = std::move(times_s);
  }
  frames_ = times_s_.size();
  if (times_s_.empty())
    for (const auto& [name, value] : samples_[0].shard.attributes(samples_[0].group))
      if (name == "n_frames") frames_ = static_cast<std::size_t>(std::get<std::int64_t>(value.data()));
  if (!is_grasp()) return;
  const std::vector<double> pressed_s = all_numbers(samples_[0].shard, samples_[0].group + "/series/time_s");
  for (const double time_s : this->times_s()) {
    const auto row = std::lower_bound(pressed_s.begin(), pressed_s.end(), time_s);
    if (row == pressed_s.end() || *row != time_s)
      throw DataError("{}: the series has no frame at {:g} s, where there is an image", id_, time_s);
    rows_.push_back(static_cast<std::size_t>(row - pressed_s.begin()));
  }
}

const std::vector<double>& Episode::times_s() const {
  if (times_s_.empty()) throw DataError("{}: has no field time_s: pack with a profile that has it", id_);
  return times_s_;
}

std::string Episode::kind() const { return text("sensor_id") + (is_grasp() ? "_grasp" : ""); }

std::string Episode::text(const std::string& attribute) const {
  return samples_[0].shard.text_attribute(samples_[0].group, attribute);
}

std::vector<double> Episode::series(const std::string& field, std::size_t frame) const {
  const std::string path = samples_[0].group + "/series/" + field;
  return from_bytes(samples_[0].shard.type(path), samples_[0].shard.read_frame(path, rows_[frame]));
}

std::size_t for_each_episode(std::vector<fs::path> shards, const TakeEpisode& take) {
  sort_by_split(shards);
  RightFingers rights(shards);
  for (std::size_t s = 0; s < shards.size(); ++s) {
    const Hdf5Reader shard(shards[s]);
    for (const std::string& id : shard.names("/data")) {
      show_progress(static_cast<double>(s) / static_cast<double>(shards.size()), id);
      std::vector<SampleAt> samples{{shard, "/data/" + id}};
      if (is_finger(shard, samples[0].group) && !rights.add(id, samples)) continue;
      take(s, Episode(id, std::move(samples)));
    }
  }
  return rights.alone();
}

}  // namespace tacipc
