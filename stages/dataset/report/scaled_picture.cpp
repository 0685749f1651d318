#include "stages/dataset/report/scaled_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tacipc {

ByteImage fitted_picture(const ByteImage& image, int width, int height) {
  const double scale = std::min(static_cast<double>(width) / image.width, static_cast<double>(height) / image.height);
  ByteImage copy(std::max(1, static_cast<int>(std::lround(scale * image.width))),
                 std::max(1, static_cast<int>(std::lround(scale * image.height))), 3);
  const cv::Mat source(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat target(copy.height, copy.width, CV_8UC3, copy.pixels.data());
  cv::resize(source, target, target.size(), 0, 0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return copy;
}

}  // namespace tacipc
