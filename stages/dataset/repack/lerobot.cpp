#include "stages/dataset/repack/lerobot.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/json.h"
#include "common/base/log.h"
#include "common/format/hdf5_reader.h"
#include "common/format/parquet_writer.h"
#include "common/image/image.h"
#include "common/sample/motion.h"
#include "stages/dataset/repack/feature_statistics.h"
#include "stages/dataset/repack/float_tiff.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// How a feature comes from its field.
enum class Rule { picture, depth, numbers, displacement, wrench, pose, next_pose };

struct Feature {
  const char* name;
  const char* field;  // of `obs`
  Rule rule;
  std::vector<const char*> names = {};  // of the last axis; of all axes for images
  const char* unit = "";
};

/// What an episode's frames have, where the shard has the field: the one table of names and units.
const std::vector<Feature> kFeatures{
    {"observation.images.tactile", "rgb", Rule::picture, {"height", "width", "channels"}, "code"},
    {"observation.images.tactile_marker", "rgb_marker", Rule::picture, {"height", "width", "channels"}, "code"},
    {"observation.images.indentation", "indentation_mm", Rule::depth, {"height", "width", "channels"}, "mm"},
    {"observation.tactile.marker_displacement", "marker_mm", Rule::displacement, {"x", "y", "z"}, "m"},
    {"observation.tactile.force_field", "force_field_N", Rule::numbers, {"fx", "fy", "fz"}, "N"},
    {"observation.wrench.tactile", "force_N", Rule::wrench, {"fx", "fy", "fz", "tx", "ty", "tz"}, "N, N m"},
    {"observation.force", "press_force_N", Rule::numbers, {"press"}, "N"},
    {"observation.state", "object_pose", Rule::pose, {"x", "y", "z", "qx", "qy", "qz", "qw"}, "m, unit quaternion"},
    {"action", "object_pose", Rule::next_pose, {"x", "y", "z", "qx", "qy", "qz", "qw"}, "m, unit quaternion"},
    {"time", "time_s", Rule::numbers, {"time"}, "s"}};

/// What every LeRobot dataset has, in this order behind ours.
constexpr const char* kIndices[] = {"frame_index", "episode_index", "index", "task_index"};

const Value kNull = std::numeric_limits<double>::quiet_NaN();  // as JSON writes it

bool is_image(Rule rule) { return rule == Rule::picture || rule == Rule::depth; }

/// Extents of a frame of a feature as LeRobot counts them.
std::vector<std::size_t> shape_of(const Feature& feature, const Hdf5Reader& shard, const std::string& obs) {
  std::vector<std::size_t> shape = shard.shape(obs + feature.field);
  shape.erase(shape.begin());
  if (feature.rule == Rule::depth) shape.push_back(1);
  if (feature.rule == Rule::wrench) shape = {6};
  if (shape.empty()) shape = {1};
  return shape;
}

/// A sample's group of fields and how many frames it has.
struct Episode {
  const Hdf5Reader& shard;
  std::string obs;
  std::size_t frames;

  std::vector<double> numbers(const std::string& field, std::size_t frame) const {
    return from_bytes(shard.type(obs + field), shard.read_frame(obs + field, frame));
  }
};

/// A frame of a feature that is no image, in its unit.
std::vector<double> frame_of(const Feature& feature, const Episode& episode, std::size_t frame) {
  constexpr double kMetres = 1e-3;
  if (feature.rule == Rule::next_pose) frame = std::min(frame + 1, episode.frames - 1);
  std::vector<double> numbers = episode.numbers(feature.field, frame);
  if (feature.rule == Rule::pose || feature.rule == Rule::next_pose) {
    for (std::size_t i = 0; i < 3; ++i) numbers[i] *= kMetres;
  } else if (feature.rule == Rule::displacement) {
    const std::vector<double> rest = episode.numbers(feature.field, 0);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = kMetres * (numbers[i] - rest[i]);
  } else if (feature.rule == Rule::wrench) {
    for (const double torque : episode.numbers("torque_Nmm", frame)) numbers.push_back(kMetres * torque);
  }
  return numbers;
}

