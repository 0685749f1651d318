// A photograph without contact from photographs with contacts at different places.
#pragma once

#include <vector>

#include "common/benchmark/ball_labels.h"
#include "common/config/config.h"
#include "common/image/image.h"

namespace tacipc {

struct BackgroundConfig {
  double contact_radii = 0.0;  // farther than so many radii from the contact's centre a photograph counts
  int least_photographs = 3;   // of those that count at a pixel; fewer give no median

  static BackgroundConfig read(ConfigReader& in);
};

struct MedianBackground {
  ByteImage image;
  int fewest = 0;  // photographs that count, at the pixel that has fewest
  double mean = 0.0;
};

/// Per pixel and channel the median over the photographs that show no contact there; of an even number the mean of the
/// two in the middle, halves up. \throw DataError, naming the pixel, if fewer than least_photographs count there
/// \pre as many photographs as labels, all of one size
MedianBackground median_background(const std::vector<ByteImage>& photographs, const std::vector<BallLabel>& labels,
                                   const BackgroundConfig& config);

}  // namespace tacipc
