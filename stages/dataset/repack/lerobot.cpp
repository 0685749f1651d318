#include "stages/dataset/repack/lerobot.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/json.h"
#include "common/base/log.h"
#include "common/format/parquet_writer.h"
#include "common/image/image.h"
#include "stages/dataset/repack/episode_statistics.h"
#include "stages/dataset/repack/float_tiff.h"
#include "stages/dataset/repack/lerobot_features.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Columns of every LeRobot dataset, in this order after the features.
constexpr const char* kIndices[] = {"frame_index", "episode_index", "index", "task_index"};

const Value kNull = std::numeric_limits<double>::quiet_NaN();  // null in JSON

/// Dataset of episodes that have the same features.
class Dataset {
 public:
  Dataset(std::string name, const OutputPath& output) : name_(std::move(name)), output_(output) {}

  void add(const Episode& episode) {
    if (features_.empty()) begin(episode);
    check(episode);
    look_at_times(episode);
    if (!data_) next_file();

    const auto task = tasks_.try_emplace(task_of(episode), static_cast<std::int64_t>(tasks_.size())).first;
    const std::int64_t first = total_frames_, length = static_cast<std::int64_t>(episode.frames());
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
    columns.emplace_back(std::vector<std::int64_t>(episode.frames(), episodes()));
    columns.emplace_back(index);
    columns.emplace_back(std::vector<std::int64_t>(episode.frames(), task->second));
    for (std::size_t c = features_.size(); c < columns.size(); ++c) count(c, columns[c]);
    data_->add_row_group(columns, episode.frames());

    ids_.push_back(episode.id());
    task_names_.push_back(task->first);
    splits_.push_back(episode.text("split"));
    begins_.push_back(first);
    lengths_.push_back(length);
    files_.push_back(file_);
    total_frames_ += length;
  }

  /// Ends the file of a shard; otherwise a dataset of many sensors would have one open file for each.
  void end_shard() {
    if (data_) data_->close();
    data_.reset();
  }

  Value::Map close() {
    if (uneven_)
      log_warning(
          "{}: the steps between frames differ (first in {}): `timestamp` counts frames at {:g} per second, "
          "`time` has their times",
          name_, *uneven_, fps_);
    write_episodes();
    write_tasks();
    write_file(output_(name_ + "/meta/info.json"), to_json(info()));
    Value::Map statistics;
    for (const EpisodeStatistics& column : statistics_) statistics.push_back(column.lines());
    write_file(output_(name_ + "/meta/stats.json"), to_json(statistics));
    return {{"episodes", episodes()}, {"frames", total_frames_}, {"tasks", tasks_.size()}, {"equally_timed", !uneven_}};
  }

 private:
  std::int64_t episodes() const { return static_cast<std::int64_t>(ids_.size()); }

  void begin(const Episode& first) {
    const std::vector<double>& times_s = first.times_s();
    for (const Feature& feature : lerobot_features(first.is_grasp())) {
      if (!feature.in(first)) continue;
      features_.push_back(feature);
      extents_.push_back(feature.extents(first));
      std::size_t numbers = 1;
      for (const std::size_t extent : extents_.back()) numbers *= extent;
      shapes_.push_back(feature.is_flat() ? std::vector{numbers} : extents_.back());
      statistics_.emplace_back(feature.name, feature.is_flat() ? 1 : shapes_.back().back(), feature.is_image());
    }
    if (features_.empty()) throw DataError("{}: has none of the fields that LeRobot datasets are made of", first.id());
    for (const char* name : {"timestamp", kIndices[0], kIndices[1], kIndices[2], kIndices[3]})
      statistics_.emplace_back(name, 1, false);
    if (first.frames() < 2) throw DataError("{}: has only one frame; a frame rate needs two", first.id());
    const double step_s = times_s[1] - times_s[0];
    if (!(step_s > 0.0)) throw DataError("{}: its first two frames are at the same time", first.id());
    fps_ = std::round(1e6 / step_s) / 1e6;
    if (!(fps_ > 0.0 && fps_ < 1e9)) throw DataError("{}: its frames are {:g} s apart", first.id(), step_s);
  }

  void check(const Episode& episode) const {
    std::size_t f = 0;
    for (const Feature& feature : lerobot_features(episode.is_grasp())) {
      const bool wanted = f < features_.size() && features_[f].name == feature.name;
      if (feature.in(episode) != wanted)
        throw DataError("{}: has {} field {}, which earlier samples have{}: pack all shards with one profile",
                        episode.id(), wanted ? "no" : "a", feature.field, wanted ? "" : " not");
      if (!wanted) continue;
      if (const auto extents = feature.extents(episode); extents != extents_[f])
        throw DataError("{}: {} has shape ({}), in earlier samples ({})", episode.id(), feature.field,
                        fmt::join(extents, ", "), fmt::join(extents_[f], ", "));
      ++f;
    }
  }

