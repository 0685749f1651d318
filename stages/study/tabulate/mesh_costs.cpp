#include "stages/study/tabulate/mesh_costs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "common/format/csv.h"
#include "common/image/plot.h"
#include "common/stage/record.h"
#include "common/stage/stage_timings.h"
#include "stages/study/tabulate/markdown.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Records of one stage of one mesh.
/// \throw DataError if there are none
std::vector<fs::path> records_of(const std::vector<NamedPath>& records, const std::string& mesh,
                                 const std::string& stage) {
  std::vector<fs::path> out;
  for (const auto& [name, path] : records)
    if (name == mesh && Record::from_file(path).required_text("stage") == stage) out.push_back(path);
  if (out.empty()) throw DataError("no record of {} was given for {}", stage, mesh);
  return out;
}

Record only_summary(const std::vector<NamedPath>& records, const std::string& mesh, const std::string& stage) {
  const auto found = records_of(records, mesh, stage);
  if (found.size() > 1)
    throw DataError("{} and {} are both the {} of {}", found[0].string(), found[1].string(), stage, mesh);
  return Record::from_file(found.front()).section("summary");
}

/// Mean processor seconds of the runs that left these records, and the largest memory of any.
StageTimings mean_timings(const std::vector<fs::path>& records) {
  StageTimings mean;
  std::vector<double> seconds;
  for (const fs::path& record : records) {
    const StageTimings timings = read_timings_of(record);
    seconds.push_back(timings.processor_s);
    mean.peak_memory_mb = std::max(mean.peak_memory_mb, timings.peak_memory_mb);
  }
  mean.processor_s = mean_and_deviation(seconds).mean;
  return mean;
}

MeshCost read_mesh(const std::vector<NamedPath>& records, const MeshTableConfig::Mesh& mesh) {
  const Record gel = only_summary(records, mesh.name, "tetmesh"),
               depth = only_summary(records, mesh.name, "metrics").section("pressed");
  const auto presses = records_of(records, mesh.name, "press");
  const StageTimings press = mean_timings(presses), render = mean_timings(records_of(records, mesh.name, "render"));
  return {.name = mesh.name,
          .remark = mesh.remark,
          .vertices = gel.required_count("vertices"),
          .tets = gel.required_count("tets"),
          .presses = presses.size(),
          .press_s = press.processor_s,
          .render_s = render.processor_s,
          .peak_memory_mb = press.peak_memory_mb,
          .depth_error_mm = depth.section("mae_mm").required_number("mean"),
          .largest_error_mm = depth.section("max_mm").required_number("mean")};
}

std::string times(double ratio) {
  return ratio < 1.0 ? fmt::format("{:.1f} times more", 1.0 / ratio) : fmt::format("{:.1f} times fewer", ratio);
}

/// Number of vertices of the other family at the error of each mesh of `family`, as text.
std::string comparison(const FamilyCost& family, const FamilyCost& other) {
  std::string text;
  for (const MeshCost& mesh : family.meshes) {
    const std::string start =
        fmt::format("- {} ({} vertices, {:.4f} mm): ", mesh.name, markdown_count(mesh.vertices), mesh.depth_error_mm);
    if (const auto vertices = vertices_at(other, mesh.depth_error_mm)) {
      text += start + fmt::format("a mesh of the {} kind has that error with some {} vertices, {}\n", other.name,
                                  markdown_count(*vertices), times(mesh.vertices / *vertices));
      continue;
    }
    const auto better = std::ranges::find_if(
        other.meshes, [&](const MeshCost& candidate) { return candidate.depth_error_mm < mesh.depth_error_mm; });
    if (better != other.meshes.end())
      text += start + fmt::format("{} is nearer ({:.4f} mm) with {} vertices, {}\n", better->name,
                                  better->depth_error_mm, markdown_count(better->vertices),
                                  times(static_cast<double>(mesh.vertices) / better->vertices));
    else
      text += start + fmt::format("no mesh of the {} kind comes so near\n", other.name);
  }
  return text;
}

}  // namespace

