#include "stages/image/track/find_dots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "common/base/statistics.h"

namespace tacipc {
namespace {

struct Spot {
  Eigen::Vector2d px;
  double diameter_px;
};

std::vector<Spot> spots(const FloatImage& light, const TrackConfig& config) {
  const cv::Mat image(light.height, light.width, CV_32F, const_cast<float*>(light.pixels.data()));
  const int reach = static_cast<int>(std::ceil(0.75 * config.most_diameter_px)) + 1;
  cv::Mat around;
  cv::morphologyEx(image, around, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  const cv::Mat dark = image < (1.0 - 0.5 * config.least_contrast) * around;
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(dark, labels, stats, centers, 8, CV_32S);
  std::vector<Spot> found;
  for (int i = 1; i < count; ++i) {
    const int left = stats.at<int>(i, cv::CC_STAT_LEFT), top = stats.at<int>(i, cv::CC_STAT_TOP);
    const int width = stats.at<int>(i, cv::CC_STAT_WIDTH), height = stats.at<int>(i, cv::CC_STAT_HEIGHT);
    const double diameter = 2.0 * std::sqrt(stats.at<int>(i, cv::CC_STAT_AREA) / std::numbers::pi);
    const bool cut = left == 0 || top == 0 || left + width == light.width || top + height == light.height;
    if (cut || diameter < config.least_diameter_px || diameter > config.most_diameter_px || width > 2 * height ||
        height > 2 * width)
      continue;
    found.push_back({{centers.at<double>(i, 0) + 0.5, centers.at<double>(i, 1) + 0.5}, diameter});
  }
  return found;
}

/// Sorts into rows from the top, each from the left. A row ends where the next dot lies farther below its mean than
/// half the median spacing.
void sort_for_reading(std::vector<DotCenter>& dots, double spacing_px) {
  const auto by_row = [](const DotCenter& a, const DotCenter& b) { return a.px.y() < b.px.y(); };
  const auto by_column = [](const DotCenter& a, const DotCenter& b) { return a.px.x() < b.px.x(); };
  std::ranges::sort(dots, by_row);
  for (auto row = dots.begin(); row != dots.end();) {
    auto end = row;
    double sum = 0.0;
    while (end != dots.end() && (end == row || end->px.y() - sum / static_cast<double>(end - row) < 0.5 * spacing_px)) {
      sum += end->px.y();
      ++end;
    }
    std::sort(row, end, by_column);
    row = end;
  }
}

}  // namespace

std::vector<double> spacings(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> nearest(points.size(), 1e9);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double d = (points[i] - points[j]).norm();
      nearest[i] = std::min(nearest[i], d);
      nearest[j] = std::min(nearest[j], d);
    }
  return nearest;
}

std::vector<DotCenter> find_dots(const FloatImage& light, const TrackConfig& config) {
  const std::vector<Spot> found = spots(light, config);
  std::vector<Eigen::Vector2d> places;
  for (const Spot& spot : found) places.push_back(spot.px);
  std::vector<double> nearest = spacings(places);
  std::vector<DotCenter> dots;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (const auto dot =
            dot_center(light, found[i].px, DotWindow::of(found[i].diameter_px, nearest[i]), config.least_contrast))
      dots.push_back(*dot);
  if (dots.empty()) return dots;
  sort_for_reading(dots, upper_median(std::move(nearest)));
  return dots;
}

}  // namespace tacipc
