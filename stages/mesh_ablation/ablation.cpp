#include "stages/mesh_ablation/ablation.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/record.h"
#include "common/stage_timings.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// The files of one mesh. \throw DataError if there are none
std::vector<fs::path> of_mesh(const std::vector<fs::path>& files, const std::string& mesh, const fs::path& root,
                              const char* what) {
  std::vector<fs::path> out;
  for (const fs::path& file : files)
    if (lies_in(file, mesh, root)) out.push_back(file);
  if (out.empty()) throw DataError("no {} of {} was given", what, mesh);
  return out;
}

fs::path only_one(const std::vector<fs::path>& files, const std::string& mesh, const fs::path& root, const char* what) {
  const auto found = of_mesh(files, mesh, root, what);
  if (found.size() > 1)
    throw DataError("{} and {} are both the {} of {}", found[0].string(), found[1].string(), what, mesh);
  return found.front();
}

/// The folder that all files lie in.
fs::path root_of(const AblationFiles& files) {
  std::vector<fs::path> all;
  for (const auto* some : {&files.gels, &files.presses, &files.renders, &files.depths})
    all.insert(all.end(), some->begin(), some->end());
  return common_folder(all);
}

MeshCost read_mesh(const AblationFiles& files, const MeshAblationConfig::Mesh& mesh) {
  const fs::path root = root_of(files);
  MeshCost cost{.name = mesh.name, .remark = mesh.remark};
  const Record gel = Record::from_file(only_one(files.gels, mesh.name, root, "gel")).section("summary");
  cost.vertices = gel.required_count("vertices");
  cost.tets = gel.required_count("tets");
  const auto presses = of_mesh(files.presses, mesh.name, root, "press"),
             renders = of_mesh(files.renders, mesh.name, root, "render");
  cost.presses = presses.size();
  for (const fs::path& press : presses) {
    const StageTimings timings = read_timings_of(press);
    cost.press_s += timings.processor_s / static_cast<double>(presses.size());
    cost.peak_memory_mb = std::max(cost.peak_memory_mb, timings.peak_memory_mb);
  }
  for (const fs::path& render : renders)
    cost.render_s += read_timings_of(render).processor_s / static_cast<double>(renders.size());
  const Record depth =
      Record::from_file(only_one(files.depths, mesh.name, root, "depth error")).section("summary").section("pressed");
  cost.depth_error_mm = depth.required_number("mae_mm");
  cost.largest_error_mm = depth.required_number("max_mm");
  return cost;
}

}  // namespace

MeshAblationConfig MeshAblationConfig::read(ConfigReader& in) {
  MeshAblationConfig config{.title = in.text("title"), .link_folder = in.text_or("link_folder", ""), .families = {}};
  for (ConfigReader& item : in.one_or_more_sections("families")) {
    Family family{.name = item.text("name"), .meshes = {}};
    for (ConfigReader& mesh : item.one_or_more_sections("meshes"))
      family.meshes.push_back({.name = mesh.text("name"), .remark = mesh.text_or("remark", "")});
    config.families.push_back(std::move(family));
  }
  return config;
}

std::vector<FamilyCost> read_costs(const AblationFiles& files, const MeshAblationConfig& config) {
  std::vector<FamilyCost> families;
  for (const auto& family : config.families) {
    FamilyCost out{.name = family.name, .meshes = {}};
    for (const auto& mesh : family.meshes) out.meshes.push_back(read_mesh(files, mesh));
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

}  // namespace tacipc
