// What gel meshes cost and how far their presses lie from a finer one, mesh by mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config.h"

namespace tacipc {

/// configs/mesh_ablation/*.yaml
struct MeshAblationConfig {
  struct Mesh {
    std::string name;    // of the folders that hold its files
    std::string remark;  // shown behind it
  };
  struct Family {
    std::string name;
    std::vector<Mesh> meshes;  // coarse to fine
  };
  std::string title;
  std::string link_folder;  // of the plot, as seen from where table.md is going to stand
  std::vector<Family> families;

  static MeshAblationConfig read(ConfigReader& in);
};

/// Where the numbers are: records of stages, each in a folder that a mesh's name names.
struct AblationFiles {
  std::vector<std::filesystem::path> gels;     // tetmesh.yaml
  std::vector<std::filesystem::path> presses;  // press.yaml, with timings beside
  std::vector<std::filesystem::path> renders;  // render.yaml, with timings beside
  std::vector<std::filesystem::path> depths;   // depth_metrics.yaml
};

/// Means over the presses of one mesh.
struct MeshCost {
  std::string name;
  std::string remark;
  int vertices = 0;
  int tets = 0;
  std::size_t presses = 0;
  double press_s = 0.0;  // of a processor
  double render_s = 0.0;
  double peak_memory_mb = 0.0;  // largest
  double depth_error_mm = 0.0;  // mean |depth − reference's| where that is pressed
  double largest_error_mm = 0.0;
};

struct FamilyCost {
  std::string name;
  std::vector<MeshCost> meshes;
};

/// \throw DataError if a mesh lacks one of its files or has two gels
std::vector<FamilyCost> read_costs(const AblationFiles& files, const MeshAblationConfig& config);

/// Vertices at which a family has this error, by straight lines in log vertices over log error between its meshes;
/// nothing outside of what they span.
std::optional<double> vertices_at(const FamilyCost& family, double error_mm);

/// Table, plot (linked), and what each mesh of the first family would take of the second's vertices for its error.
std::string to_markdown(const std::vector<FamilyCost>& families, const MeshAblationConfig& config);
std::string to_csv(const std::vector<FamilyCost>& families);
std::string error_svg(const std::vector<FamilyCost>& families, const MeshAblationConfig& config);

}  // namespace tacipc