  void look_at_times(const Episode& episode) {
    constexpr double kSame = 1e-3;  // fraction of a step
    const std::vector<double>& times_s = episode.times_s();
    for (std::size_t t = 1; t < times_s.size() && !uneven_; ++t)
      if (std::abs((times_s[t] - times_s[t - 1]) * fps_ - 1.0) > kSame) uneven_ = episode.id();
  }

  void next_file() {
    ++file_;
    data_ = std::make_unique<ParquetWriter>(
        output_(fmt::format("{}/data/chunk-{:03}/file-{:03}.parquet", name_, file_ / kChunk, file_ % kChunk)),
        columns(), ParquetWriter::KeyValues{{"huggingface", to_json(hub_features())}});
  }

  bool is_scalar(std::size_t f) const { return shapes_[f] == std::vector<std::size_t>{1}; }

  std::vector<ParquetColumn> columns() const {
    std::vector<ParquetColumn> columns;
    for (std::size_t f = 0; f < features_.size(); ++f) {
      if (features_[f].is_image())
        columns.push_back({.name = features_[f].name, .type = ParquetType::image});
      else
        columns.push_back({.name = features_[f].name,
                           .type = ParquetType::f32,
                           .shape = is_scalar(f) ? std::vector<std::size_t>{} : shapes_[f]});
    }
    columns.push_back({.name = "timestamp", .type = ParquetType::f32});
    for (const char* index : kIndices) columns.push_back({.name = index, .type = ParquetType::i64});
    return columns;
  }

