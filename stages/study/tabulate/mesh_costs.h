// Tabulates the cost of gel meshes and the error of their presses against a finer mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/stage/named_path.h"

namespace tacipc {

/// Content of configs/studies/paper/tables/meshes.yaml.
struct MeshTableConfig {
  struct Mesh {
    std::string name;    // name for which its records were given
    std::string remark;  // text shown after the name
  };
  struct Family {
    std::string name;
    std::vector<Mesh> meshes;  // coarse to fine
  };
  std::string title;
  std::string link_folder;  // folder of the plot, as seen from the final location of table.md
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
  double press_s = 0.0;  // processor time
  double render_s = 0.0;
  double peak_memory_mb = 0.0;  // largest peak
  double depth_error_mm = 0.0;  // mean |depth − reference depth| where the reference is pressed
  double largest_error_mm = 0.0;
};

/// Costs of the meshes of one family.
struct FamilyCost {
  std::string name;
  std::vector<MeshCost> meshes;
};

/// Means for each mesh, from the records given by its name: tetmesh, press and render of all presses with their
/// timings, and metrics of depth maps.
/// \throw DataError if a mesh lacks one of them or has two gels
std::vector<FamilyCost> read_costs(const std::vector<NamedPath>& records, const MeshTableConfig& config);

/// Number of vertices at which a family has this error, by linear interpolation of log vertices over log error between
/// its meshes.
/// \return nothing outside the range of its meshes
std::optional<double> vertices_at(const FamilyCost& family, double error_mm);

inline constexpr const char* kMeshPlot = "mesh_error.svg";

/// Markdown: table, plot (linked), and for each mesh of the first family the number of vertices with which the second
/// family reaches its error.
std::string to_markdown(const std::vector<FamilyCost>& families, const MeshTableConfig& config);
std::string to_csv(const std::vector<FamilyCost>& families);
std::string error_svg(const std::vector<FamilyCost>& families, const MeshTableConfig& config);

}  // namespace tacipc
