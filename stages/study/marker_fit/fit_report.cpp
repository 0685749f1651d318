#include "stages/study/marker_fit/fit_report.h"

#include <fmt/format.h>

#include "tacipc_marker_fit_texts.h"

namespace tacipc {
namespace {

std::string cells(const FieldErrors& e) {
  return fmt::format("{:.2f} | {:.2f} | {:.1f} | {} | {:.2f} |", e.mean_px, e.median_px, e.max_px,
                     e.directions > 0 && e.ratio > 0.0 ? fmt::format("{:.0f}°", e.angle_deg) : "", e.ratio);
}

}  // namespace

std::string fit_table(const std::vector<FitRow>& rows, const MeasuredPressAndShear& measured,
                      const MarkerBenchmark& benchmark) {
  const FieldFit& first = rows.front().fit.value();
  const auto errors = [&](const Eigen::Matrix2Xd& press, const Eigen::Matrix2Xd& press_truth,
                          const Eigen::Matrix2Xd& shear, const Eigen::Matrix2Xd& shear_truth) {
    return fmt::format("{} {}", cells(field_errors(press, press_truth, benchmark.least_length_px, std::nullopt)),
                       cells(field_errors(shear, shear_truth, benchmark.least_length_px, measured.shear_marker)));
  };
  std::string fits;
  for (const FitRow& row : rows) {
    if (row.fit) {
      constexpr double kMatchedPx = 0.5;  // accuracy of the measurement
      const std::string missed = row.fit->way_missed_px > kMatchedPx
                                     ? fmt::format(" (its marker off by {:.1f} px)", row.fit->way_missed_px)
                                     : "";
      fits += fmt::format("| {} | {:.2f}{} | {:.2f}{} | {} {}\n", row.name, 1e3 * row.fit->depth_m,
                          row.fit->depth_end.empty() ? "" : " (" + row.fit->depth_end + ")", 1e3 * row.fit->way_m,
                          missed, cells(row.fit->press), cells(row.fit->shear));
    } else {
      fits += fmt::format("| {} | | | {} |\n", row.name, row.no_fit);
    }
  }
  const Eigen::Matrix2Xd none_press = Eigen::Matrix2Xd::Zero(2, first.press_px.cols());
  const Eigen::Matrix2Xd none_shear = Eigen::Matrix2Xd::Zero(2, first.shear_px.cols());
  const auto rounded = [](const Eigen::Matrix2Xd& v) { return Eigen::Matrix2Xd(v.array().round().matrix()); };
  const MarkerAssumptions& held = benchmark.assumed;
  return fmt::format(kFitTable, benchmark.title, first.press.markers, first.shear.markers, fits,
                     errors(none_press, measured.press.moved_px, none_shear, measured.shear.moved_px),
                     errors(rounded(first.press_px), first.press_px, rounded(first.shear_px), first.shear_px),
                     1e3 * held.ball_radius_m, held.friction, 1e-3 * held.px_per_m, held.contact_px.x(),
                     held.contact_px.y(), benchmark.shear_marker_px.x(), benchmark.shear_marker_px.y(),
                     benchmark.least_length_px, first.press.directions, first.shear.directions);
}

std::string comparison_text(const std::vector<FitRow>& simulators) {
  const FitRow& first = simulators.front();
  const auto field = [&](const char* name, FieldErrors FieldFit::*errors) {
    const FieldErrors& own = first.fit.value().*errors;
    std::string out =
        fmt::format("{}, mean end-point error of {} vectors: {} {:.2f} px", name, own.markers, first.name, own.mean_px);
    const FitRow* nearest = &first;
    for (std::size_t i = 1; i < simulators.size(); ++i) {
      const FitRow& row = simulators[i];
      if (!row.fit) {
        out += fmt::format(", {} no fit", row.name);
        continue;
      }
      const double mean_px = (*row.fit.*errors).mean_px;
      out += fmt::format(", {} {:.2f} px ({:.2f} times)", row.name, mean_px, mean_px / own.mean_px);
      if (mean_px < (*nearest->fit.*errors).mean_px) nearest = &row;
    }
    return out + fmt::format(". Nearest: {}.\n", nearest->name);
  };
  return field("Shear", &FieldFit::shear) + field("Press", &FieldFit::press);
}

std::string vectors_csv(const FieldFit& fit, const MeasuredPressAndShear& measured) {
  std::string out = "field,x_px,y_px,measured_dx_px,measured_dy_px,simulated_dx_px,simulated_dy_px\n";
  const auto add = [&](const char* name, const MarkerField& field, const Eigen::Matrix2Xd& simulated) {
    for (Eigen::Index i = 0; i < field.rest_px.cols(); ++i)
      out += fmt::format("{},{:g},{:g},{:g},{:g},{:.4f},{:.4f}\n", name, field.rest_px(0, i), field.rest_px(1, i),
                         field.moved_px(0, i), field.moved_px(1, i), simulated(0, i), simulated(1, i));
  };
  add("press", measured.press, fit.press_px);
  add("shear", measured.shear, fit.shear_px);
  return out;
}

}  // namespace tacipc
