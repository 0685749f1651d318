// Reads and writes the arrays of a folder that a stage produced. Reading checks every array against its declaration;
// writing registers each file as an output of the stage. Each kind of folder declares its arrays in a unit of its own
// (press_folder, scene_folder, robot_folder).
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

/// Symbol in array shapes: number of frames in the folder.
inline constexpr std::string_view kFrames = "frames";

/// Returns the declaration of one file of a family: `field` with `name` in place of the word in <>.
NpyField field_named(NpyField field, std::string_view name);

/// Appends the numbers of an item to those of an array, row-major.
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

/// Reads an item and moves `at` past its numbers.
inline void take(const double*& at, double& number) { number = *at++; }
inline void take(const double*& at, Matrix4& pose) { pose = pose_of(at), at += 16; }
inline void take(const double*& at, Vector3& v) { v = {at[0], at[1], at[2]}, at += 3; }
inline void take(const double*& at, Twist& twist) { take(at, twist.velocity_m_s), take(at, twist.spin_rad_s); }
inline void take(const double*& at, Wrench& wrench) { take(at, wrench.force_n), take(at, wrench.torque_n_m); }
template <std::size_t count>
void take(const double*& at, std::array<double, count>& numbers) {
  for (double& number : numbers) take(at, number);
}

/// Splits the numbers of an array into items.
template <typename Item>
std::vector<Item> items_of(const std::vector<double>& numbers) {
  std::vector<Item> items;
  for (const double *at = numbers.data(), *end = at + numbers.size(); at != end;) take(at, items.emplace_back());
  return items;
}

/// Reads arrays from a folder, and of each array only the requested values. Not thread-safe.
/// \throw DataError from every reader: if the file is missing, its shape differs from the declared one or does not fit
/// the other arrays, a number that must be finite is not, or its hash differs from the one in the record next to it
class ArrayFolder {
 public:
  /// \param stage name of the stage that wrote the folder; its record is <stage>.yaml
  /// \param known extents of shape symbols that are known from other sources (gel mesh, record)
  ArrayFolder(std::filesystem::path folder, std::string stage, Extents known = {});
  /// Opens the folder of a finished stage.
  /// \throw DataError if there is no record, so the stage did not finish
  static ArrayFolder finished(std::filesystem::path folder, std::string stage, Extents known = {});

  const std::filesystem::path& folder() const { return folder_; }
  /// Returns the summary of the record.
  /// \pre the stage finished
  Record summary() const { return record_->section("summary"); }
  /// Adds extents of shape symbols.
  /// \pre the symbols are not known yet
  void know(Extents extents) { known_.merge(extents); }
  /// Returns the path of an array's file.
  std::filesystem::path path(const NpyField& field) const { return folder_ / field.file; }
  /// Returns whether the array's file exists.
  bool has(const NpyField& field) const;
  /// Checks the shape without reading values.
  void require(const NpyField& field) const { open(field); }
  /// Returns the extent of a symbol in this array's shape.
  std::size_t extent(const NpyField& field, std::string_view symbol) const;
  /// Returns all values, row-major.
  std::vector<double> whole(const NpyField& field) const;
  /// Returns all values as items.
  template <typename Item>
  std::vector<Item> items(const NpyField& field) const {
    return items_of<Item>(whole(field));
  }
  /// Returns the values of one entry of the first axis.
  std::vector<double> frame_of(const NpyField& field, std::size_t frame) const;

 private:
  NpyFrames& open(const NpyField& field) const;
  void refuse_no_frames(const NpyField& field) const;
  void refuse_changed(const NpyField& field) const;

  std::filesystem::path folder_;
  std::string record_name_;
  std::optional<Record> record_;                   // empty until the stage has finished
  mutable Extents known_;                          // extents so far; every opened array adds to them
  mutable std::map<std::string, NpyFrames> open_;  // files being read frame by frame
  std::map<std::string, std::string> vouched_;     // hashes in the record; empty without one
  mutable std::set<std::string> unchanged_;        // files whose hash was found to match
};

/// Writes arrays of a folder as outputs of a stage. An array is an NpyField, or an enumerator that field_of() maps to
/// one.
class ArrayWriter {
 public:
  /// \param extents extents of the symbols in the arrays' shapes
  /// \param folder folder below --out
  ArrayWriter(Stage& stage, Extents extents, std::filesystem::path folder = {})
      : stage_(stage), extents_(std::move(extents)), folder_(std::move(folder)) {}

  /// Writes an array from its row-major values.
  void write(const NpyField& field, const std::vector<double>& values) const;
  template <typename Array>
  requires std::is_enum_v<Array>
  void write(Array array, const std::vector<double>& values) const { write(field_of(array), values); }
  /// Writes an array from a list of frames.
  /// \param part maps a frame to this array's entry of the first axis
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
