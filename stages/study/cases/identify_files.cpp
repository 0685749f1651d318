#include "stages/study/cases/identify_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace tacipc {
namespace {

std::string indenter(const Measurement& m) {
  if (m.ball_radius_mm)
    return fmt::format("ball: {{radius_mm: {:.10g}, edge_mm: {:.10g}}}\n", *m.ball_radius_mm, m.edge_mm);
  // As much of its relief as can touch: a little more than the press is deep.
  return fmt::format("mesh: {{unit: {}, edge_radius_mm: {:.10g}, spacing_mm: {:.10g}, relief_mm: {:.10g}}}\n", m.unit,
                     m.edge_radius_mm, m.edge_mm, 2.0 * m.depths_mm.back());
}

std::string motion(const Measurement& m, double depth_mm) {
  std::string out = fmt::format(
      "placement: {{center_mm: [{:.10g}, {:.10g}]}}\nmotion:\n  - {{kind: press, depth_mm: {:.10g}, steps: {}}}\n",
      m.center_mm.x(), m.center_mm.y(), depth_mm, m.press_frames);
  if (m.sheared())
    out += fmt::format("  - {{kind: shear, direction_deg: {:.10g}, distance_mm: {:.10g}, steps: {}}}\n",
                       m.direction_deg, m.travel_mm, m.shear_frames);
  return out;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> identify_files(const IdentifySpec& spec, const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  std::string text = "# Made by the stage cases.\n";
  const auto set = [&](const std::string& name, const std::string& value) {
    text += fmt::format("IDENTIFY_{} := {}\n", name, value);
  };
  const auto setting = [&](const std::string& path) {
    return (std::filesystem::path(folder) / path).lexically_normal().generic_string();
  };
  const auto joined = [](const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); };
  const auto add = [](std::string& list, const std::string& word) { list += (list.empty() ? "" : " ") + word; };
  set("SENSOR", setting(spec.sensor));
  set("MESH", setting(spec.mesh));
  set("PRESS", setting(spec.press));
  std::string measurements, runs, nodes, gels, checks;
  set("CHANGES", joined(spec.changes));
  for (const Measurement& m : spec.measurements) {
    add(measurements, m.name);
    set("FILE_" + m.name, m.file);
    set("TABLES_" + m.name,
        m.markers ? m.file + "/" + m.markers->press_file + " " + m.file + "/" + m.markers->shear_file : m.file);
    if (!m.mesh.empty()) set("OBJECT_" + m.name, m.mesh);
    files.emplace_back(m.name + "/indenter.yaml", indenter(m));
    for (const double depth : m.depths_mm) {
      const std::string run = run_name(m, depth);
      add(runs, run);
      set("MEASUREMENT_" + run, m.name);
      files.emplace_back("motion_" + run + ".yaml", motion(m, depth));
      if (m.kind == MeasurementKind::press) set("CHECKED_" + run, "yes");
    }
  }
  set("MEASUREMENTS", measurements);
  set("RUNS", runs);
  const auto axes = spec.axes();
  for (const RunNode& node : spec.nodes()) {
    add(nodes, node.name);
    std::string gel = "gel", sensor;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const std::string value = fmt::format("{:.10g}", node.values[k]);
      if (axes[k]->name == kPoisson) add(sensor, "material.poissons_ratio=" + value);
      if (axes[k]->name == kFriction) set("FRICTION_" + node.name, value);
      if (axes[k]->name != kThickness) continue;
      add(sensor, "gel.thickness_mm=" + value);
      gel = fmt::format("gel{}", std::ranges::find(axes[k]->nodes, node.values[k]) - axes[k]->nodes.begin());
    }
    set("SET_" + node.name, sensor);
    set("GEL_" + node.name, gel);
    if ((" " + gels + " ").find(" " + gel + " ") == std::string::npos) {
      add(gels, gel);
      set("FIRST_" + gel, node.name);  // whose sensor the gel is made for: only the thickness matters
    }
  }
  set("NODES", nodes);
  set("GELS", gels);
  set("MIDDLE", spec.middle().name);
  for (const ModelCheck& check : spec.checks) {
    add(checks, check.name);
    set("CHECK_MESH_" + check.name, check.mesh.empty() ? "" : setting(check.mesh));
    set("CHECK_PRESS_" + check.name, check.press.empty() ? "" : setting(check.press));
    set("CHECK_CHANGES_" + check.name, joined(check.changes));
  }
  set("CHECKS", checks);
  files.emplace_back("cases.mk", text);
  return files;
}

}  // namespace tacipc