/// "press star, then shear"; the motion's name where the shard does not keep phases.
std::string task_of(const Episode& episode, const std::string& sample) {
  const std::string object = episode.shard.text_attribute(sample, "object_id");
  if (!episode.shard.has(episode.obs + "phase")) return episode.shard.text_attribute(sample, "motion") + " " + object;
  std::vector<std::string> phases;
  for (std::size_t t = 0; t < episode.frames; ++t) {
    const auto code = static_cast<std::size_t>(episode.numbers("phase", t).at(0));
    const std::string phase = kPhaseNames.at(std::min(code, kPhaseNames.size() - 1));
    const bool moves = code > static_cast<std::size_t>(PhaseKind::approach);
    if (moves && (phases.empty() || phases.back() != phase)) phases.push_back(phase);
  }
  if (phases.empty()) return "touch " + object;
  phases.front() += " " + object;
  return fmt::format("{}", fmt::join(phases, ", then "));
}

/// The dataset of one sensor.
class Dataset {
 public:
  Dataset(std::string sensor, const OutputPath& output) : sensor_(std::move(sensor)), output_(output) {}

  void add(const Hdf5Reader& shard, const std::string& id) {
    const std::string sample = "/data/" + id;
    const std::string obs = sample + "/obs/";
    if (!shard.has(obs + "time_s")) throw DataError("{}: has no field time_s: pack with a profile that has it", id);
    const std::size_t frames = shard.shape(obs + "time_s").at(0);
    const Episode episode{shard, obs, frames};
    if (features_.empty()) begin(episode, id);
    check(episode, id);
    look_at_times(episode, id);
    if (!data_) next_file();

    const auto task = tasks_.try_emplace(task_of(episode, sample), static_cast<std::int64_t>(tasks_.size())).first;
    const std::int64_t first = total_frames_, length = static_cast<std::int64_t>(frames);
    std::vector<ParquetValues> columns;
    for (std::size_t f = 0; f < features_.size(); ++f) columns.push_back(column(f, episode));
    std::vector<float> timestamps;
    std::vector<std::int64_t> frame_index, index;
    for (std::int64_t t = 0; t < length; ++t) {
      timestamps.push_back(static_cast<float>(static_cast<double>(t) / fps_));
      frame_index.push_back(t);
      index.push_back(first + t);
    }
    columns.emplace_back(timestamps);
    columns.emplace_back(frame_index);
    columns.emplace_back(std::vector<std::int64_t>(frames, episodes()));
    columns.emplace_back(index);
    columns.emplace_back(std::vector<std::int64_t>(frames, task->second));
    data_->add_row_group(columns, frames);

    ids_.push_back(id);
    task_names_.push_back(task->first);
    splits_.push_back(shard.text_attribute(sample, "split"));
    begins_.push_back(first);
    lengths_.push_back(length);
    files_.push_back(file_);
    total_frames_ += length;
  }

  /// A shard is a file; a dataset of many sensors would have one open for each.
  void end_shard() {
    if (data_) data_->close();
    data_.reset();
  }

  Value::Map close() {
    if (uneven_)
      log_warning(
          "{}: the steps between frames differ (first in {}): `timestamp` counts frames at {:g} per second, "
          "`time` has their times",
          sensor_, *uneven_, fps_);
    write_episodes();
    write_tasks();
    write_file(output_(sensor_ + "/meta/info.json"), to_json(info()));
    Value::Map statistics;
    for (std::size_t f = 0; f < features_.size(); ++f)
      statistics.emplace_back(features_[f].name, statistics_[f].value(is_image(features_[f].rule)));
    write_file(output_(sensor_ + "/meta/stats.json"), to_json(statistics));
    return {{"episodes", episodes()}, {"frames", total_frames_}, {"tasks", tasks_.size()}, {"equally_timed", !uneven_}};
  }

 private:
  std::int64_t episodes() const { return static_cast<std::int64_t>(ids_.size()); }

  static bool has(const Feature& feature, const Episode& episode) {
    return episode.shard.has(episode.obs + feature.field) &&
           (feature.rule != Rule::wrench || episode.shard.has(episode.obs + "torque_Nmm"));
  }

