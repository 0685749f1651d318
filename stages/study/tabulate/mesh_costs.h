// Cost of gel meshes and error of their presses against a finer one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/stage/named_path.h"

namespace tacipc {

/// configs/studies/paper/tables/meshes.yaml
struct MeshTableConfig {
  struct Mesh {
    std::string name;    // that its records were given for
    std::string remark;  // shown behind it
  };
  struct Family {
    std::string name;
    std::vector<Mesh> meshes;  // coarse to fine
  };
  std::string title;
  std::string link_folder;  // of the plot, as seen from where table.md is going to stand
  std::vector<Family> families;

  static MeshTableConfig read(ConfigReader& in);
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

/// From the records of each mesh, given by its name: tetmesh, press and render of all presses with timings beside,
/// metrics of depth maps. \throw DataError if a mesh lacks one of them or has two gels
std::vector<FamilyCost> read_costs(const std::vector<NamedPath>& records, const MeshTableConfig& config);

/// Vertices at which a family has this error, by straight lines in log vertices over log error between its meshes;
/// nothing outside of what they span.
std::optional<double> vertices_at(const FamilyCost& family, double error_mm);

inline constexpr const char* kMeshPlot = "mesh_error.svg";

/// Table, plot (linked), and what each mesh of the first family would take of the second's vertices for its error.
std::string to_markdown(const std::vector<FamilyCost>& families, const MeshTableConfig& config);
std::string to_csv(const std::vector<FamilyCost>& families);
std::string error_svg(const std::vector<FamilyCost>& families, const MeshTableConfig& config);

}  // namespace tacipc
