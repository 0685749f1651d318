#include "stages/image/track/dot_center.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc {
namespace {

/// Light around a dot as a + b x + c y, x and y from its centre.
using Plane = Eigen::Vector3d;

/// Calls `visit(offset from centre, light)` for the image's pixels whose centres lie within `radius` of `center`.
template <typename Visit>
void for_pixels(const FloatImage& light, const Eigen::Vector2d& center, double radius, Visit&& visit) {
  const auto first = [](double at) { return static_cast<int>(std::ceil(at - 0.5)); };
  const auto last = [](double at) { return static_cast<int>(std::floor(at - 0.5)); };
  for (int y = std::max(0, first(center.y() - radius)); y <= std::min(light.height - 1, last(center.y() + radius)); ++y)
    for (int x = std::max(0, first(center.x() - radius)); x <= std::min(light.width - 1, last(center.x() + radius));
         ++x) {
      const Eigen::Vector2d offset = Eigen::Vector2d(x + 0.5, y + 0.5) - center;
      if (offset.squaredNorm() <= radius * radius) visit(offset, static_cast<double>(light.at(x, y, 0)));
    }
}

double on_plane(const Plane& plane, const Eigen::Vector2d& at) {
  return plane[0] + plane[1] * at.x() + plane[2] * at.y();
}

/// Least squares over the ring, repeated without pixels much darker than the previous plane, which belong to
/// neighbours.
std::optional<Plane> fit_ring(const FloatImage& light, const Eigen::Vector2d& center, const DotWindow& window) {
  constexpr int kMinPixels = 12;
  std::optional<Plane> plane;
  for (const double kept : {0.0, 0.8, 0.9, 0.9}) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    int count = 0;
    for_pixels(light, center, window.outside_px, [&](const Eigen::Vector2d& at, double value) {
      if (at.squaredNorm() <= window.inside_px * window.inside_px) return;
      if (plane && value < kept * on_plane(*plane, at)) return;
      const Eigen::Vector3d row(1.0, at.x(), at.y());
      normal += row * row.transpose();
      right += row * value;
      ++count;
    });
    if (count < kMinPixels) return std::nullopt;
    plane = normal.ldlt().solve(right);
  }
  return plane;
}

}  // namespace

double DotCenter::diameter_px() const { return 2.0 * std::sqrt(area_px / std::numbers::pi); }

DotWindow DotWindow::of(double diameter_px, double spacing_px) {
  DotWindow window{.inside_px = 0.65 * diameter_px + 1.5};
  window.inside_px = std::min(window.inside_px, std::max(0.5 * diameter_px, 0.5 * spacing_px - 1.0));
  window.outside_px = window.inside_px + std::max(2.0, 0.25 * diameter_px);
  return window;
}

std::optional<DotCenter> dot_center(const FloatImage& light, const Eigen::Vector2d& guess_px, const DotWindow& window,
                                    double least_contrast) {
  constexpr int kMaxRounds = 20;
  constexpr double kConvergedPx = 1e-3, kLargestSwingPx = 0.05, kNoCover = 0.03, kSureCover = 0.08;
  DotCenter dot{.px = guess_px};
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!(dot.px.minCoeff() >= window.inside_px) || dot.px.x() > light.width - window.inside_px ||
        dot.px.y() > light.height - window.inside_px)
      return std::nullopt;
    const auto around = fit_ring(light, dot.px, window);
    if (!around) return std::nullopt;
    const auto darkness = [&](const Eigen::Vector2d& at, double value) {
      const double b = on_plane(*around, at);
      return b > 0.0 ? 1.0 - value / b : 0.0;
    };
    double middle = 0.0;
    int count = 0;
    for_pixels(light, dot.px, std::max(1.0, 0.3 * window.inside_px), [&](const Eigen::Vector2d& at, double value) {
      middle += darkness(at, value);
      ++count;
    });
    dot.contrast = count > 0 ? middle / count : 0.0;
    if (!(dot.contrast >= least_contrast)) return std::nullopt;
    double area = 0.0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    for_pixels(light, dot.px, window.inside_px, [&](const Eigen::Vector2d& at, double value) {
      const double c = std::clamp(darkness(at, value) / dot.contrast, 0.0, 1.0);
      const double covered = c * std::clamp((c - kNoCover) / (kSureCover - kNoCover), 0.0, 1.0);
      area += covered;
      moment += covered * at;
    });
    if (!(area > 0.0)) return std::nullopt;
    dot.area_px = area;
    const Eigen::Vector2d shift = moment / area;
    dot.px += shift;
    if (shift.norm() < kConvergedPx) return dot;
    // Pixels that enter the window at one position and leave it at the next can make the centre oscillate between both.
    if (round + 1 == kMaxRounds && shift.norm() < kLargestSwingPx) {
      dot.px -= 0.5 * shift;
      return dot;
    }
  }
  return std::nullopt;
}

}  // namespace tacipc