  void begin(const Episode& first, const std::string& id) {
    for (const Feature& feature : kFeatures) {
      if (!has(feature, first)) continue;
      features_.push_back(feature);
      shapes_.push_back(shape_of(feature, first.shard, first.obs));
      statistics_.emplace_back(shapes_.back().back());
    }
    if (features_.empty()) throw DataError("{}: has none of the fields that LeRobot datasets are made of", id);
    if (first.frames < 2) throw DataError("{}: has one frame, which tells no rate", id);
    const double step_s = first.numbers("time_s", 1).at(0) - first.numbers("time_s", 0).at(0);
    if (!(step_s > 0.0)) throw DataError("{}: its first two frames are at the same time", id);
    fps_ = std::round(1e6 / step_s) / 1e6;
  }

  void check(const Episode& episode, const std::string& id) const {
    std::size_t f = 0;
    for (const Feature& feature : kFeatures) {
      const bool wanted = f < features_.size() && std::string_view(features_[f].name) == feature.name;
      if (has(feature, episode) != wanted)
        throw DataError("{}: has {} field {}, which earlier samples have{}: pack all shards with one profile", id,
                        wanted ? "no" : "a", feature.field, wanted ? "" : " not");
      if (!wanted) continue;
      if (const auto shape = shape_of(feature, episode.shard, episode.obs); shape != shapes_[f])
        throw DataError("{}: {} has shape ({}), in earlier samples ({})", id, feature.field, fmt::join(shape, ", "),
                        fmt::join(shapes_[f], ", "));
      ++f;
    }
  }

  void look_at_times(const Episode& episode, const std::string& id) {
    constexpr double kSame = 1e-3;  // of a step
    for (std::size_t t = 1; t < episode.frames && !uneven_; ++t) {
      const double step_s = episode.numbers("time_s", t).at(0) - episode.numbers("time_s", t - 1).at(0);
      if (std::abs(step_s * fps_ - 1.0) > kSame) uneven_ = id;
    }
  }

  void next_file() {
    ++file_;
    data_ = std::make_unique<ParquetWriter>(
        output_(fmt::format("{}/data/chunk-{:03}/file-{:03}.parquet", sensor_, file_ / kChunk, file_ % kChunk)),
        columns(), ParquetWriter::KeyValues{{"huggingface", to_json(hub_features())}});
  }

  std::vector<ParquetColumn> columns() const {
    std::vector<ParquetColumn> columns;
    for (std::size_t f = 0; f < features_.size(); ++f) {
      if (is_image(features_[f].rule))
        columns.push_back({.name = features_[f].name, .type = ParquetType::image});
      else
        columns.push_back(
            {.name = features_[f].name,
             .type = ParquetType::f32,
             .shape = shapes_[f].size() == 1 && shapes_[f][0] == 1 ? std::vector<std::size_t>{} : shapes_[f]});
    }
    columns.push_back({.name = "timestamp", .type = ParquetType::f32});
    for (const char* index : kIndices) columns.push_back({.name = index, .type = ParquetType::i64});
    return columns;
  }

  ParquetValues column(std::size_t f, const Episode& episode) {
    const Feature& feature = features_[f];
    if (is_image(feature.rule)) {
      std::vector<ParquetImage> images;
      for (std::size_t t = 0; t < episode.frames; ++t) images.push_back(image(f, episode, t));
      return images;
    }
    std::vector<float> all;
    for (std::size_t t = 0; t < episode.frames; ++t) {
      const std::vector<double> numbers = frame_of(feature, episode, t);
      statistics_[f].add(numbers);
      for (const double number : numbers) all.push_back(static_cast<float>(number));
    }
    return all;
  }

