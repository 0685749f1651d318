#include <fmt/format.h>

#include <algorithm>

#include "stages/study/cases/case_files.h"
#include "stages/study/cases/make_variables.h"

namespace tacipc {
namespace {

std::string indenter(const Measurement& m) {
  if (m.ball_radius_mm)
    return fmt::format("ball: {{radius_mm: {:.10g}, edge_mm: {:.10g}}}\n", *m.ball_radius_mm, m.edge_mm);
  // Only the part of the relief that can touch: a little more than the depth of the press.
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

CaseFiles identify_files(const IdentifySpec& spec, const std::string& folder) {
  CaseFiles files;
  MakeVariables make("IDENTIFY", folder);
  const auto set_path_if_any = [&](const std::string& name, const std::string& path) {
    path.empty() ? make.set(name, "") : make.set_path(name, path);
  };
  const auto joined = [](const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); };
  const auto add = [](std::string& list, const std::string& word) { list += (list.empty() ? "" : " ") + word; };
  make.set_path("SENSOR", spec.sensor);
  make.set_path("MESH", spec.mesh);
  make.set_path("PRESS", spec.press);
  std::string measurements, runs, nodes, gels, checks;
  make.set("CHANGES", joined(spec.changes));
  for (const Measurement& m : spec.measurements) {
    add(measurements, m.name);
    make.set("FILE_" + m.name, m.file);
    make.set("TABLES_" + m.name,
             m.markers ? m.file + "/" + m.markers->press_file + " " + m.file + "/" + m.markers->shear_file : m.file);
    if (!m.mesh.empty()) make.set("OBJECT_" + m.name, m.mesh);
    files.emplace_back(m.name + "/indenter.yaml", indenter(m));
    for (const double depth : m.depths_mm) {
      const std::string run = run_name(m, depth);
      add(runs, run);
      make.set("MEASUREMENT_" + run, m.name);
      files.emplace_back("motion_" + run + ".yaml", motion(m, depth));
      if (m.kind == MeasurementKind::press) make.set("CHECKED_" + run, "yes");
    }
  }
  make.set("MEASUREMENTS", measurements);
  make.set("RUNS", runs);
  const auto axes = spec.axes();
  for (const RunNode& node : spec.nodes()) {
    add(nodes, node.name);
    std::string gel = "gel", sensor;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const std::string value = fmt::format("{:.10g}", node.values[k]);
      if (axes[k]->name == kPoisson) add(sensor, "material.poissons_ratio=" + value);
      if (axes[k]->name == kFriction) make.set("FRICTION_" + node.name, value);
      if (axes[k]->name != kThickness) continue;
      add(sensor, "gel.thickness_mm=" + value);
      gel = fmt::format("gel{}", std::ranges::find(axes[k]->nodes, node.values[k]) - axes[k]->nodes.begin());
    }
    make.set("SET_" + node.name, sensor);
    make.set("GEL_" + node.name, gel);
    if ((" " + gels + " ").find(" " + gel + " ") == std::string::npos) {
      add(gels, gel);
      make.set("FIRST_" + gel, node.name);  // node whose sensor the gel is made for; only the thickness matters
    }
  }
  make.set("NODES", nodes);
  make.set("GELS", gels);
  make.set("MIDDLE", spec.middle().name);
  for (const ModelCheck& check : spec.checks) {
    add(checks, check.name);
    set_path_if_any("CHECK_MESH_" + check.name, check.mesh);
    set_path_if_any("CHECK_PRESS_" + check.name, check.press);
    make.set("CHECK_CHANGES_" + check.name, joined(check.changes));
  }
  make.set("CHECKS", checks);
  files.emplace_back("cases.mk", make.text());
  return files;
}

}  // namespace tacipc
