#include "verification/run_case.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/error.h"
#include "common/image/plot.h"
#include "verification/shared_files.h"

namespace tacipc::verify {
namespace {

Sensor sensor_for(const CaseSpec& spec, const TetMesh& gel) {
  Sensor sensor;
  sensor.name = "verification";
  sensor.gel = shape_of(spec.gel, gel);
  sensor.material = spec.material;
  sensor.camera.width_px = 640;
  sensor.camera.height_px = 480;
  sensor.camera.window_width_m = sensor.gel.width_m;
  sensor.camera.window_height_m = sensor.gel.height_m;
  return sensor;
}

/// Value of a quantity; NaN if this kind of object does not have it.
double measure_or_nan(const Outcome& outcome, const std::string& quantity, int frame) {
  try {
    return measure(outcome, quantity, frame);
  } catch (const UsageError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

CaseResult run_case(CaseSpec spec, const std::filesystem::path& shared, const ProgressObserver& observe) {
  CaseResult result;
  result.spec = std::move(spec);
  for (const std::string& path : result.spec.shared_paths()) {
    if ((result.skipped = why_skipped(path, shared))) return result;
    if (!std::filesystem::exists(resolve(path, shared)))
      throw DataError("{} is missing from the shared data {}", path.substr(kSharedPrefix.size()), shared.string());
  }
  result.gel = make_gel(result.spec.gel, shared);
  result.object = make_object(result.spec.object, shared);
  try {
    result.simulation = simulate(sensor_for(result.spec, result.gel), result.gel, result.object, result.spec.press,
                                 result.spec.sample, "-z", observe);
  } catch (const SolverError& error) {
    result.failed = error.what();
    return result;
  }
  result.judgement = judge({result.spec, result.gel, result.object, *result.simulation}, shared);
  return result;
}

Value to_value(const CaseResult& result) {
  Value::Map out{{"title", result.spec.title}, {"source", result.spec.source}};
  out.emplace_back("state", result.skipped ? "skipped" : result.failed ? "failed" : result.pass() ? "pass" : "missed");
  if (result.skipped) out.emplace_back("reason", *result.skipped);
  if (result.failed) out.emplace_back("reason", *result.failed);
  if (result.skipped) return out;
  out.emplace_back("gel_vertices", static_cast<std::int64_t>(result.gel.num_vertices()));
  if (result.judgement.fitted_modulus_pa) out.emplace_back("fitted_modulus_pa", *result.judgement.fitted_modulus_pa);
  Value::List rows;
  for (const Row& row : result.judgement.rows) {
    Value::Map line{{"label", row.label}, {"unit", row.unit}, {"measured", row.measured}};
    if (row.expected) line.emplace_back("expected", *row.expected);
    line.emplace_back("limit", row.limit);
    line.emplace_back("deviation", row.deviation);
    line.emplace_back("pass", row.pass);
    rows.emplace_back(std::move(line));
  }
  out.emplace_back("rows", std::move(rows));
  return out;
}

std::string to_csv(const CaseResult& result) {
  std::string out = "frame,depth_mm,sideways_mm,turned_deg";
  for (const Quantity& q : quantities()) out += "," + q.name;
  out += '\n';
  if (!result.simulation) return out;
  const Outcome outcome{result.spec, result.gel, result.object, *result.simulation};
  for (int f = 0; f < static_cast<int>(result.simulation->frames.size()); ++f) {
    out += fmt::format("{},{:.9g},{:.9g},{:.9g}", f, 1e3 * depth_m(outcome, f), 1e3 * sideways_m(outcome, f),
                       180.0 / std::numbers::pi * turned_rad(outcome, f));
    for (const Quantity& q : quantities()) out += fmt::format(",{:.9g}", measure_or_nan(outcome, q.name, f));
    out += '\n';
  }
  return out;
}

std::string to_svg(const CaseResult& result) {
  Plot plot{.title = result.spec.title, .x_label = "depth (mm)", .y_label = "force (N)"};
  if (!result.simulation) return to_svg(plot);
  const Outcome outcome{result.spec, result.gel, result.object, *result.simulation};
  const int frames = static_cast<int>(result.simulation->frames.size());
  bool moves = false, turns = false;
  for (int f = 0; f < frames; ++f) {
    moves = moves || sideways_m(outcome, f) > 1e-9;
    turns = turns || std::abs(turned_rad(outcome, f)) > 1e-9;
  }
  PlotCurve measured{.label = "press"}, tangential{.label = "tangential"}, torque{.label = "torque (N mm)"};
  for (int f = 0; f < frames; ++f) {
    const double x = moves   ? 1e3 * sideways_m(outcome, f)
                     : turns ? 180.0 / std::numbers::pi * turned_rad(outcome, f)
                             : 1e3 * depth_m(outcome, f);
    measured.points.emplace_back(x, measure(outcome, "press_force_n", f));
    tangential.points.emplace_back(x, measure(outcome, "tangential_force_n", f));
    torque.points.emplace_back(x, 1e3 * measure(outcome, "torque_z_n_m", f));
  }
  const double scale = result.judgement.fitted_modulus_pa.value_or(result.spec.material.youngs_modulus_pa) /
                       result.spec.material.youngs_modulus_pa;
  for (auto* curve : {&measured, &tangential, &torque})
    for (auto& point : curve->points) point.y() *= scale;
  plot.curves = {measured};
  if (moves) plot.curves.push_back(tangential);
  if (turns) plot.curves.push_back(torque);
  if (moves) plot.x_label = "way sideways (mm)";
  if (turns && !moves) plot.x_label = "turn (degrees)";
  // Expected forces, if there are any.
  PlotCurve expected{.label = "expected", .dots = true};
  for (std::size_t i = 0; i < result.spec.expect.size(); ++i) {
    const Row& row = result.judgement.rows[i];
    const bool shown = row.unit == "N" || (turns && row.unit == "N m");
    if (!row.expected || !shown) continue;
    const auto f = static_cast<std::size_t>(find_frame(outcome, result.spec.expect[i].frame));
    expected.points.emplace_back(measured.points[f].x(), *row.expected * (row.unit == "N m" ? 1e3 : 1.0));
  }
  if (!expected.points.empty()) plot.curves.push_back(expected);
  return to_svg(plot);
}

}  // namespace tacipc::verify
