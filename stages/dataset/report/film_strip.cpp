#include "stages/dataset/report/film_strip.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "common/image/picture.h"

namespace tacipc {
namespace {

constexpr std::size_t kMostFrames = 40;
constexpr Film::Size kMostPixels{720, 480};

}  // namespace

bool has_all_frames(const std::filesystem::path& render, std::size_t frames) {
  if (frames < 3 || !std::filesystem::is_regular_file(render / "render.yaml")) return false;
  const std::vector<std::size_t> there = frames_in(render);
  return there.size() == frames && there.back() + 1 == frames;
}

FilmStrip film_strip(const std::vector<FilmedGel>& gels, const std::vector<double>& times_s) {
  const Film film(gels, times_s.size(), kMostPixels);
  const std::size_t count = std::min(kMostFrames, film.frames());
  const auto [width, height] = film.size();
  FilmStrip strip{ByteImage(width, height * static_cast<int>(count), 3), static_cast<int>(count), film.columns(),
                  film_times(times_s, film.frames(), 0.0)};
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t frame = (k * (film.frames() - 1) + (count - 1) / 2) / (count - 1);
    paste(strip.sheet, film.picture(frame), 0, height * static_cast<int>(k));
  }
  return strip;
}

std::string film_figure(const FilmStrip& strip, const std::string& file) {
  const double seconds = std::accumulate(strip.times.seconds.begin(), strip.times.seconds.end(), 0.0);
  const std::string columns = fmt::format("{}", fmt::join(strip.columns, ", "));
  return fmt::format(
      "<figure class=\"film\"><div role=\"img\" aria-label=\"moving picture: {0}\" style=\"aspect-ratio: {1} / {2}; "
      "background-image: url({3}); background-size: 100% {4}%; animation-duration: {5:.3f}s; "
      "animation-timing-function: steps({6}, jump-none)\"></div>\n<figcaption><b>The motion</b>: {0}; {7}, "
      "{6} of {8} frames</figcaption></figure>\n",
      columns, strip.sheet.width, strip.sheet.height / strip.frames, file, 100 * strip.frames, seconds, strip.frames,
      pace_text(strip.times), strip.times.seconds.size());
}

}  // namespace tacipc
