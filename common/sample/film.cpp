#include "common/sample/film.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/statistics.h"
#include "common/image/picture.h"
#include "common/stage/record.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr int kFilmGap = 4;                // gap between panels, pixels of the picture
constexpr std::uint8_t kFilmGapGrey = 24;  // grey of the gaps
constexpr double kShortest_s = 0.08, kWithoutTimes_s = 0.1;
constexpr int kMostShrinking = 64;

/// Checks that every frame of the press run is rendered.
/// \throw DataError otherwise
void require_all(const FilmedGel& gel, std::size_t frames) {
  const fs::path path = gel.render / "render.yaml";
  if (!fs::is_regular_file(path))
    throw DataError("{}: has no render.yaml, so no images are whole", gel.render.string());
  const Record record = Record::from_file(path);
  if (record.section("inputs").section("press").text("hash") != content_hash(gel.press))
    throw DataError("{}: its images are of another press than {}; render again", gel.render.string(),
                    gel.press.string());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    if (!fs::is_regular_file(frame_path(gel.render, frame, FrameFile::tactile)))
      throw DataError("{}: frame {} of 0 to {} is not there; a film needs all (frames: all of the render's file)",
                      gel.render.string(), frame, frames - 1);
  }
}

int even(int pixels) { return pixels + pixels % 2; }
int reduced_size(int pixels, int by) { return (pixels + by - 1) / by; }

}  // namespace

Film::Film(std::vector<FilmedGel> gels, std::size_t frames, Size most) : gels_(std::move(gels)), frames_(frames) {
  for (const FilmedGel& gel : gels_) require_all(gel, frames_);
  find_columns();
  find_sizes(most);
  find_deepest();
}

void Film::find_columns() {
  for (const FrameFile file : {FrameFile::tactile, FrameFile::marker, FrameFile::indentation}) {
    if (std::all_of(gels_.begin(), gels_.end(),
                    [&](const FilmedGel& gel) { return fs::is_regular_file(frame_path(gel.render, 0, file)); }))
      files_.push_back(file);
  }
}

void Film::find_sizes(Size most) {
  Size widest;
  for (const FilmedGel& gel : gels_) {
    const ByteImage first = read_png(frame_path(gel.render, 0, FrameFile::tactile), 3);
    cells_.push_back({first.width, first.height});
    widest.width = std::max(widest.width, first.width);
    widest.height += first.height;
  }
  const int columns = static_cast<int>(files_.size());
  for (;; ++shrink_) {
    size_ = {even(columns * (reduced_size(widest.width, shrink_) + kFilmGap) - kFilmGap), -kFilmGap};
    for (const Size& cell : cells_) size_.height += reduced_size(cell.height, shrink_) + kFilmGap;
    size_.height = even(size_.height);
    if (size_.width <= most.width && size_.height <= most.height) break;
    if (shrink_ == kMostShrinking)
      throw DataError("a film of {} rows of {} pictures does not fit {} x {} pixels", gels_.size(), columns, most.width,
                      most.height);
  }
}

void Film::find_deepest() {
  if (files_.back() != FrameFile::indentation) return;
  for (const FilmedGel& gel : gels_) {
    for (std::size_t frame = 0; frame < frames_; ++frame) {
      const FloatImage map =
          read_exr(frame_path(gel.render, frame, FrameFile::indentation), field_of(FrameFile::indentation).channels);
      for (const float value : map.pixels)
        if (value > deepest_m_) deepest_m_ = value;
    }
  }
}

std::vector<std::string> Film::columns() const {
  std::vector<std::string> names;
  for (const FrameFile file : files_) names.push_back(fs::path(field_of(file).file).stem());
  return names;
}

ByteImage Film::panel(const FilmedGel& gel, FrameFile file, std::size_t frame) const {
  const fs::path path = frame_path(gel.render, frame, file);
  if (!field_of(file).is_float()) return read_png(path, 3);
  return picture_of_scalar(read_exr(path, field_of(file).channels), 0.0, deepest_m_);
}

ByteImage Film::picture(std::size_t frame) const {
  ByteImage sheet(size_.width, size_.height, 3, kFilmGapGrey);
  int widest = 0, top = 0;
  for (const Size& cell : cells_) widest = std::max(widest, reduced_size(cell.width, shrink_));
  for (std::size_t g = 0; g < gels_.size(); ++g) {
    for (std::size_t column = 0; column < files_.size(); ++column) {
      const ByteImage image = panel(gels_[g], files_[column], frame);
      if (image.width != cells_[g].width || image.height != cells_[g].height)
        throw DataError("{}: has {} x {} pixels, the first image {} x {}",
                        frame_path(gels_[g].render, frame, files_[column]).string(), image.width, image.height,
                        cells_[g].width, cells_[g].height);
      paste(sheet, reduced(image, shrink_), static_cast<int>(column) * (widest + kFilmGap), top);
    }
    top += reduced_size(cells_[g].height, shrink_) + kFilmGap;
  }
  return sheet;
}

FilmTimes film_times(const std::vector<double>& times_s, std::size_t frames, double slower) {
  if (times_s.size() != frames || frames < 2)
    return {std::vector<double>(frames, kWithoutTimes_s * (slower > 0.0 ? slower : 1.0)), 0.0};
  FilmTimes out;
  for (std::size_t f = 1; f < frames; ++f) {
    out.seconds.push_back(times_s[f] - times_s[f - 1]);
    if (!(out.seconds.back() > 0.0))
      throw DataError("frame {} is at {:g} s, not later than the one before", f, times_s[f]);
  }
  const double median = upper_median(out.seconds);
  out.seconds.push_back(out.seconds.back());
  if (slower == 0.0) {
    slower = 1.0;
    for (int step = 0; median * slower < kShortest_s; ++step) slower *= step % 3 == 1 ? 2.5 : 2.0;
  }
  for (double& second : out.seconds) second *= slower;
  out.slower = slower;
  return out;
}

std::string pace_text(const FilmTimes& times) {
  if (times.slower == 0.0) return fmt::format("{:g} s a frame", times.seconds.front());
  if (times.slower == 1.0) return "at the motion's own pace";
  return fmt::format("{:g} times {} than the motion", times.slower < 1.0 ? 1.0 / times.slower : times.slower,
                     times.slower < 1.0 ? "faster" : "slower");
}

}  // namespace tacipc
