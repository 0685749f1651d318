// A sample of a shard as small files: what a folder and a WebDataset archive hold.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/format/hdf5_reader.h"

namespace tacipc {

/// Takes a file by the name of what it belongs to ("frame_0003", or nothing for the sample itself), its own name behind
/// the first dot ("rgb.png") and its bytes.
using TakeFile = std::function<void(const std::string& of, const std::string& name, std::string_view bytes)>;

/// Names are in lower case, as every reader of WebDatasets has them.
class SampleFiles {
 public:
  /// \throw DataError if two names differ in case alone, one cannot be a file's, or a field has not as many frames as
  /// the sample
  SampleFiles(const Hdf5Reader& shard, const std::string& id);

  const std::string& id() const { return id_; }
  /// Samples of a kind have the same files in every frame, with the same keys and types of JSON: `<sensor>`,
  /// `<sensor>_free` with the velocities of an object that moves freely, `<sensor>_grasp` with what fingers of grasps
  /// have besides.
  std::string kind() const;
  /// The files of a frame and the keys of its JSON, with types and shapes.
  std::vector<std::string> form() const;

  /// Files of each frame
  /// - `<field>.png` for images of codes, `<field>.npy` for other fields of more than 16 numbers or with NaN; of `sim`
  ///   and of variants `sim.<field>.…`, `<variant>.<field>.…`
  /// - `json` with the other fields and, under `sample`, the attributes that every sample of the kind has.
  void write_frames(const TakeFile& take) const;
  /// Files of the sample: `json` with all its attributes, the configurations that it was made with (`<name>.yaml`), and
  /// as
  /// `<section>.<field>.npy` the fields that are not of frames: series, parts of `sim`, and `ensemble`.
  void write_sample(const TakeFile& take) const;
  /// Adds the attributes of fields that `fields` does not have.
  void describe(Value::Map& fields) const;

 private:
  /// A dataset of a sample and the name its files have.
  struct Field {
    std::string path;
    std::string key;    // "rgb", "sim.first_slip_s", "white.rgb"
    std::string group;  // of the JSON: "obs", "check"
    NumberType type = NumberType::f32;
    std::vector<std::size_t> shape = {};  // of a frame; of all if it is not of frames
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
  Value::Map attributes_, of_all_;                          // all; those that every sample of the kind has
  std::vector<std::pair<std::string, std::string>> texts_;  // configurations, by the names of their files
};

/// What one needs to read the files: the attributes of the shard, of its sensors and of each field.
std::string fields_json(const Hdf5Reader& shard);

}  // namespace tacipc
