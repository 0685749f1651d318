// The render folder: images of the camera, one folder per frame. The only unit that declares its names and codes.
// `render` writes all files; `mpm` and `baseline` write some of them.
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

/// Images of a frame; field_of() gives file, channels, unit and meaning.
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

/// Precision with which a dataset stores an EXR's numbers. Rounded numbers take a third of the space and time.
struct DatasetNumbers {
  int step_exponent = kExact;  // numbers are multiples of 2^step_exponent, in the unit of the field
  ExrNumbers type = ExrNumbers::floats;

  static constexpr int kExact = -1000;
  bool rounded() const { return step_exponent != kExact; }
};

/// Declaration of an image.
struct ImageField {
  std::string file;                   // name in the folder of a frame; `{:02}` stands for a number
  std::vector<std::string> channels;  // EXR: float; PNG: 8 bit, one or three channels
  std::string unit;
  std::string meaning;
  DatasetNumbers in_dataset = {};

  bool is_float() const { return file.ends_with(".exr"); }
};

/// Returns the declarations of all images in the order of the enum: the table of docs/files.md.
std::span<const ImageField> frame_fields();
/// Returns the declaration of an image.
const ImageField& field_of(FrameFile file);
/// Returns the declaration of the markers' positions, (#M, 2): column and row; NaN if the image does not show the
/// marker.
const NpyField& marker_px_field();

/// Returns the name of a frame's folder: "frame_0005".
std::string frame_name(std::size_t frame);
/// Returns a frame's folder with a slash: "frame_0005/", or with a variant "frame_0005/red/".
std::string frame_folder(std::size_t frame, const std::string& variant = {});
/// Returns the number in a folder name: 5 for "frame_0005"; nothing for other names.
std::optional<std::size_t> frame_number(std::string_view folder_name);
/// Returns the numbers of the frames in a folder, ascending.
std::vector<std::size_t> frames_in(const std::filesystem::path& folder);

/// Returns the path of an image of a frame.
std::filesystem::path frame_path(const std::filesystem::path& folder, std::size_t frame, FrameFile file);

/// Precision of an EXR's numbers: all digits, or as datasets store them (ImageField::in_dataset).
enum class Digits { all, of_datasets };
/// Writes an image as an output of a stage.
/// \param in frame_folder(…)
/// \param number number in the file's name, if it has one
void write_frame(Stage& stage, const std::string& in, FrameFile file, const FloatImage& image, std::size_t number = 0,
                 Digits digits = Digits::all);
void write_frame(Stage& stage, const std::string& in, FrameFile file, const ByteImage& image);

/// Column and row of each marker in the image.
using MarkerPixels = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
void write_marker_px(Stage& stage, const std::string& in, const MarkerPixels& px);
MarkerPixels read_marker_px(const std::filesystem::path& path);

/// Return the grey levels of contact.png, stick_slip.png and segment.png, far enough apart to differ visibly.
std::uint8_t contact_code(ContactState state);
std::uint8_t stick_slip_code(ContactState state);
std::uint8_t segment_code(Segment segment);
/// Convert grey levels back.
/// \throw DataError if the level has no meaning
bool touches(double contact_code);
ContactState state_of(double stick_slip_code);
Segment segment_of(double segment_code);

}  // namespace tacipc
