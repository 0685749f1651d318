#include "stages/dataset/repack/episodes.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "common/base/error.h"
#include "common/base/log.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Required form of a field.
struct FieldForm {
  const char* name;
  std::vector<std::size_t> frame;                 // shape of a frame; kAny for any nonzero extent
  std::optional<NumberType> type = std::nullopt;  // absent: any real type
};
constexpr std::size_t kAny = 0;

/// Fields of episodes, as in pack's schema.yaml.
const std::vector<FieldForm> kObs{{"rgb", {kAny, kAny, 3}, NumberType::u8},
                                  {"rgb_marker", {kAny, kAny, 3}, NumberType::u8},
                                  {"indentation_mm", {kAny, kAny}},
                                  {"camera_depth_mm", {kAny, kAny}},
                                  {"force_field_N", {kAny, kAny, 3}},
                                  {"marker_px", {2, kAny, 2}},
                                  {"marker_mm", {kAny, 3}},
                                  {"force_N", {3}},
                                  {"torque_Nmm", {3}},
                                  {"press_force_N", {}},
                                  {"object_pose", {7}},
                                  {"time_s", {}},
                                  {"phase", {}, NumberType::u8},
                                  {"frame", {}, NumberType::i32}};
/// Fields of a grasp; all are required.
const std::vector<FieldForm> kSeries{{"time_s", {}}, {"hand_pose", {7}}, {"finger_pose", {2, 7}}, {"object_pose", {7}}};

/// Checks a field.
/// \throw DataError if it has another form, or another number of frames
void check_form(const Hdf5Reader& shard, const std::string& group, const FieldForm& form, std::size_t frames) {
  const std::string path = fmt::format("{}/{}", group, form.name);
  const std::vector<std::size_t> shape = shard.shape(path);
  const NumberType type = shard.type(path);
  const bool is_real = type != NumberType::u8 && type != NumberType::i32;
  bool fits = shape.size() == form.frame.size() + 1 && shape[0] == frames && (form.type ? type == form.type : is_real);
  for (std::size_t i = 1; fits && i < shape.size(); ++i)
    fits = form.frame[i - 1] == kAny ? shape[i] > 0 : shape[i] == form.frame[i - 1];
  if (fits) return;
  std::string wanted = std::to_string(frames);
  for (const std::size_t extent : form.frame) wanted += extent == kAny ? " x n" : fmt::format(" x {}", extent);
  throw DataError("{}: {}: is {} of {}, must be {} of {}", shard.name(), path, fmt::join(shape, " x "), name_of(type),
                  wanted, form.type ? name_of(*form.type) : "reals");
}

/// Reads finite, strictly ascending numbers.
std::vector<double> times_of(const Hdf5Reader& shard, const std::string& path) {
  std::vector<double> times_s = from_bytes(shard.type(path), shard.read(path));
  for (std::size_t t = 0; t < times_s.size(); ++t)
    if (!std::isfinite(times_s[t]) || (t > 0 && times_s[t] < times_s[t - 1]))
      throw DataError("{}: {}: frame {} has the time {:g} s, which is no later one", shard.name(), path, t, times_s[t]);
  return times_s;
}

/// Sorts shards: train, val, test by the shards' names, and by name within a split.
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

/// Finds the right finger of a grasp in any shard.
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

  /// Appends the right finger of the grasp whose left finger is `id`.
  /// \return false if that is not a left finger, or has no partner
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
  std::map<std::string, std::pair<std::size_t, std::string>> at_;  // shard and group, by grasp
  std::unique_ptr<Open> open_;
  std::size_t fingers_ = 0, paired_ = 0;
};

}  // namespace

Episode::Episode(std::string id, std::vector<SampleAt> samples) : id_(std::move(id)), samples_(std::move(samples)) {
  for (std::size_t finger = 0; finger < samples_.size(); ++finger) {
    const SampleAt& sample = samples_[finger];
    const std::size_t frames = sample.shard.count_attribute(sample.group, "n_frames");
    if (finger == 0) frames_ = frames;
    if (frames != frames_) throw DataError("{}: its fingers have images of different frames", id_);
    for (const FieldForm& form : kObs)
      if (sample.has(form.name)) check_form(sample.shard, sample.group + "/obs", form, frames);
    if (!sample.has("time_s")) continue;
    std::vector<double> times_s = times_of(sample.shard, sample.field("time_s"));
    if (finger > 0 && times_s != times_s_) throw DataError("{}: its fingers have images of different frames", id_);
    times_s_ = std::move(times_s);
  }
  if (!is_grasp()) return;
  const std::string series = samples_[0].group + "/series";
  const std::vector<double> pressed_s = times_of(samples_[0].shard, series + "/time_s");
  for (const FieldForm& form : kSeries) check_form(samples_[0].shard, series, form, pressed_s.size());
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

std::string Episode::kind() const { return name_of("sensor_id") + (is_grasp() ? "_grasp" : ""); }

std::string Episode::text(const std::string& attribute) const {
  return samples_[0].shard.text_attribute(samples_[0].group, attribute);
}

std::string Episode::name_of(const std::string& attribute) const {
  return samples_[0].shard.name_attribute(samples_[0].group, attribute);
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
