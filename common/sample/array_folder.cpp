#include "common/sample/array_folder.h"

#include <fmt/core.h>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace fs = std::filesystem;

NpyField field_named(NpyField field, std::string_view name) {
  const std::size_t begin = field.file.find('<');
  field.file.replace(begin, field.file.find('>') + 1 - begin, name);
  return field;
}

ArrayFolder::ArrayFolder(fs::path folder, std::string stage, Extents known)
    : folder_(std::move(folder)), record_name_(std::move(stage) + ".yaml"), known_(std::move(known)) {
  const fs::path record = folder_ / record_name_;
  if (!fs::is_regular_file(record)) return;
  record_ = Record::from_file(record);
  const Record outputs = record_->section("outputs");
  for (const std::string& name : outputs.keys()) {
    if (auto hash = outputs.text(name)) vouched_.emplace(name, std::move(*hash));
  }
}

ArrayFolder ArrayFolder::finished(fs::path folder, std::string stage, Extents known) {
  if (!fs::exists(folder / (stage + ".yaml")))
    throw DataError("{}: has no {}.yaml, so the {} did not finish", folder.string(), stage, stage);
  return ArrayFolder(std::move(folder), std::move(stage), std::move(known));
}

bool ArrayFolder::has(const NpyField& field) const { return fs::is_regular_file(path(field)); }

NpyFrames& ArrayFolder::open(const NpyField& field) const {
  if (const auto found = open_.find(field.file); found != open_.end()) return found->second;
  refuse_changed(field);
  NpyFrames file(path(field));
  match_shape(field, file.shape(), path(field).string(), known_);
  refuse_no_frames(field);
  return open_.emplace(field.file, std::move(file)).first->second;
}

void ArrayFolder::refuse_changed(const NpyField& field) const {
  const auto vouched = vouched_.find(field.file);
  if (vouched == vouched_.end() || !has(field) || !unchanged_.insert(field.file).second) return;
  if (content_hash(path(field)) != vouched->second)
    throw DataError("{}: has changed since {} was written beside it", path(field).string(), record_name_);
}

void ArrayFolder::refuse_no_frames(const NpyField& field) const {
  const auto frames = known_.find(kFrames);
  if (frames != known_.end() && frames->second == 0) throw DataError("{}: has no frames", path(field).string());
}

std::size_t ArrayFolder::extent(const NpyField& field, std::string_view symbol) const {
  open(field);
  return known_.at(symbol);
}

std::vector<double> ArrayFolder::whole(const NpyField& field) const {
  refuse_changed(field);
  std::vector<double> values = read_field(field, path(field), known_).data;
  refuse_no_frames(field);
  return values;
}

std::vector<double> ArrayFolder::frame_of(const NpyField& field, std::size_t frame) const {
  NpyFrames& file = open(field);
  if (frame >= file.shape()[0])
    throw DataError("{}: has no frame {}, but {} frames", path(field).string(), frame, file.shape()[0]);
  NpyArray values{.shape = file.frame_shape(), .data = file.frame(frame)};
  check_finite(field, values, fmt::format("{}: frame {}", path(field).string(), frame));
  return std::move(values.data);
}

void ArrayWriter::write(const NpyField& field, const std::vector<double>& values) const {
  write_field(field, stage_.output((folder_ / field.file).generic_string()), extents_, values);
}

}  // namespace tacipc
