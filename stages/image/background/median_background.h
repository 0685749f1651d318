// Makes a photograph without contact from photographs with contacts at different positions.
#pragma once

#include <vector>

#include "common/benchmark/ball_labels.h"
#include "common/config/config.h"
#include "common/image/image.h"

namespace tacipc {

/// Configuration of the stage background.
struct BackgroundConfig {
  double contact_radii =
      0.0;  // a photograph counts at pixels farther from the contact's centre than this number of contact radii
  int least_photographs = 3;  // least number of photographs that must count at a pixel

  static BackgroundConfig read(ConfigReader& in);
};

/// The median image and its statistics.
struct MedianBackground {
  ByteImage image;
  int fewest = 0;  // least number of photographs that count at any pixel
  double mean = 0.0;
};

/// Median per pixel and channel over the photographs without contact there. For an even number it is the mean of the
/// two middle values, halves rounded up.
/// \throw DataError, naming the pixel, if fewer than least_photographs count there
/// \pre as many photographs as labels, all of one size
MedianBackground median_background(const std::vector<ByteImage>& photographs, const std::vector<BallLabel>& labels,
                                   const BackgroundConfig& config);

}  // namespace tacipc
