#include "stages/image/background/median_background.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/error.h"
#include "common/base/statistics.h"

namespace tacipc {

BackgroundConfig BackgroundConfig::read(ConfigReader& in) {
  BackgroundConfig config;
  config.contact_radii = in.number("contact_radii", Range::positive());
  config.least_photographs = in.integer_or("least_photographs", config.least_photographs, 1, 1000000);
  return config;
}

MedianBackground median_background(const std::vector<ByteImage>& photographs, const std::vector<BallLabel>& labels,
                                   const BackgroundConfig& config) {
  assert(photographs.size() == labels.size() && !photographs.empty());
  const ByteImage& first = photographs.front();
  MedianBackground out{.image = ByteImage(first.width, first.height, first.channels),
                       .fewest = static_cast<int>(photographs.size()),
                       .mean = 0.0};
  std::vector<std::size_t> free;
  std::vector<int> codes;
  for (int y = 0; y < first.height; ++y) {
    for (int x = 0; x < first.width; ++x) {
      free.clear();
      for (std::size_t i = 0; i < labels.size(); ++i)
        if (std::hypot(x - labels[i].x_px, y - labels[i].y_px) > config.contact_radii * labels[i].radius_px)
          free.push_back(i);
      const auto count = static_cast<int>(free.size());
      if (count < config.least_photographs)
        throw DataError(
            "pixel ({}, {}): only {} of {} photographs show no contact within {} radii there, {} are needed", x, y,
            count, labels.size(), config.contact_radii, config.least_photographs);
      out.fewest = std::min(out.fewest, count);
      out.mean += count;
      for (int c = 0; c < first.channels; ++c) {
        codes.clear();
        for (const std::size_t i : free) codes.push_back(photographs[i].at(x, y, c));
        out.image.at(x, y, c) = static_cast<std::uint8_t>(median(codes) + 0.5);
      }
    }
  }
  out.mean /= static_cast<double>(first.width) * first.height;
  return out;
}

}  // namespace tacipc