  ParquetImage image(std::size_t f, const Episode& episode, std::size_t t) {
    const std::string field = episode.obs + features_[f].field;
    const int height = static_cast<int>(shapes_[f][0]), width = static_cast<int>(shapes_[f][1]);
    const std::string bytes = episode.shard.read_frame(field, t);
    if (features_[f].rule == Rule::picture) {
      ByteImage picture(width, height, 3);
      picture.pixels.assign(bytes.begin(), bytes.end());
      statistics_[f].add(picture.pixels, 1.0 / 255.0);
      return {.bytes = png_bytes(picture, field), .path = fmt::format("frame-{:06}.png", t)};
    }
    const std::vector<double> numbers = from_bytes(episode.shard.type(field), bytes);
    const std::vector<float> pixels(numbers.begin(), numbers.end());
    statistics_[f].add(pixels);
    return {.bytes = float_tiff_bytes(pixels, width, height), .path = fmt::format("frame-{:06}.tiff", t)};
  }

  void write_episodes() const {
    const std::vector<std::int64_t> zeros(ids_.size(), 0);
    std::vector<std::int64_t> index, ends, chunks, files;
    for (std::size_t e = 0; e < ids_.size(); ++e) {
      index.push_back(static_cast<std::int64_t>(e));
      ends.push_back(begins_[e] + lengths_[e]);
      chunks.push_back(files_[e] / kChunk);
      files.push_back(files_[e] % kChunk);
    }
    ParquetWriter file(output_(sensor_ + "/meta/episodes/chunk-000/file-000.parquet"),
                       {{.name = "episode_index", .type = ParquetType::i64},
                        {.name = "tasks", .type = ParquetType::text, .shape = {1}},
                        {.name = "length", .type = ParquetType::i64},
                        {.name = "data/chunk_index", .type = ParquetType::i64},
                        {.name = "data/file_index", .type = ParquetType::i64},
                        {.name = "dataset_from_index", .type = ParquetType::i64},
                        {.name = "dataset_to_index", .type = ParquetType::i64},
                        {.name = "meta/episodes/chunk_index", .type = ParquetType::i64},
                        {.name = "meta/episodes/file_index", .type = ParquetType::i64},
                        {.name = "sample", .type = ParquetType::text}});
    file.add_row_group({index, task_names_, lengths_, chunks, files, begins_, ends, zeros, zeros, ids_}, ids_.size());
    file.close();
  }

  /// Pandas reads this file, and takes the text as the index only if the footer says so.
  void write_tasks() const {
    std::vector<std::string> texts(tasks_.size());
    std::vector<std::int64_t> numbers;
    for (const auto& [text, number] : tasks_) texts[static_cast<std::size_t>(number)] = text;
    for (std::size_t i = 0; i < texts.size(); ++i) numbers.push_back(static_cast<std::int64_t>(i));
    const auto column = [](const char* name, const char* type, const char* numpy) {
      return Value(Value::Map{
          {"name", name}, {"field_name", name}, {"pandas_type", type}, {"numpy_type", numpy}, {"metadata", kNull}});
    };
    const Value pandas = Value::Map{
        {"index_columns", Value::List{"task"}},
        {"column_indexes", Value::List{}},
        {"columns", Value::List{column("task_index", "int64", "int64"), column("task", "unicode", "object")}},
        {"pandas_version", "1.5.3"}};
    ParquetWriter file(output_(sensor_ + "/meta/tasks.parquet"),
                       {{.name = "task_index", .type = ParquetType::i64}, {.name = "task", .type = ParquetType::text}},
                       {{"pandas", to_json(pandas)}});
    file.add_row_group({numbers, texts}, texts.size());
    file.close();
  }

  Value info() const {
    Value::Map features;
    for (std::size_t f = 0; f < features_.size(); ++f) {
      const Feature& feature = features_[f];
      Value::List shape(shapes_[f].begin(), shapes_[f].end());
      Value::List names(feature.names.begin(), feature.names.end());
      Value::Map lines{{"dtype", is_image(feature.rule) ? "image" : "float32"},
                       {"shape", shape},
                       {"names", is_image(feature.rule) || shape.size() == 1 ? Value(names) : kNull},
                       {"unit", feature.unit}};
      if (!is_image(feature.rule) && shape.size() > 1) lines.emplace_back("components", names);
      if (feature.rule == Rule::depth)
        lines.emplace_back("info", Value::Map{{"is_depth_map", true}, {"depth_unit", feature.unit}});
      features.emplace_back(feature.name, lines);
    }
    const auto scalar = [&](const char* name, const char* type) {
      features.emplace_back(name, Value::Map{{"dtype", type}, {"shape", Value::List{Value(1)}}, {"names", kNull}});
    };
    scalar("timestamp", "float32");
    for (const char* index : kIndices) scalar(index, "int64");
    return Value::Map{{"codebase_version", "v3.0"},
                      {"robot_type", sensor_},
                      {"total_episodes", episodes()},
                      {"total_frames", total_frames_},
                      {"total_tasks", tasks_.size()},
                      {"chunks_size", kChunk},
                      {"data_files_size_in_mb", 100},
                      {"video_files_size_in_mb", 200},
                      {"fps", fps_},
                      {"splits", splits()},
                      {"data_path", "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"},
                      {"video_path", kNull},
                      {"features", features}};
  }

