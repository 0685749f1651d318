#include "stages/study/marker_fit/fit_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "common/base/error.h"
#include "common/base/statistics.h"

namespace tacipc {
namespace {

constexpr int kCandidates = 1000;

/// Value of least cost among evenly spaced ones from low to high, and whether it is the last.
template <typename Cost>
std::pair<double, bool> least(double low, double high, Cost&& cost) {
  int best = 0;
  double best_cost = cost(low);
  const auto value = [&](int i) { return low + (high - low) * i / kCandidates; };
  for (int i = 1; i <= kCandidates; ++i)
    if (const double c = cost(value(i)); c < best_cost) {
      best = i;
      best_cost = c;
    }
  return {value(best), best == kCandidates};
}

void remove_median(Eigen::Matrix2Xd& vectors) { vectors.colwise() -= median_of(vectors); }

/// Marker positions relative to the ball's axis, m.
Eigen::Matrix2Xd from_axis(const MarkerField& field, const MarkerAssumptions& assumed) {
  return (field.rest_px.colwise() - assumed.contact_px) / assumed.px_per_m;
}

}  // namespace

FieldErrors field_errors(const Eigen::Matrix2Xd& simulated, const Eigen::Matrix2Xd& measured, double least_length_px,
                         std::optional<Eigen::Index> left_out) {
  assert(simulated.cols() == measured.cols());
  FieldErrors errors;
  std::vector<double> distances;
  double simulated_sum = 0.0, measured_sum = 0.0;
  for (Eigen::Index i = 0; i < measured.cols(); ++i) {
    if (i == left_out) continue;
    const Eigen::Vector2d u = simulated.col(i), m = measured.col(i);
    distances.push_back((u - m).norm());
    simulated_sum += u.norm();
    measured_sum += m.norm();
    if (m.norm() < least_length_px) continue;
    ++errors.directions;
    errors.angle_deg += std::abs(std::atan2(m.x() * u.y() - m.y() * u.x(), m.dot(u))) * 180.0 / std::numbers::pi;
  }
  if (errors.directions > 0) errors.angle_deg /= errors.directions;
  std::ranges::sort(distances);
  const std::size_t n = distances.size();
  errors.markers = static_cast<int>(n);
  if (n == 0) return errors;
  for (const double d : distances) errors.mean_px += d / static_cast<double>(n);
  errors.median_px = median(distances);
  errors.max_px = distances.back();
  errors.ratio = measured_sum > 0.0 ? simulated_sum / measured_sum : 0.0;
  return errors;
}

MeasuredPressAndShear::MeasuredPressAndShear(MarkerField press_field, MarkerField shear_field,
                                             const MarkerBenchmark& benchmark)
    : press(std::move(press_field)), shear(std::move(shear_field)) {
  if (benchmark.remove_press_median) remove_median(press.moved_px);
  if (benchmark.remove_shear_median) remove_median(shear.moved_px);
  const double distance =
      (shear.rest_px.colwise() - benchmark.shear_marker_px).colwise().norm().minCoeff(&shear_marker);
  if (!(distance <= 1.0))
    throw DataError("fields.shear_marker_px: no marker rests within 1 px of ({:g}, {:g})",
                    benchmark.shear_marker_px.x(), benchmark.shear_marker_px.y());
}

FieldFit fit_field(const PressedRuns& runs, const MeasuredPressAndShear& measured, const MarkerAssumptions& assumed,
                   const MarkerBenchmark& benchmark, bool take_ends) {
  const Eigen::Matrix2Xd press_places = from_axis(measured.press, assumed);
  const Eigen::Matrix2Xd shear_places = from_axis(measured.shear, assumed);
  const auto pressed_px = [&](double depth_m) {
    Eigen::Matrix2Xd px = assumed.px_per_m * runs.pressed(press_places, depth_m).topRows<2>();
    if (benchmark.remove_press_median) remove_median(px);
    return px;
  };
  FieldFit fit;
  const auto sheared_px = [&](double way_m) {
    Eigen::Matrix2Xd px = assumed.px_per_m * runs.sheared(shear_places, fit.depth_m, way_m).topRows<2>();
    if (benchmark.remove_shear_median) remove_median(px);
    return px;
  };
  bool last = false;
  std::tie(fit.depth_m, last) = least(0.0, runs.deepest_m(), [&](double depth_m) {
    return (pressed_px(depth_m) - measured.press.moved_px).squaredNorm();
  });
  const bool shallower = fit.depth_m < runs.shallowest_m();
  if (take_ends && (last || shallower)) {
    fit.depth_end = last ? "the deepest" : "the shallowest";
    fit.depth_m = std::clamp(fit.depth_m, runs.shallowest_m(), runs.deepest_m());
  } else if (last) {
    throw DataError("the deepest press, {:g} mm, fits best: simulate deeper ones", 1e3 * fit.depth_m);
  } else if (shallower) {
    throw DataError("a press of {:g} mm fits best, but the shallowest one that is sheared has {:g} mm",
                    1e3 * fit.depth_m, 1e3 * runs.shallowest_m());
  }
  const Eigen::Index marker = measured.shear_marker;
  std::tie(fit.way_m, last) = least(0.0, runs.longest_way_m(), [&](double way_m) {
    return (sheared_px(way_m).col(marker) - measured.shear.moved_px.col(marker)).squaredNorm();
  });
  if (last) throw DataError("the longest shear, {:g} mm, fits best: simulate longer ones", 1e3 * fit.way_m);
  fit.press_px = pressed_px(fit.depth_m);
  fit.shear_px = sheared_px(fit.way_m);
  fit.way_missed_px = (fit.shear_px.col(marker) - measured.shear.moved_px.col(marker)).norm();
  fit.press = field_errors(fit.press_px, measured.press.moved_px, benchmark.least_length_px, std::nullopt);
  fit.shear = field_errors(fit.shear_px, measured.shear.moved_px, benchmark.least_length_px, marker);
  return fit;
}

}  // namespace tacipc
