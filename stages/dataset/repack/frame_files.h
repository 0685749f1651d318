// Sample of a shard as small files, for folders and WebDataset archives.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/format/hdf5_reader.h"

namespace tacipc {

/// Takes a file: the name of its frame ("frame_0003", or empty for the sample itself), its own name behind the first
/// dot ("rgb.png"), and its bytes.
using TakeFile = std::function<void(const std::string& of, const std::string& name, std::string_view bytes)>;

/// Files of one sample. Names are in lower case, as every reader of WebDatasets expects.
class SampleFiles {
 public:
  /// \throw DataError if two names differ only in case, a name cannot be a file name, or a field does not have as many
  /// frames as the sample
  SampleFiles(const Hdf5Reader& shard, const std::string& id);

  const std::string& id() const { return id_; }
  /// Kind of the sample. Samples of a kind have the same files in every frame, with the same JSON keys and types. Kinds
  /// are `<sensor>`, `<sensor>_free` with the velocities of an object that moves freely, and `<sensor>_grasp` with the
  /// additional data of grasp fingers.
  std::string kind() const;
  /// Files of a frame and keys of its JSON, with types and shapes.
  std::vector<std::string> form() const;

  /// Writes the files of each frame:
  /// - `<field>.png` for 8-bit images, `<field>.npy` for other fields of more than 16 numbers or with NaN; for `sim`
  /// and for variants `sim.<field>.…`, `<variant>.<field>.…`
  /// - `json` with the other fields and, under `sample`, the attributes that every sample of the kind has.
  void write_frames(const TakeFile& take) const;
  /// Writes the files of the sample: `json` with all its attributes, its configurations (`<name>.yaml`), and as
  /// `<section>.<field>.npy` the fields that are not per frame: series, parts of `sim`, and `ensemble`.
  void write_sample(const TakeFile& take) const;
  /// Adds the attributes of fields that `fields` lacks.
  void describe(Value::Map& fields) const;

 private:
  /// Dataset of a sample, and the name of its files.
  struct Field {
    std::string path;
    std::string key;    // "rgb", "sim.first_slip_s", "white.rgb"
    std::string group;  // group in the JSON: "obs", "check"
    NumberType type = NumberType::f32;
    std::vector<std::size_t> shape = {};  // shape of a frame; of the whole dataset if it is not per frame
    bool of_frames = true, has_nan = false;

    std::size_t numbers() const;
    bool is_image() const;
    bool is_small() const;
    std::string file() const;
    std::string form() const;
  };
  void add_group(const std::string& section, const std::string& group, const std::string& prefix);

  const Hdf5Reader& shard_;
  std::string id_, sample_;
  std::size_t frames_ = 0;
  std::vector<Field> fields_;
  Value::Map attributes_, of_all_;  // all attributes, and those that every sample of the kind has
  std::vector<std::pair<std::string, std::string>> texts_;  // configurations, by the names of their files
};

/// JSON needed to read the files: the attributes of the shard, of its sensors and of each field.
std::string fields_json(const Hdf5Reader& shard);

}  // namespace tacipc
