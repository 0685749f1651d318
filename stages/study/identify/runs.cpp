#include "stages/study/identify/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/format/csv.h"
#include "common/sample/press_folder.h"

namespace tacipc {
namespace {

/// Data of one press: depths (mm) and normal forces (N) of its frames; then travels (mm) and tangential forces of a
/// shear.
struct ForceRun {
  std::vector<double> depth_mm, press_n, travel_mm, shear_n;
};

ForceRun read_forces(const std::filesystem::path& folder, double depth_mm) {
  const PressFolder press = PressFolder::finished(folder);
  const auto phases = press.phases();
  const auto poses = press.poses();
  const auto wrenches = press.wrenches();
  ForceRun run;
  std::size_t end = 0;
  for (std::size_t f = 0; f < phases.size(); ++f)
    if (phases[f] <= PhaseKind::press) end = f;
  if (end == 0) throw DataError("{}: is no press", folder.string());
  // The pose does not contain the object's own zero, so depths count from the known depth at the end of the motion.
  const Vector3 last = poses[end].topRightCorner<3, 1>();
  for (std::size_t f = 0; f <= end; ++f) {
    const double depth = depth_mm - 1e3 * (poses[f](2, 3) - last.z());
    if (depth <= 0.0) continue;  // above the front
    run.depth_mm.push_back(depth);
    run.press_n.push_back(-wrenches[f].force_n.z());
  }
  Vector3 across = Vector3::Zero();
  if (end + 1 < phases.size()) across = (poses.back().topRightCorner<3, 1>() - last).normalized();
  for (std::size_t f = end; f < phases.size() && across.squaredNorm() > 0.0; ++f) {
    run.travel_mm.push_back(1e3 * (poses[f].topRightCorner<3, 1>() - last).dot(across));
    run.shear_n.push_back(wrenches[f].force_n.dot(across));
  }
  return run;
}

/// Curves at the depths or travels of the first run. Those of other runs may differ slightly, because frames divide a
/// travel from a start that depends on the gel.
CurveTable table_of(const std::vector<std::filesystem::path>& folders, const std::vector<std::vector<double>>& x,
                    const std::vector<std::vector<double>>& y, double modulus_pa, double exponent) {
  CurveTable table{.x = {0.0}, .y = {}, .exponent = exponent};
  table.x.insert(table.x.end(), x.front().begin(), x.front().end());
  table.y = Eigen::MatrixXd::Zero(x.size(), static_cast<Eigen::Index>(table.x.size()));
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (x[n].size() < 2) throw DataError("{}: has fewer than two frames in contact", folders[n].string());
    std::vector<double> places{0.0};
    places.insert(places.end(), x[n].begin(), x[n].end());
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(places.size());
    for (std::size_t i = 0; i < y[n].size(); ++i) forces[i + 1] = y[n][i] / modulus_pa;
    const Curve curve(places, forces, exponent);
    for (std::size_t i = 1; i < table.x.size(); ++i)
      table.y(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(i)) = curve.at(table.x[i]);
  }
  return table;
}

void read_rows(const Measurement& m, const std::filesystem::path& path, ForceData& data) {
  const std::string& at = m.at.quantity;
  CsvReader table(path);
  while (table.next()) {
    MeasuredForce row{.at = m.at.factor * table.number(m.at.column),
                      .force_n = m.force.factor * table.number(m.force.column)};
    row.sigma_n = std::hypot(m.sigma_n, m.sigma_relative * row.force_n);
    if (!std::isfinite(row.at) || !std::isfinite(row.force_n))
      throw DataError("{}:{}: is not finite", path.string(), table.line());
    // A press has no force before contact, so its rows may be negative.
    if (!(row.at >= 0.0) && m.kind != MeasurementKind::press)
      throw DataError("{}:{}: {} must not be negative", path.string(), table.line(), at);
    const double furthest = m.kind == MeasurementKind::press ? m.depths_mm.back() : m.travel_mm;
    const bool held_out = m.fit_to_mm && row.at > *m.fit_to_mm * (1.0 + 1e-9);
    if (m.kind != MeasurementKind::relaxation && row.at > furthest * (1.0 + 1e-9)) {
      const std::string beyond = fmt::format("{}:{}: {} {:g} is beyond what is simulated, {:g}", path.string(),
                                             table.line(), at, row.at, furthest);
      if (!held_out) throw DataError("{}", beyond);
      log_warning("{}: it is left out", beyond);
      continue;
    }
    (held_out ? data.held_out : data.fitted).push_back(row);
  }
  std::ranges::stable_sort(data.fitted, {}, &MeasuredForce::at);
  std::ranges::stable_sort(data.held_out, {}, &MeasuredForce::at);
  if (data.fitted.empty()) throw DataError("{}: has no row to fit to", path.string());
}

ForceData read_force_data(const IdentifySpec& spec, const Measurement& m, const RunFolder& folder, double modulus_pa) {
  ForceData data;
  for (const double depth : m.depths_mm) {
    std::vector<std::filesystem::path> folders;
    std::vector<std::vector<double>> depths, forces, travels, tangential;
    for (const RunNode& node : spec.nodes()) {
      folders.push_back(folder(node.name, run_name(m, depth)));
      const ForceRun run = read_forces(folders.back(), depth);
      depths.push_back(run.depth_mm);
      forces.push_back(run.press_n);
      if (!m.sheared()) continue;
      if (run.travel_mm.size() < 3) throw DataError("{}: is not dragged", folders.back().string());
      travels.emplace_back(run.travel_mm.begin() + 1, run.travel_mm.end());
      // The friction force at the start of the sideways motion belongs to the press.
      std::vector<double> more;
      for (std::size_t i = 1; i < run.shear_n.size(); ++i) more.push_back(run.shear_n[i] - run.shear_n.front());
      tangential.push_back(std::move(more));
    }
    data.press = table_of(folders, depths, forces, modulus_pa, kPressExponent);
    if (m.sheared()) data.shears.push_back(table_of(folders, travels, tangential, modulus_pa, 1.0));
  }
  return data;
}

}  // namespace

CurveTable read_press_table(const std::vector<std::filesystem::path>& folders, double modulus_pa, double depth_mm) {
  std::vector<std::vector<double>> depths, forces;
  for (const auto& folder : folders) {
    const ForceRun run = read_forces(folder, depth_mm);
    depths.push_back(run.depth_mm);
    forces.push_back(run.press_n);
  }
  return table_of(folders, depths, forces, modulus_pa, kPressExponent);
}

std::vector<MeasurementData> read_measurements(const IdentifySpec& spec, const RunFolder& folder,
                                               const std::map<std::string, std::filesystem::path>& measured,
                                               double modulus_pa) {
  std::vector<MeasurementData> out;
  for (const Measurement& m : spec.measurements) {
    const std::filesystem::path& path = measured.at(m.name);
    if (m.markers) {
      MarkerData data{.runs = {},
                      .press = read_marker_field(path / m.markers->press_file),
                      .shear = read_marker_field(path / m.markers->shear_file)};
      for (const RunNode& node : spec.nodes()) {
        std::vector<std::filesystem::path> folders;
        for (const double depth : m.depths_mm) folders.push_back(folder(node.name, run_name(m, depth)));
        data.runs.emplace_back(folders, 1e-3 * *m.ball_radius_mm);
      }
      out.push_back({.force = {}, .markers = std::move(data)});
    } else {
      ForceData data = read_force_data(spec, m, folder, modulus_pa);
      read_rows(m, path, data);
      out.push_back({.force = std::move(data), .markers = {}});
    }
  }
  return out;
}

}  // namespace tacipc