  /// Counts a column in the statistics: `timestamp` and the indices.
  void count(std::size_t c, const ParquetValues& column) {
    FeatureStatistics episode = statistics_[c].begin_episode();
    const auto add = [&](const auto& numbers) {
      for (const auto number : numbers) episode.add_frame(std::vector{static_cast<double>(number)});
    };
    if (const auto* times_s = std::get_if<std::vector<float>>(&column)) add(*times_s);
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&column)) add(*whole);
    statistics_[c].end_episode(episode);
  }

  ParquetValues column(std::size_t f, const Episode& episode) {
    FeatureStatistics statistics = statistics_[f].begin_episode();
    std::vector<ParquetImage> images;
    std::vector<float> all;
    for (std::size_t t = 0; t < episode.frames(); ++t) {
      if (features_[f].is_image()) {
        images.push_back(image(f, episode, t, statistics));
        continue;
      }
      const std::vector<double> numbers = features_[f].frame(episode, t);
      statistics.add_frame(numbers);
      all.insert(all.end(), numbers.begin(), numbers.end());
    }
    statistics_[f].end_episode(statistics);
    if (features_[f].is_image()) return images;
    return all;
  }

  ParquetImage image(std::size_t f, const Episode& episode, std::size_t t, FeatureStatistics& statistics) const {
    const Feature& feature = features_[f];
    const SampleAt& sample = episode.sample(feature.finger);
    const std::string field = sample.field(feature.field);
    const int height = static_cast<int>(shapes_[f][0]), width = static_cast<int>(shapes_[f][1]);
    const std::string bytes = sample.shard.read_frame(field, t);
    if (feature.rule == FeatureRule::picture) {
      ByteImage picture(width, height, 3);
      picture.pixels.assign(bytes.begin(), bytes.end());
      statistics.add_frame(picture.pixels);
      return {.bytes = png_bytes(picture, field), .path = fmt::format("frame-{:06}.png", t)};
    }
    const std::vector<double> numbers = from_bytes(sample.shard.type(field), bytes);
    const std::vector<float> pixels(numbers.begin(), numbers.end());
    statistics.add_frame(pixels);
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
    std::vector<ParquetColumn> columns{{.name = "episode_index", .type = ParquetType::i64},
                                       {.name = "tasks", .type = ParquetType::text, .shape = {1}},
                                       {.name = "length", .type = ParquetType::i64},
                                       {.name = "data/chunk_index", .type = ParquetType::i64},
                                       {.name = "data/file_index", .type = ParquetType::i64},
                                       {.name = "dataset_from_index", .type = ParquetType::i64},
                                       {.name = "dataset_to_index", .type = ParquetType::i64},
                                       {.name = "meta/episodes/chunk_index", .type = ParquetType::i64},
                                       {.name = "meta/episodes/file_index", .type = ParquetType::i64},
                                       {.name = "sample", .type = ParquetType::text}};
    std::vector<ParquetValues> values{index, task_names_, lengths_, chunks, files, begins_, ends, zeros, zeros, ids_};
    for (const EpisodeStatistics& column : statistics_) column.append_columns(columns, values);
    ParquetWriter file(output_(name_ + "/meta/episodes/chunk-000/file-000.parquet"), columns);
    file.add_row_group(values, ids_.size());
    file.close();
  }

  /// Pandas reads this file. It takes the text as the index only if the footer says so.
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
    ParquetWriter file(output_(name_ + "/meta/tasks.parquet"),
                       {{.name = "task_index", .type = ParquetType::i64}, {.name = "task", .type = ParquetType::text}},
                       {{"pandas", to_json(pandas)}});
    file.add_row_group({numbers, texts}, texts.size());
    file.close();
  }

  Value info() const {
    Value::Map features;
    for (std::size_t f = 0; f < features_.size(); ++f) {
      const Feature& feature = features_[f];
      const Value::List names(feature.names.begin(), feature.names.end());
      Value::Map lines{{"dtype", feature.is_image() ? "image" : "float32"},
                       {"shape", Value::List(shapes_[f].begin(), shapes_[f].end())},
                       {"names", feature.is_flat() ? kNull : Value(names)},
                       {"unit", feature.unit}};
      if (feature.is_flat()) {
        lines.emplace_back("rows", Value::List(extents_[f].begin(), extents_[f].end()));
        lines.emplace_back("components", names);
      }
      if (feature.rule == FeatureRule::depth)
        lines.emplace_back("info", Value::Map{{"is_depth_map", true}, {"depth_unit", feature.unit}});
      features.emplace_back(feature.name, lines);
    }
    const auto scalar = [&](const char* name, const char* type) {
      features.emplace_back(name, Value::Map{{"dtype", type}, {"shape", Value::List{Value(1)}}, {"names", kNull}});
    };
    scalar("timestamp", "float32");
    for (const char* index : kIndices) scalar(index, "int64");
    return Value::Map{{"codebase_version", "v3.0"},
                      {"robot_type", name_},
                      {"total_episodes", episodes()},
                      {"total_frames", total_frames_},
                      {"total_tasks", tasks_.size()},
                      {"chunks_size", kChunk},
                      {"data_files_size_in_mb", 100},
                      {"video_files_size_in_mb", 200},
                      {"fps", fps_ == std::floor(fps_) ? Value(static_cast<std::int64_t>(fps_)) : Value(fps_)},
                      {"splits", splits()},
                      {"data_path", "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"},
                      {"video_path", kNull},
                      {"features", features}};
  }

  /// Ranges of episodes, such as "train": "0:20".
  Value splits() const {
    Value::Map ranges;
    for (std::size_t e = 0, first = 0; e < splits_.size(); ++e) {
      if (e + 1 < splits_.size() && splits_[e + 1] == splits_[e]) continue;
      if (std::ranges::find(ranges, splits_[e], &Value::Map::value_type::first) != ranges.end())
        throw DataError("{}: samples of split {} are in a shard of another split", name_, splits_[e]);
      ranges.emplace_back(splits_[e], fmt::format("{}:{}", first, e + 1));
      first = e + 1;
    }
    return ranges;
  }

  /// Features in the footer, which the hub's viewer and Hugging Face's `datasets` read.
  Value hub_features() const {
    const auto value = [](const char* type) { return Value(Value::Map{{"dtype", type}, {"_type", "Value"}}); };
    Value::Map features;
    for (std::size_t f = 0; f < features_.size(); ++f) {
      if (features_[f].is_image())
        features.emplace_back(features_[f].name, Value::Map{{"_type", "Image"}});
      else if (is_scalar(f))
        features.emplace_back(features_[f].name, value("float32"));
      else
        features.emplace_back(features_[f].name,
                              Value::Map{{"feature", value("float32")}, {"length", shapes_[f][0]}, {"_type", "List"}});
    }
    features.emplace_back("timestamp", value("float32"));
    for (const char* index : kIndices) features.emplace_back(index, value("int64"));
    return Value::Map{{"info", Value::Map{{"features", features}}}};
  }

  static constexpr std::int64_t kChunk = 1000;  // files per folder

  std::string name_;
  const OutputPath& output_;
  std::vector<Feature> features_;
  std::vector<std::vector<std::size_t>> extents_, shapes_;  // shapes of each feature as packed, and as written
  std::vector<EpisodeStatistics> statistics_;               // statistics of each column
  double fps_ = 0.0;
  std::optional<std::string> uneven_;  // first sample whose frames are not 1/fps_ apart
  std::unique_ptr<ParquetWriter> data_;
  std::int64_t file_ = -1, total_frames_ = 0;
  std::map<std::string, std::int64_t> tasks_;
  std::vector<std::string> ids_, task_names_, splits_;
  std::vector<std::int64_t> begins_, lengths_, files_;
};

}  // namespace

Value::Map write_lerobot(std::vector<fs::path> shards, const OutputPath& output) {
  std::map<std::string, Dataset> datasets;
  std::size_t open = 0;
  const std::size_t alone = for_each_episode(std::move(shards), [&](std::size_t shard, const Episode& episode) {
    if (shard != std::exchange(open, shard))
      for (auto& [kind, dataset] : datasets) dataset.end_shard();
    datasets.try_emplace(episode.kind(), episode.kind(), output).first->second.add(episode);
  });
  Value::Map summary;
  for (auto& [kind, dataset] : datasets) {
    dataset.end_shard();
    summary.emplace_back(kind, dataset.close());
  }
  if (alone > 0) summary.emplace_back("fingers_left_out", alone);
  return summary;
}

}  // namespace tacipc
