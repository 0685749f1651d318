#include "stages/dataset/repack/frame_files.h"

#include <fmt/core.h>

#include <vector>

#include "common/base/error.h"
#include "common/base/json.h"
#include "common/format/npy.h"
#include "common/image/image.h"

namespace tacipc {
namespace {

constexpr std::size_t kLargestInJson = 16;

/// A dataset of a sample and the name its files have.
struct FieldFile {
  std::string path;
  std::string name;   // "rgb", "sim.first_slip_s", "white.rgb"
  std::string group;  // of the JSON: "obs", "check"
  NumberType type = NumberType::f32;
  std::vector<std::size_t> shape = {};
  bool per_frame = true;

  std::vector<std::size_t> frame_shape() const {
    return per_frame ? std::vector<std::size_t>(shape.begin() + 1, shape.end()) : shape;
  }
  std::size_t numbers() const {
    std::size_t count = 1;
    for (const std::size_t extent : frame_shape()) count *= extent;
    return count;
  }
  bool is_image() const {
    const auto frame = frame_shape();
    return type == NumberType::u8 && (frame.size() == 2 || (frame.size() == 3 && frame[2] == 3));
  }
};

std::vector<FieldFile> field_files(const Hdf5Reader& shard, const std::string& sample) {
  std::vector<FieldFile> files;
  const auto add_group = [&](const std::string& group, const std::string& prefix, const std::string& json) {
    for (const std::string& name : shard.names(group)) {
      FieldFile file{.path = group + "/" + name, .name = prefix + name, .group = json};
      file.type = shard.type(file.path);
      file.shape = shard.shape(file.path);
      file.per_frame = shard.text_attribute(file.path, "shape").starts_with("(T");
      files.push_back(std::move(file));
    }
  };
  for (const std::string& section : shard.names(sample)) {
    const std::string group = sample + "/" + section;
    if (section != "variants") {
      add_group(group, section == "sim" || section == "series" ? section + "." : "", section);
      continue;
    }
    for (const std::string& variant : shard.names(group)) add_group(group + "/" + variant, variant + ".", "variants");
  }
  return files;
}

Value numbers_of(const FieldFile& file, const std::string& bytes) {
  const std::vector<double> values = from_bytes(file.type, bytes);
  const bool whole = file.type == NumberType::u8 || file.type == NumberType::i32;
  Value::List list;
  for (const double value : values) list.push_back(whole ? Value(static_cast<std::int64_t>(value)) : Value(value));
  return file.frame_shape().empty() ? list.front() : Value(std::move(list));
}

std::string picture(const FieldFile& file, const std::string& bytes) {
  const auto shape = file.frame_shape();
  ByteImage image(static_cast<int>(shape[1]), static_cast<int>(shape[0]), shape.size() == 3 ? 3 : 1);
  image.pixels.assign(bytes.begin(), bytes.end());
  return png_bytes(image, file.path);
}

/// Texts with line breaks are configuration files; they go apart.
bool is_file(const Value& value) {
  const auto* text = std::get_if<std::string>(&value.data());
  return text && text->find('\n') != std::string::npos;
}

}  // namespace

void write_frames(const Hdf5Reader& shard, const std::string& id, const TakeFile& take) {
  const std::string sample = "/data/" + id;
  const std::vector<FieldFile> files = field_files(shard, sample);
  Value::Map attributes;
  std::int64_t frames = 0;
  for (const auto& [name, value] : shard.attributes(sample)) {
    if (name == "n_frames") frames = std::get<std::int64_t>(value.data());
    if (!is_file(value)) {
      attributes.emplace_back(name, value);
      continue;
    }
    const std::string suffix = name.ends_with("_yaml") ? name.substr(0, name.size() - 5) + ".yaml" : name + ".txt";
    take(fmt::format("{}/frame_0000.{}", id, suffix), std::get<std::string>(value.data()));
  }
  for (std::size_t t = 0; t < static_cast<std::size_t>(frames); ++t) {
    const std::string begin = fmt::format("{}/frame_{:04}.", id, t);
    Value::Map small{{"id", id}, {"frame", t}};
    for (const FieldFile& file : files) {
      if (!file.per_frame && t > 0) continue;
      const std::string bytes = file.per_frame ? shard.read_frame(file.path, t) : shard.read(file.path);
      if (file.is_image()) {
        take(begin + file.name + ".png", picture(file, bytes));
      } else if (file.numbers() > kLargestInJson || !file.per_frame) {
        take(begin + file.name + ".npy", npy_bytes(file.frame_shape(), npy_type_of(file.type), bytes));
      } else {
        Value::Map::iterator at = small.begin();
        while (at != small.end() && at->first != file.group) ++at;
        if (at == small.end()) at = small.emplace(small.end(), file.group, Value());
        at->second.set(file.name, numbers_of(file, bytes));
      }
    }
    small.emplace_back("sample", attributes);
    take(begin + "json", to_json(small));
  }
}

std::string fields_json(const Hdf5Reader& shard) {
  Value::Map sensors, fields;
  for (const std::string& id : shard.names("/sensors")) sensors.emplace_back(id, shard.attributes("/sensors/" + id));
  for (const std::string& id : shard.names("/data")) {
    for (const FieldFile& file : field_files(shard, "/data/" + id)) {
      bool known = false;
      for (const auto& [name, lines] : fields) known = known || name == file.name;
      if (!known) fields.emplace_back(file.name, shard.attributes(file.path));
    }
  }
  return to_json(Value::Map{{"shard", shard.attributes("/")}, {"sensors", sensors}, {"fields", fields}});
}

}  // namespace tacipc