  /// Ranges of episodes, "train": "0:20".
  Value splits() const {
    Value::Map ranges;
    for (std::size_t e = 0, first = 0; e < splits_.size(); ++e) {
      if (e + 1 < splits_.size() && splits_[e + 1] == splits_[e]) continue;
      ranges.emplace_back(splits_[e], fmt::format("{}:{}", first, e + 1));
      first = e + 1;
    }
    return ranges;
  }

  /// What the hub's viewer and Hugging Face's `datasets` read of the footer.
  Value hub_features() const {
    const auto value = [](const char* type) { return Value(Value::Map{{"dtype", type}, {"_type", "Value"}}); };
    Value::Map features;
    for (std::size_t f = 0; f < features_.size(); ++f) {
      const auto& shape = shapes_[f];
      if (is_image(features_[f].rule))
        features.emplace_back(features_[f].name, Value::Map{{"_type", "Image"}});
      else if (shape.size() == 1 && shape[0] == 1)
        features.emplace_back(features_[f].name, value("float32"));
      else if (shape.size() == 1)
        features.emplace_back(features_[f].name,
                              Value::Map{{"feature", value("float32")}, {"length", shape[0]}, {"_type", "List"}});
      else
        features.emplace_back(features_[f].name, Value::Map{{"shape", Value::List(shape.begin(), shape.end())},
                                                            {"dtype", "float32"},
                                                            {"_type", fmt::format("Array{}D", shape.size())}});
    }
    features.emplace_back("timestamp", value("float32"));
    for (const char* index : kIndices) features.emplace_back(index, value("int64"));
    return Value::Map{{"info", Value::Map{{"features", features}}}};
  }

  static constexpr std::int64_t kChunk = 1000;  // files in a folder

  std::string sensor_;
  const OutputPath& output_;
  std::vector<Feature> features_;
  std::vector<std::vector<std::size_t>> shapes_;
  std::vector<FeatureStatistics> statistics_;
  double fps_ = 0.0;
  std::optional<std::string> uneven_;  // the first sample whose frames are not 1/fps_ apart
  std::unique_ptr<ParquetWriter> data_;
  std::int64_t file_ = -1, total_frames_ = 0;
  std::map<std::string, std::int64_t> tasks_;
  std::vector<std::string> ids_, task_names_, splits_;
  std::vector<std::int64_t> begins_, lengths_, files_;
};

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

}  // namespace

Value::Map write_lerobot(std::vector<fs::path> shards, const OutputPath& output) {
  sort_by_split(shards);
  std::map<std::string, Dataset> datasets;
  for (std::size_t s = 0; s < shards.size(); ++s) {
    const Hdf5Reader shard(shards[s]);
    if (!shard.has("/data")) throw DataError("{}: is not a shard of pack", shards[s].string());
    for (const std::string& id : shard.names("/data")) {
      show_progress(static_cast<double>(s) / static_cast<double>(shards.size()), id);
      const std::string sensor = shard.text_attribute("/data/" + id, "sensor_id");
      datasets.try_emplace(sensor, sensor, output).first->second.add(shard, id);
    }
    for (auto& [sensor, dataset] : datasets) dataset.end_shard();
  }
  Value::Map summary;
  for (auto& [sensor, dataset] : datasets) summary.emplace_back(sensor, dataset.close());
  return summary;
}

}  // namespace tacipc
