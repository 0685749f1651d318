#include "common/sample/render_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/base/error.h"
#include "common/base/parse.h"
#include "common/base/rounding.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kFrameBegin = "frame_";
/// Rounding in datasets: 0.03 µm of lengths keeps slopes of a height map, by differences of pixels 23 µm apart, right
/// to 0.1 %. Normals are rounded to 0.014°, traction to 16 Pa. Traction exceeds the range of a half.
constexpr DatasetNumbers kLength{.step_exponent = -25}, kTraction{.step_exponent = 4},
    kDirection{.step_exponent = -12, .type = ExrNumbers::halves};

constexpr int kTouches = 255, kPerState = 127, kPerSegment = 60;

template <typename Names>
std::string codes_text(const Names& names, int step) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += fmt::format("{}{} {}", k > 0 ? ", " : "", step * static_cast<int>(k), names[k]);
  return text;
}

const std::array<ImageField, 16>& all_images() {
  // Names of EXR channels that OpenCV reads: one Y, or R G B. It silently reads others as zeros, or as one channel.
  static const std::vector<std::string> kRgb{"R", "G", "B"}, kGrey{"grey"};
  static const std::array<ImageField, 16> kFields{{
      {"linear.exr", kRgb, "relative", "radiance before noise transfer, linear sRGB primaries"},
      {"basis_{:02}.exr", kRgb, "relative",
       "radiance of one light group alone in white, where the configuration asks for it"},
      {"depth.exr", {"Y"}, "m", "from the camera along its axis", kLength},
      {"normal.exr", kRgb, "1", "outward unit normal of the front, frame S: x, y, z in R, G, B", kDirection},
      {"indentation.exr",
       {"Y"},
       "m",
       "undeformed minus deformed height of the visible gel point, > 0 into the gel",
       kLength},
      {"seen_indentation.exr",
       {"Y"},
       "m",
       "indentation at each pixel's first hit: for `--shapes` of render, shade and calibrate (mpm alone)"},
      {"traction.exr", kRgb, "Pa",
       "normal plus friction force on the gel per deformed area, frame S: x, y, z in R, G, B", kTraction},
      {"pressure.exr",
       {"Y"},
       "Pa",
       "its part against the outward normal n of the front, −n · t; this and the next only where the press has stress, "
       "or "
       "a dataset wants them",
       kTraction},
      {"shear.exr", kRgb, "Pa", "its part along the front, t + pressure n, frame S: x, y, z in R, G, B", kTraction},
      {"tactile.png", kRgb, "code", "after noise transfer: what a user loads"},
      {"marker.png", kRgb, "code", "the same with printed markers, where the sensor has any"},
      {"contact.png", kGrey, "code", fmt::format("{} where the object touches, else 0", kTouches)},
      {"stick_slip.png", kGrey, "code", codes_text(kContactStateNames, kPerState)},
      {"segment.png", kGrey, "code", codes_text(kSegmentNames, kPerSegment)},
      {"normal.png", kRgb, "code", "preview of `normal.exr`"},
      {"indentation.png", kRgb, "code", "preview of `indentation.exr`"},
  }};
  return kFields;
}

/// Returns which multiple of `step`, below `count`, a code is.
int multiple_of(double code, int step, std::size_t count, FrameFile file) {
  const int k = static_cast<int>(code) / step;
  if (static_cast<double>(k * step) != code || k < 0 || static_cast<std::size_t>(k) >= count)
    throw DataError("{}: {} is not one of its codes", field_of(file).file, code);
  return k;
}

}  // namespace

std::span<const ImageField> frame_fields() { return all_images(); }

const ImageField& field_of(FrameFile file) { return all_images()[static_cast<std::size_t>(file)]; }

const NpyField& marker_px_field() {
  static const NpyField kField{.file = "marker_px.npy",
                               .type = NpyType::f8,
                               .shape = {"#M", 2},
                               .unit = "px",
                               .meaning =
                                   "column and row of each marker; pixel (0, 0) spans 0 … 1; NaN where it is "
                                   "not seen",
                               .finite = false};
  return kField;
}

std::string frame_name(std::size_t frame) { return fmt::format("{}{:04}", kFrameBegin, frame); }

std::string frame_folder(std::size_t frame, const std::string& variant) {
  return frame_name(frame) + "/" + (variant.empty() ? "" : variant + "/");
}

std::optional<std::size_t> frame_number(std::string_view name) {
  if (!name.starts_with(kFrameBegin)) return std::nullopt;
  name.remove_prefix(kFrameBegin.size());
  return parse_number<std::size_t>(name);
}

std::vector<std::size_t> frames_in(const fs::path& folder) {
  std::vector<std::size_t> frames;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto frame = frame_number(entry.path().filename().string()); frame && entry.is_directory())
      frames.push_back(*frame);
  std::sort(frames.begin(), frames.end());
  return frames;
}

fs::path frame_path(const fs::path& folder, std::size_t frame, FrameFile file) {
  return folder / (frame_folder(frame) + field_of(file).file);
}

void write_frame(Stage& stage, const std::string& in, FrameFile file, const FloatImage& image, std::size_t number,
                 Digits digits) {
  const ImageField& field = field_of(file);
  const std::filesystem::path path = stage.output(in + fmt::format(fmt::runtime(field.file), number));
  if (digits == Digits::all || !field.in_dataset.rounded()) {
    write_exr(path, image, field.channels);
    return;
  }
  FloatImage rounded = image;
  round_to(rounded.pixels, field.in_dataset.step_exponent);
  write_exr(path, rounded, field.channels, field.in_dataset.type);
}

void write_frame(Stage& stage, const std::string& in, FrameFile file, const ByteImage& image) {
  write_png(stage.output(in + field_of(file).file), image);
}

void write_marker_px(Stage& stage, const std::string& in, const MarkerPixels& px) {
  const NpyField& field = marker_px_field();
  write_field(field, stage.output(in + field.file), {{"#M", static_cast<std::size_t>(px.rows())}},
              {px.data(), px.data() + px.size()});
}

MarkerPixels read_marker_px(const fs::path& path) {
  Extents known;
  const NpyArray array = read_field(marker_px_field(), path, known);
  return Eigen::Map<const MarkerPixels>(array.data.data(), static_cast<Eigen::Index>(array.shape[0]), 2);
}

std::uint8_t contact_code(ContactState state) {
  return static_cast<std::uint8_t>(state == ContactState::none ? 0 : kTouches);
}

std::uint8_t stick_slip_code(ContactState state) {
  return static_cast<std::uint8_t>(kPerState * static_cast<int>(state));
}

std::uint8_t segment_code(Segment segment) {
  return static_cast<std::uint8_t>(kPerSegment * static_cast<int>(segment));
}

bool touches(double code) { return multiple_of(code, kTouches, 2, FrameFile::contact) > 0; }

ContactState state_of(double code) {
  return static_cast<ContactState>(multiple_of(code, kPerState, kContactStateNames.size(), FrameFile::stick_slip));
}

Segment segment_of(double code) {
  return static_cast<Segment>(multiple_of(code, kPerSegment, kSegmentNames.size(), FrameFile::segment));
}

}  // namespace tacipc
