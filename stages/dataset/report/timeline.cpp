#include "stages/dataset/report/timeline.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/sample/render_folder.h"
#include "stages/dataset/report/sheet.h"

namespace tacipc {

Chart over_time(const std::vector<Instant>& frames, const std::string& what) {
  Chart chart;
  chart.what = what + " over time";
  chart.x_label = "time (s)";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    chart.x.push_back(frames[i].time_s);
    if (i == 0) continue;
    if (chart.bands.empty() || frames[i].phase != frames[i - 1].phase)
      chart.bands.push_back({frames[i].phase, frames[i - 1].time_s, frames[i].time_s});
    chart.bands.back().to = frames[i].time_s;
  }
  return chart;
}

ByteImage picture_strip(const std::vector<SceneGel>& gels, const std::vector<Instant>& frames) {
  constexpr std::size_t kMostPictures = 10;
  constexpr int kWidth = 160, kHeight = 120, kGap = 4, kLetters = 9, kHead = 36, kMargin = 52;
  constexpr Color kInk{27, 35, 48}, kQuiet{93, 104, 120};
  if (gels.empty()) throw DataError("no gel has images");
  const std::filesystem::path first = gels.front().folder / "render";
  std::vector<std::size_t> rendered;
  if (std::filesystem::is_directory(first)) {
    for (const std::size_t frame : frames_in(first))
      if (frame < frames.size()) rendered.push_back(frame);
  }
  if (rendered.empty()) throw DataError("{}: has no images", first.string());
  const std::size_t count = std::min(kMostPictures, rendered.size());
  const int columns = static_cast<int>(count), rows = static_cast<int>(gels.size());
  ByteImage sheet(kMargin + columns * (kWidth + kGap) - kGap, kHead + rows * (kHeight + kGap) - kGap, 3, 255);
  for (int row = 0; row < rows; ++row)
    draw_text(sheet, fitted({gels[static_cast<std::size_t>(row)].name, kLetters, kInk}, kMargin - 2 * kGap), kGap,
              kHead + row * (kHeight + kGap) + (kHeight + kLetters) / 2);
  for (int column = 0; column < columns; ++column) {
    const std::size_t k = static_cast<std::size_t>(column);
    const std::size_t frame = rendered[count == 1 ? 0 : (k * (rendered.size() - 1) + (count - 1) / 2) / (count - 1)];
    const int x = kMargin + column * (kWidth + kGap);
    draw_text(sheet, fitted({frames[frame].phase, kLetters, kInk}, kWidth), x, kLetters + 3);
    draw_text(sheet, {fmt::format("frame {}, {:.4g} s", frame, frames[frame].time_s), kLetters, kQuiet}, x,
              2 * kLetters + 10);
    for (int row = 0; row < rows; ++row) {
      const std::filesystem::path file =
          frame_path(gels[static_cast<std::size_t>(row)].folder / "render", frame, FrameFile::tactile);
      paste(sheet, fitted_picture(read_png(file, 3), kWidth, kHeight), x, kHead + row * (kHeight + kGap));
    }
  }
  return sheet;
}

}  // namespace tacipc
