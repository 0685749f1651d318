// A whole run of the stage on a small slab, as a user calls it.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "common/base/files.h"
#include "common/format/npy.h"
#include "common/mesh/tet_mesh.h"
#include "tests/common/optics/test_surfaces.h"
#include "tests/program_test.h"

namespace tacipc {

inline const char* const kSensor = R"(name: slab
gel: {outline: rectangle, size_mm: [4.0, 3.0], thickness_mm: 1.0}
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.23e5, poissons_ratio: 0.43}
coating: {albedo: [0.5, 0.5, 0.5]}
leds:
  size_mm: 1.0
  ring:
    {radius_mm: 4.0, z_mm: -5.0, count: 3, lit: [{index: 0, rgb_linear: [1, 0.1, 0.1], intensity: 1},
     {index: 1, rgb_linear: [0.1, 1, 0.1], intensity: 1}, {index: 2, cct_k: 9000, intensity: 1}]}
camera: {position_mm: [0, 0, -5], width_px: 32, height_px: 24, window_mm: [3.2, 2.4]}
response: {mean_level: 0.5, curve: srgb}
noise: {full_well_e: 5000, read_e: 4}
)";
inline const char* const kConfig = "frames: last\nnoise: {seed: 1}\n";

/// A slab of 4 × 3 × 1 mm, one cell thick, each cell cut into six tets about its diagonal.
inline TetMesh slab(int nx, int ny) {
  TetMesh gel;
  gel.positions.resize(2 * (nx + 1) * (ny + 1), 3);
  const auto index = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        gel.positions.row(index(i, j, k)) << kMm * (4.0 * i / nx - 2.0), kMm * (3.0 * j / ny - 1.5), kMm * (k - 1.0);
      }
    }
  }
  gel.tets.resize(6 * nx * ny, 4);
  // Paths from corner 000 to 111 along the axes in all six orders; odd orders swap two vertices to stay positive.
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  int tet = 0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      for (int o = 0; o < 6; ++o) {
        int at[3] = {i, j, 0}, path[4] = {index(i, j, 0), 0, 0, 0};
        for (int step = 0; step < 3; ++step) {
          ++at[orders[o][step]];
          path[step + 1] = index(at[0], at[1], at[2]);
        }
        if (o >= 3) std::swap(path[1], path[2]);
        gel.tets.row(tet++) << path[0], path[1], path[2], path[3];
      }
    }
  }
  gel.boundary = boundary_triangles(gel.tets, gel.num_vertices());
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    const double z[3] = {gel.positions(gel.boundary(f, 0), 2), gel.positions(gel.boundary(f, 1), 2),
                         gel.positions(gel.boundary(f, 2), 2)};
    const bool level = z[0] == z[1] && z[1] == z[2];
    gel.tags.push_back(!level ? BoundaryTag::side : z[0] == 0.0 ? BoundaryTag::front : BoundaryTag::glued);
  }
  return gel;
}

class RenderStage : public ProgramTest {
 protected:
  void SetUp() override {
    press(slab(16, 12), 3,
          [](double x, double y) { return 0.2e-3 * std::exp(-(x * x + y * y) / (2.0 * 0.6e-3 * 0.6e-3)); });
  }
  /// Writes all inputs of a run: in frame k the front of the gel has sunk by k times `depth(x, y)`, what lies below by
  /// less.
  void press(TetMesh gel, int frames, const std::function<double(double, double)>& depth) {
    gel_ = std::move(gel);
    positions_ = {};
    positions_.shape = {static_cast<std::size_t>(frames), static_cast<std::size_t>(gel_.num_vertices()), 3};
    for (int frame = 0; frame < frames; ++frame) {
      for (Eigen::Index v = 0; v < gel_.num_vertices(); ++v) {
        const double x = gel_.positions(v, 0), y = gel_.positions(v, 1), z = gel_.positions(v, 2);
        positions_.data.insert(positions_.data.end(), {x, y, z - frame * depth(x, y) * (1.0 + z / kMm)});
      }
    }
    write_file(scratch_ / "sensor.yaml", kSensor);
    write_file(scratch_ / "config.yaml", kConfig);
    write_file(scratch_ / "press/press.yaml", "stage: press\n");
    write_tet_mesh(scratch_ / "gel.msh", gel_);
    write_positions();
  }
  void write_positions() { write_npy(scratch_ / "press/positions.npy", positions_.shape, positions_.data.data()); }

  /// Runs the program; what it says is in said_, with the scratch folder's name left out.
  int run(const std::string& out = "out", const std::string& more = "--threads 1") {
    const int code = run_command(
        fmt::format("{}/render --log-level warning --config {} --sensor {} --gel {} --press {} --out {} {}",
                    TACIPC_BIN_DIR, (scratch_ / "config.yaml").string(), (scratch_ / "sensor.yaml").string(),
                    (scratch_ / "gel.msh").string(), (scratch_ / "press").string(), (scratch_ / out).string(), more));
    const std::string root = (scratch_ / "").string();
    for (std::size_t at = said_.find(root); at != std::string::npos; at = said_.find(root))
      said_.erase(at, root.size());
    return code;
  }

  TetMesh gel_;
  NpyArray positions_;
};

}  // namespace tacipc
