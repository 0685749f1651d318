// Arrays of a folder that a stage wrote: read with all checks of their declarations, written as outputs of the stage.
// Each kind of folder declares its arrays in a unit of its own (press_folder, scene_folder, robot_folder).
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "common/format/npy_field.h"
#include "common/format/npy_pose.h"
#include "common/stage/record.h"
#include "common/stage/stage.h"

namespace tacipc {

/// Symbol of shapes: the frames of a folder.
inline constexpr std::string_view kFrames = "frames";

/// The declaration of one of several files of a kind: with `name` in place of the word in <>.
NpyField field_named(NpyField field, std::string_view name);

/// Adds the numbers of an item to those of an array, row-major.
inline void append_numbers(std::vector<double>& all, double number) { all.push_back(number); }
template <typename Code>
requires std::is_enum_v<Code>
void append_numbers(std::vector<double>& all, Code code) { all.push_back(static_cast<double>(code)); }
template <typename Derived>
void append_numbers(std::vector<double>& all, const Eigen::MatrixBase<Derived>& matrix) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) all.push_back(matrix(row, column));
  }
}
inline void append_numbers(std::vector<double>& all, const Wrench& wrench) {
  append_numbers(all, wrench.force_n), append_numbers(all, wrench.torque_n_m);
}
inline void append_numbers(std::vector<double>& all, const Twist& twist) {
  append_numbers(all, twist.velocity_m_s), append_numbers(all, twist.spin_rad_s);
}
template <typename Item>
void append_numbers(std::vector<double>& all, const std::vector<Item>& items) {
  for (const Item& item : items) append_numbers(all, item);
}
template <typename Item, std::size_t count>
void append_numbers(std::vector<double>& all, const std::array<Item, count>& items) {
  for (const Item& item : items) append_numbers(all, item);
}

/// Reads an item and moves `at` behind its numbers.
inline void take(const double*& at, double& number) { number = *at++; }
inline void take(const double*& at, Matrix4& pose) { pose = pose_of(at), at += 16; }
inline void take(const double*& at, Vector3& v) { v = {at[0], at[1], at[2]}, at += 3; }
inline void take(const double*& at, Twist& twist) { take(at, twist.velocity_m_s), take(at, twist.spin_rad_s); }
inline void take(const double*& at, Wrench& wrench) { take(at, wrench.force_n), take(at, wrench.torque_n_m); }
template <std::size_t count>
void take(const double*& at, std::array<double, count>& numbers) {
  for (double& number : numbers) take(at, number);
}

/// The items that the numbers of an array stand for, one after the other.
template <typename Item>
std::vector<Item> items_of(const std::vector<double>& numbers) {
  std::vector<Item> items;
  for (const double *at = numbers.data(), *end = at + numbers.size(); at != end;) take(at, items.emplace_back());
  return items;
}

/// Reads a folder, of each array only the values that are asked for. Every reader throws DataError if the file is
/// missing, its shape is not the declared one or does not fit the other arrays, a number that has to be finite is not,
/// or the file is not the one that the record beside it vouches for by its hash. Not for several threads at once.
class ArrayFolder {
 public:
  /// \param stage that wrote the folder; its record is <stage>.yaml
  /// \param known extents of symbols that the caller knows from elsewhere (the gel, the record)
  ArrayFolder(std::filesystem::path folder, std::string stage, Extents known = {});
  /// \throw DataError if there is no record, so the stage did not finish
  static ArrayFolder finished(std::filesystem::path folder, std::string stage, Extents known = {});

  const std::filesystem::path& folder() const { return folder_; }
  /// Summary of the record. \pre the stage finished
  Record summary() const { return record_->section("summary"); }
  /// Adds what symbols of shapes stand for. \pre they are not known yet
  void know(Extents extents) { known_.merge(extents); }
  std::filesystem::path path(const NpyField& field) const { return folder_ / field.file; }
  bool has(const NpyField& field) const;
  /// Checks the shape. Reads no values.
  void require(const NpyField& field) const { open(field); }
  /// Length that a symbol of this array's shape stands for.
  std::size_t extent(const NpyField& field, std::string_view symbol) const;
  /// All values, row-major.
  std::vector<double> whole(const NpyField& field) const;
  template <typename Item>
  std::vector<Item> items(const NpyField& field) const {
    return items_of<Item>(whole(field));
  }
  /// The values of one entry of the first axis.
  std::vector<double> frame_of(const NpyField& field, std::size_t frame) const;

 private:
  NpyFrames& open(const NpyField& field) const;
  void refuse_no_frames(const NpyField& field) const;
  void refuse_changed(const NpyField& field) const;

  std::filesystem::path folder_;
  std::string record_name_;
  std::optional<Record> record_;                   // none before the stage has finished
  mutable Extents known_;                          // grows with every array that is looked at
  mutable std::map<std::string, NpyFrames> open_;  // files that are read frame by frame
  std::map<std::string, std::string> vouched_;     // hashes of the record, as far as there is one
  mutable std::set<std::string> unchanged_;        // files that were compared with them
};

/// Writes arrays of a folder, as outputs of a stage. An array is an NpyField, or a code for which field_of() gives one.
class ArrayWriter {
 public:
  /// \param folder below --out
  ArrayWriter(Stage& stage, Extents extents, std::filesystem::path folder = {})
      : stage_(stage), extents_(std::move(extents)), folder_(std::move(folder)) {}

  void write(const NpyField& field, const std::vector<double>& values) const;
  template <typename Array>
  requires std::is_enum_v<Array>
  void write(Array array, const std::vector<double>& values) const { write(field_of(array), values); }
  /// `part` gives the item of this array that each of the frames has, or an entry of its first axis.
  template <typename Array, typename Frames, typename Part>
  void write(const Array& array, const Frames& frames, Part&& part) const {
    std::vector<double> values;
    for (const auto& frame : frames) append_numbers(values, std::invoke(part, frame));
    write(array, values);
  }

 private:
  Stage& stage_;
  Extents extents_;
  std::filesystem::path folder_;
};

}  // namespace tacipc
