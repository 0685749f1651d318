// The render folder: what the camera sees, one folder per frame. The only place that knows its names and codes.
// `render` writes all of it; `mpm` and `baseline` write some of the same files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/types.h"
#include "common/format/npy_field.h"
#include "common/image/image.h"
#include "common/sample/contact_state.h"
#include "common/sample/segment.h"
#include "common/stage/stage.h"

namespace tacipc {

enum class FrameFile {
  linear,
  basis,
  depth,
  normal,
  indentation,
  seen_indentation,
  traction,
  pressure,
  shear,
  tactile,
  marker,
  contact,
  stick_slip,
  segment,
  normal_picture,
  indentation_picture
};

/// What a dataset stores of an EXR's numbers. Rounded ones take a third of the room and time.
struct DatasetNumbers {
  int step_exponent = kExact;  // multiples of 2^this, in the unit of the field
  ExrNumbers type = ExrNumbers::floats;

  static constexpr int kExact = -1000;
  bool rounded() const { return step_exponent != kExact; }
};

struct ImageField {
  std::string file;                   // in the folder of a frame; `{:02}` stands for a number
  std::vector<std::string> channels;  // EXR: float; PNG: 8 bit, one or three
  std::string unit;
  std::string meaning;
  DatasetNumbers in_dataset = {};

  bool is_float() const { return file.ends_with(".exr"); }
};

/// Every image, in the order of the enum: the table that docs/files.md shows.
std::span<const ImageField> frame_fields();
const ImageField& field_of(FrameFile file);
/// (#M, 2): column and row of each marker; NaN where the image does not show it.
const NpyField& marker_px_field();

/// "frame_0005".
std::string frame_name(std::size_t frame);
/// "frame_0005/", with a variant "frame_0005/red/".
std::string frame_folder(std::size_t frame, const std::string& variant = {});
/// 5 of "frame_0005"; nothing of other names.
std::optional<std::size_t> frame_number(std::string_view folder_name);
/// Numbers of the frames that a folder has, ascending.
std::vector<std::size_t> frames_in(const std::filesystem::path& folder);

/// Where an image of a frame is.
std::filesystem::path frame_path(const std::filesystem::path& folder, std::size_t frame, FrameFile file);

enum class Digits { all, of_datasets };
/// Writes an image as an output of a stage. `in`: frame_folder(…); `number`: of a file that has one.
void write_frame(Stage& stage, const std::string& in, FrameFile file, const FloatImage& image, std::size_t number = 0,
                 Digits digits = Digits::all);
void write_frame(Stage& stage, const std::string& in, FrameFile file, const ByteImage& image);

/// Column and row in the image.
using MarkerPixels = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
void write_marker_px(Stage& stage, const std::string& in, const MarkerPixels& px);
MarkerPixels read_marker_px(const std::filesystem::path& path);

/// Codes of contact.png, stick_slip.png and segment.png: grey values far enough apart to be seen.
std::uint8_t contact_code(ContactState state);
std::uint8_t stick_slip_code(ContactState state);
std::uint8_t segment_code(Segment segment);
/// The way back. \throw DataError if no pixel has such a code
bool touches(double contact_code);
ContactState state_of(double stick_slip_code);
Segment segment_of(double segment_code);

}  // namespace tacipc