MeshTableConfig MeshTableConfig::read(ConfigReader& in) {
  MeshTableConfig config{.title = in.text("title"), .link_folder = in.text_or("link_folder", ""), .families = {}};
  for (ConfigReader& item : in.one_or_more_sections("families")) {
    Family family{.name = item.text("name"), .meshes = {}};
    for (ConfigReader& mesh : item.one_or_more_sections("meshes"))
      family.meshes.push_back({.name = mesh.text("name"), .remark = mesh.text_or("remark", "")});
    config.families.push_back(std::move(family));
  }
  return config;
}

std::vector<FamilyCost> read_costs(const std::vector<NamedPath>& records, const MeshTableConfig& config) {
  std::vector<FamilyCost> families;
  for (const auto& family : config.families) {
    FamilyCost out{.name = family.name, .meshes = {}};
    for (const auto& mesh : family.meshes) out.meshes.push_back(read_mesh(records, mesh));
    families.push_back(std::move(out));
  }
  return families;
}

std::optional<double> vertices_at(const FamilyCost& family, double error_mm) {
  for (std::size_t i = 0; i + 1 < family.meshes.size(); ++i) {
    const MeshCost &a = family.meshes[i], &b = family.meshes[i + 1];
    const double high = std::max(a.depth_error_mm, b.depth_error_mm),
                 low = std::min(a.depth_error_mm, b.depth_error_mm);
    if (!(error_mm <= high && error_mm >= low && high > low && low > 0.0)) continue;
    const double t = std::log(error_mm / a.depth_error_mm) / std::log(b.depth_error_mm / a.depth_error_mm);
    return a.vertices * std::pow(static_cast<double>(b.vertices) / a.vertices, t);
  }
  return std::nullopt;
}

std::string to_markdown(const std::vector<FamilyCost>& families, const MeshTableConfig& config) {
  std::string text = markdown_head(
      {"mesh", "", "vertices", "tets", "press, s", "render, s", "peak memory, GB", "depth error, mm", "largest, mm"});
  std::size_t presses = 0;
  for (const FamilyCost& family : families) {
    for (const MeshCost& mesh : family.meshes) {
      text += markdown_row({markdown_cell(mesh.name), markdown_cell(mesh.remark), markdown_count(mesh.vertices),
                            markdown_count(mesh.tets), markdown_number(mesh.press_s, 1),
                            markdown_number(mesh.render_s, 1), markdown_number(1e-3 * mesh.peak_memory_mb, 2),
                            markdown_number(mesh.depth_error_mm, 4), markdown_number(mesh.largest_error_mm, 3)});
      presses = mesh.presses;
    }
  }
  text +=
      fmt::format("\n{}: means over {} presses; times are processor seconds of one thread.\n", config.title, presses);
  if (families.size() > 1) {
    text += fmt::format("\nFor the error of a {} mesh:\n\n", families[0].name);
    text += comparison(families[0], families[1]);
  }
  return text + markdown_picture("Error over vertices", config.link_folder, kMeshPlot);
}

std::string to_csv(const std::vector<FamilyCost>& families) {
  std::string text = csv_line({"family", "mesh", "vertices", "tets", "presses", "press_s", "render_s", "peak_memory_mb",
                               "depth_error_mm", "largest_error_mm"});
  for (const FamilyCost& family : families)
    for (const MeshCost& mesh : family.meshes)
      text += csv_line({family.name, mesh.name, fmt::format("{}", mesh.vertices), fmt::format("{}", mesh.tets),
                        fmt::format("{}", mesh.presses), fmt::format("{}", mesh.press_s),
                        fmt::format("{}", mesh.render_s), fmt::format("{}", mesh.peak_memory_mb),
                        fmt::format("{}", mesh.depth_error_mm), fmt::format("{}", mesh.largest_error_mm)});
  return text;
}

std::string error_svg(const std::vector<FamilyCost>& families, const MeshTableConfig& config) {
  Plot plot{.title = config.title,
            .x_label = "vertices",
            .y_label = "mean depth error where pressed, mm",
            .curves = {},
            .logarithmic = true};
  for (const FamilyCost& family : families) {
    PlotCurve curve{.label = family.name, .points = {}, .marks = true};
    for (const MeshCost& mesh : family.meshes) curve.points.emplace_back(mesh.vertices, mesh.depth_error_mm);
    plot.curves.push_back(std::move(curve));
  }
  return to_svg(plot);
}

}  // namespace tacipc
