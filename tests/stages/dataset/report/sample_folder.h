// A sample as the other stages leave it, written by hand: records, poses, small pictures.
#pragma once

#include <filesystem>
#include <string>

#include "common/base/files.h"
#include "common/format/npy.h"
#include "common/image/image.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {

inline constexpr const char* kPressRecord = R"(stage: press
inputs:
  gel: {path: ../../../gels/small/gel.msh, hash: a}
  object: {path: ../../../objects/star/object.ply, hash: 2e988d611a7a5c5c8f5a2fc56afa050a}
name: star-007
config:
  config: {time_step_s: 0.01}
  object-config: {unit: m, up: -z}
  sample:
    placement: {rotate_deg: 30, center_mm: [1.5, -2]}
    motion: {kind: press, depth_mm: 0.5, steps: 2}
summary:
  frames: 3
  gel_vertices: 23512
  face: +z
  newton_iterations: 25
  press_force_n: 1.25
  min_distance_m: 3.5e-05
  min_volume_ratio: 0.75
  intersections: 0
  inverted_tets: 0
  converged: true
  per_frame:
    - {press_force_n: -0, newton_iterations: 0, min_gap_m: 5.0e-05, min_volume_ratio: 1}
    - {press_force_n: 0.5, newton_iterations: 11, min_gap_m: 4.0e-05, min_volume_ratio: 0.875}
    - {press_force_n: 1.25, newton_iterations: 14, min_gap_m: 3.5e-05, min_volume_ratio: 0.75}
)";

inline constexpr const char* kRenderRecord = R"(stage: render
reference: synthetic
summary: {frames: [0, 2], max_indentation_mm: 0.534}
outputs: {frame_0002/indentation.png: 1, frame_0002/normal.png: 2, frame_0004/indentation.png: 3, frame_0004/normal.png: 4}
)";

inline constexpr const char* kDecimateRecord = R"(stage: decimate
inputs:
  mesh: {path: ../../emboss/star/object.ply, hash: c}
summary:
  input_vertices: 123456
  vertices: 8000
  passed_through: false
  hausdorff_mm: {input_to_output: 0.01, output_to_input: 0.0123, max: 0.0123}
  overlapping_components: 0
  self_intersections: 3
  repairs: {unreferenced_vertices: 0, merged_vertices: 17, filled_holes: 2}
)";

/// Object at z = 2 mm, 1.75 mm, 1.5 mm: with 0.5 mm of depth at the end, depths of 0, 0.25 and 0.5 mm.
inline void write_poses(const std::filesystem::path& path) {
  std::vector<double> poses;
  for (const double z : {2.0e-3, 1.75e-3, 1.5e-3})
    poses.insert(poses.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, z, 0, 0, 0, 1});
  write_npy(path, {3, 4, 4}, poses.data());
}

/// A tetrahedron whose lowest point lies 2 mm below its origin.
inline void write_object(const std::filesystem::path& path) {
  TriangleMesh mesh{Positions(4, 3), Triangles(4, 3)};
  mesh.positions << -1e-3, -1e-3, 2e-3, 1e-3, -1e-3, 2e-3, 0, 1e-3, 2e-3, 0, 0, -2e-3;
  mesh.triangles << 0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0;
  std::filesystem::create_directories(path.parent_path());
  write_ply(path, mesh);
}

inline void write_flat_png(const std::filesystem::path& path, int width, int height, std::uint8_t red) {
  std::filesystem::create_directories(path.parent_path());
  ByteImage image(width, height, 3, 40);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) image.pixels[i] = red;
  write_png(path, image);
}

/// Writes `root`/out/demo/`name` and the object and gel folders its records speak of. Returns the sample's folder.
inline std::filesystem::path write_sample(const std::filesystem::path& root, const std::string& name = "star") {
  std::filesystem::path sample = root / "out" / "demo" / name;
  write_file(sample / "press/press.yaml", kPressRecord);
  write_file(sample / "press/press.log", "2024-06-07 12:34:56.789 info: frame 1/2: force 0.5 N\n");
  write_poses(sample / "press/object_pose.npy");
  write_file(sample / "press/positions.npy", "array");
  write_file(sample / "render/render.yaml", kRenderRecord);
  write_flat_png(sample / "render/frame_0000/tactile.png", 40, 30, 10);
  write_flat_png(sample / "render/frame_0002/tactile.png", 40, 30, 200);
  write_flat_png(sample / "render/frame_0002/indentation.png", 40, 30, 120);
  write_flat_png(sample / "render/frame_0002/normal.png", 40, 30, 60);
  write_file(sample / "render/frame_0002/depth.exr", "image");
  write_file(root / "out/objects/star/decimate.yaml", kDecimateRecord);
  write_object(root / "out/objects/star/object.ply");
  write_file(root / "out/gels/small/tetmesh.yaml", "stage: tetmesh\n");
  return sample;
}

/// `text` with the first `from` replaced. \pre it is there
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace tacipc
