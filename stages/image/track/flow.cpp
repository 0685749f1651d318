#include "stages/image/track/flow.h"

#include <opencv2/video/tracking.hpp>

namespace tacipc {
namespace {

/// Mean over the channels, rounded.
cv::Mat grey(const ByteImage& image) {
  cv::Mat out(image.height, image.width, CV_8U);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      int sum = 0;
      for (int c = 0; c < image.channels; ++c) sum += image.at(x, y, c);
      out.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((sum + image.channels / 2) / image.channels);
    }
  return out;
}

}  // namespace

std::vector<std::optional<Eigen::Vector2d>> flow(const ByteImage& from, const ByteImage& to,
                                                 const std::vector<Eigen::Vector2d>& points, double spacing_px,
                                                 const TrackConfig& config) {
  std::vector<std::optional<Eigen::Vector2d>> out(points.size());
  if (points.empty()) return out;
  cv::setNumThreads(1);  // OpenCV must not exceed --threads, and these images are small
  // OpenCV counts from pixel centres, TacIPC from the image's corner.
  std::vector<cv::Point2f> start, there, back;
  for (const Eigen::Vector2d& p : points)
    start.emplace_back(static_cast<float>(p.x() - 0.5), static_cast<float>(p.y() - 0.5));
  const cv::Mat first = grey(from), second = grey(to);
  constexpr double kMinSpacingPx = 5.0;
  int levels = 0;
  while (levels < config.flow_levels && spacing_px >= kMinSpacingPx * static_cast<double>(2 << levels)) ++levels;
  const cv::Size window(config.flow_window_px, config.flow_window_px);
  std::vector<std::uint8_t> found, returned;
  std::vector<float> unused;
  cv::calcOpticalFlowPyrLK(first, second, start, there, found, unused, window, levels);
  cv::calcOpticalFlowPyrLK(second, first, there, back, returned, unused, window, levels);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d at(there[i].x + 0.5, there[i].y + 0.5);
    const double missed = std::hypot(back[i].x - start[i].x, back[i].y - start[i].y);
    const bool inside = at.minCoeff() >= 0.0 && at.x() <= to.width && at.y() <= to.height;
    if (found[i] && returned[i] && inside && missed <= config.most_return_px) out[i] = at;
  }
  return out;
}

}  // namespace tacipc
