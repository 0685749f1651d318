#include "stages/dataset/repack/frame_files.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "common/base/error.h"
#include "common/base/file_name.h"
#include "common/base/json.h"
#include "common/format/npy.h"
#include "common/image/image.h"

namespace tacipc {
namespace {

constexpr std::size_t kLargestInJson = 16;

/// Attributes that depend on the course of a sample, not on its kind.
constexpr const char* kSometimes[] = {"reason", "first_slip_s", "gross_slip_s", "friction_margin", "width_mm"};

bool every_sample_has(const std::string& attribute) {
  return !attribute.starts_with("limit_") && !attribute.starts_with("absent_") &&
         std::ranges::find(kSometimes, attribute) == std::end(kSometimes);
}

/// File name of an attribute that is a configuration; empty for other attributes.
std::string configuration_file(const std::string& attribute) {
  for (const std::string ending : {"yaml", "csv"})
    if (attribute.ends_with("_" + ending))
      return attribute.substr(0, attribute.size() - ending.size() - 1) + "." + ending;
  return "";
}

std::string lower(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// Type such as "real", "text", "3 of real".
std::string type_of(const Value& value) {
  if (std::holds_alternative<bool>(value.data())) return "bool";
  if (std::holds_alternative<std::int64_t>(value.data())) return "whole";
  if (std::holds_alternative<double>(value.data())) return "real";
  if (std::holds_alternative<std::string>(value.data())) return "text";
  if (const auto* list = std::get_if<Value::List>(&value.data()))
    return fmt::format("{} of {}", list->size(), list->empty() ? "nothing" : type_of(list->front()));
  return "map";
}

Value numbers_of(NumberType type, const std::vector<std::size_t>& shape, const std::string& bytes) {
  const std::vector<double> values = from_bytes(type, bytes);
  const bool whole = type == NumberType::u8 || type == NumberType::i32;
  Value::List list;
  for (const double value : values) {
    if (whole)
      list.emplace_back(static_cast<std::int64_t>(value));
    else
      list.emplace_back(value);
  }
  return shape.empty() ? list.front() : Value(std::move(list));
}

std::string picture(const std::string& path, const std::vector<std::size_t>& shape, const std::string& bytes) {
  ByteImage image(static_cast<int>(shape[1]), static_cast<int>(shape[0]), shape.size() == 3 ? 3 : 1);
  image.pixels.assign(bytes.begin(), bytes.end());
  return png_bytes(image, path);
}

Value& section_of(Value::Map& map, const std::string& name) {
  const auto at = std::ranges::find(map, name, &Value::Map::value_type::first);
  return at != map.end() ? at->second : map.emplace_back(name, Value()).second;
}

}  // namespace

std::size_t SampleFiles::Field::numbers() const {
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  return count;
}

bool SampleFiles::Field::is_image() const {
  return of_frames && type == NumberType::u8 && (shape.size() == 2 || (shape.size() == 3 && shape[2] == 3));
}

bool SampleFiles::Field::is_small() const {
  return of_frames && !is_image() && !has_nan && numbers() <= kLargestInJson;
}

std::string SampleFiles::Field::file() const { return lower(key) + (is_image() ? ".png" : ".npy"); }

std::string SampleFiles::Field::form() const {
  const std::string begin = is_small() ? fmt::format("json: {}.{}", group, key) : file();
  return fmt::format("{} {} ({})", begin, name_of(type), fmt::join(shape, ", "));
}

void SampleFiles::add_group(const std::string& section, const std::string& group, const std::string& prefix) {
  for (const std::string& name : shard_.names(group)) {
    Field field{.path = fmt::format("{}/{}", group, name), .key = prefix + name, .group = section};
    field.type = shard_.type(field.path);
    field.shape = shard_.shape(field.path);
    field.of_frames = section != "ensemble" && shard_.text_attribute(field.path, "shape").starts_with("(T");
    if (field.of_frames) {
      if (field.shape.empty() || field.shape[0] != frames_)
        throw DataError("{}: {}: is of {} frames, its sample of {}", shard_.name(), field.path,
                        field.shape.empty() ? 0 : field.shape[0], frames_);
      field.shape.erase(field.shape.begin());
      if (field.is_image() && field.numbers() == 0)
        throw DataError("{}: {}: has images without pixels", shard_.name(), field.path);
    }
    for (const auto& [key, value] : shard_.attributes(field.path)) field.has_nan = field.has_nan || key == "nan";
    fields_.push_back(std::move(field));
  }
}

SampleFiles::SampleFiles(const Hdf5Reader& shard, const std::string& id)
    : shard_(shard), id_(id), sample_("/data/" + id), frames_(shard.count_attribute(sample_, "n_frames")) {
  std::set<std::string> files;
  for (const auto& [name, value] : shard.attributes(sample_)) {
    if (const std::string file = configuration_file(name); !file.empty()) {
      texts_.emplace_back(lower(require_file_name(file, fmt::format("{}: {}: an attribute", shard.name(), sample_))),
                          shard.text_attribute(sample_, name));
      if (!files.insert(texts_.back().first).second)
        throw DataError("{}: {}: two attributes differ in case alone: {}", shard.name(), sample_, file);
      continue;
    }
    attributes_.emplace_back(name, value);
    if (every_sample_has(name)) of_all_.emplace_back(name, value);
  }
  for (const std::string& section : shard.names(sample_)) {
    const std::string group = fmt::format("{}/{}", sample_, section);
    if (section != "variants") {
      add_group(section, group, section == "obs" || section == "check" ? "" : section + ".");
      continue;
    }
    for (const std::string& variant : shard.names(group))
      add_group(section, fmt::format("{}/{}", group, variant), variant + ".");
  }
  if (frames_ > 0 && std::ranges::none_of(fields_, &Field::of_frames))
    throw DataError("{}: {}: has {} frames and no field of frames", shard.name(), sample_, frames_);
  for (const Field& field : fields_)
    if (!field.is_small() && !files.insert(field.file()).second)
      throw DataError("{}: two fields differ in case alone: {}", id, field.file());
}

std::string SampleFiles::kind() const {
  const std::string sensor = shard_.name_attribute(sample_, "sensor_id");
  if (shard_.has(sample_ + "/series")) return sensor + "_grasp";
  const bool free = shard_.has(sample_ + "/obs/object_velocity_mm_s") || shard_.has(sample_ + "/obs/object_spin_rad_s");
  return sensor + (free ? "_free" : "");
}

std::vector<std::string> SampleFiles::form() const {
  std::vector<std::string> form;
  for (const Field& field : fields_)
    if (field.of_frames) form.push_back(field.form());
  for (const auto& [name, value] : of_all_) form.push_back(fmt::format("json: sample.{} {}", name, type_of(value)));
  std::ranges::sort(form);
  return form;
}

void SampleFiles::write_frames(const TakeFile& take) const {
  for (std::size_t t = 0; t < frames_; ++t) {
    const std::string frame = fmt::format("frame_{:04}", t);
    Value::Map json{{"id", id_}, {"frame", t}};
    for (const Field& field : fields_) {
      if (!field.of_frames) continue;
      const std::string bytes = shard_.read_frame(field.path, t);
      if (field.is_image())
        take(frame, field.file(), picture(field.path, field.shape, bytes));
      else if (!field.is_small())
        take(frame, field.file(), npy_bytes(field.shape, npy_type_of(field.type), bytes));
      else
        section_of(json, field.group).set(field.key, numbers_of(field.type, field.shape, bytes));
    }
    json.emplace_back("sample", of_all_);
    take(frame, "json", to_json(json));
  }
}

void SampleFiles::write_sample(const TakeFile& take) const {
  for (const auto& [name, text] : texts_) take("", name, text);
  for (const Field& field : fields_)
    if (!field.of_frames)
      take("", field.file(), npy_bytes(field.shape, npy_type_of(field.type), shard_.read(field.path)));
  take("", "json", to_json(Value::Map{{"id", id_}, {"frames", frames_}, {"sample", attributes_}}));
}

void SampleFiles::describe(Value::Map& fields) const {
  for (const Field& field : fields_)
    if (std::ranges::find(fields, field.key, &Value::Map::value_type::first) == fields.end())
      fields.emplace_back(field.key, shard_.attributes(field.path));
}

std::string fields_json(const Hdf5Reader& shard) {
  Value::Map sensors, fields;
  for (const std::string& id : shard.names("/sensors")) sensors.emplace_back(id, shard.attributes("/sensors/" + id));
  for (const std::string& id : shard.names("/data")) SampleFiles(shard, id).describe(fields);
  return to_json(Value::Map{{"shard", shard.attributes("/")}, {"sensors", sensors}, {"fields", fields}});
}

}  // namespace tacipc
