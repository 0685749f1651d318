#include <fmt/core.h>

#include <algorithm>

#include "common/format/csv.h"
#include "common/image/plot.h"
#include "stages/study/tabulate/markdown.h"
#include "stages/study/tabulate/mesh_costs.h"

namespace tacipc {
namespace {

std::string times(double ratio) {
  return ratio < 1.0 ? fmt::format("{:.1f} times more", 1.0 / ratio) : fmt::format("{:.1f} times fewer", ratio);
}

/// What each mesh of one family would take of another's vertices.
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
