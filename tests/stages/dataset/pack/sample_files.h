// A made sample of two frames as press and render leave it, small enough to know every number.
#pragma once

#include <fmt/core.h>

#include <vector>

#include "common/base/files.h"
#include "common/format/npy.h"
#include "common/image/image.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/export/pressed_cube.h"

namespace tacipc {

inline constexpr const char* kPlanHeader = "id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder\n";

inline constexpr const char* kSensorYaml = R"(name: toy
gel: {outline: rectangle, size_mm: [20, 16], thickness_mm: 2}
material: {law: neo_hookean, density_kg_m3: 1000, youngs_modulus_pa: 1.0e+05, poissons_ratio: 0.4}
coating: {albedo: [0.5, 0.5, 0.5]}
leds:
  list:
    - {position_mm: [0, 0, -20], rgb_linear: [1, 1, 1], intensity: 1}
camera: {model: pinhole, position_mm: [0, 0, -10], width_px: 4, height_px: 3, window_mm: [16, 12]}
response: {mean_level: 0.5, curve: srgb}
noise: {full_well_e: 5000, read_e: 4}
)";

/// Pixel value of frame f: every pixel of every frame differs.
inline ByteImage test_picture(int frame, int channels) {
  ByteImage image(4, 3, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(10 * frame + static_cast<int>(i));
  return image;
}

inline FloatImage test_map(int frame, int channels, float unit) {
  FloatImage image(4, 3, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = unit * (static_cast<float>(i) + 100.0f * static_cast<float>(frame));
  return image;
}

/// Writes the sample `folder` (press, render, sample.yaml) and what it was made from beside it, in `root`. Frames 0 and
/// 2 of three have images.
class MadeSample {
 public:
  MadeSample(const ScratchFolder& root, const std::string& folder) : root_(root), folder_(folder) {
    root_.file("made_from/toy.yaml", kSensorYaml);
    write_tet_mesh(root_ / "made_from/gel.msh", cube_gel());
    root_.file("made_from/object.ply", "the object\n");
    root_.file("made_from/press.yaml", "time_step_s: 0.01\n");
    root_.file("made_from/path.csv", "0,0,0,0,0,0,0,1\n");
    root_.file("made_from/render.yaml", "frames: all\n");
    root_.file(folder + "/sample.yaml", "motion: {kind: press, depth_mm: 1, steps: 2}\n");
    write_press();
    write_render();
  }

  void write_press() {
    const auto numbers = [](std::size_t count, double first, double step) {
      std::vector<double> all(count);
      for (std::size_t i = 0; i < count; ++i) all[i] = first + step * static_cast<double>(i);
      return all;
    };
    const auto path = [&](const std::string& name) { return root_ / (folder_ + "/press/" + name); };
    std::filesystem::create_directories(root_ / (folder_ + "/press"));
    write_npy(path("time.npy"), {3}, std::vector<double>{0.0, 0.01, 0.02}.data());
    write_npy(path("phase.npy"), {3}, std::vector<std::uint8_t>{0, 2, 8}.data());
    write_npy(path("wrench.npy"), {3, 6}, numbers(18, -3.0, 0.25).data());
    write_npy(path("traction.npy"), {3, 24, 32, 2, 3}, numbers(3 * 24 * 32 * 6, -100.0, 0.5).data());
    write_npy(path("markers.npy"), {3, 2, 3}, numbers(18, -0.001, 0.0001).data());
    write_npy(path("contact_force.npy"), {3, 2, 2, 3}, numbers(36, -0.5, 0.03125).data());
    write_npy(path("contact_state.npy"), {3, 2}, std::vector<std::uint8_t>{0, 0, 1, 0, 2, 1}.data());
    write_npy(path("positions.npy"), {3, 4, 3}, numbers(36, 0.0, 0.001).data());
    write_npy(path("front_vertices.npy"), {2}, std::vector<std::int32_t>{1, 3}.data());
    write_npy(path("first_slip.npy"), {2}, std::vector<double>{0.02, std::numeric_limits<double>::infinity()}.data());
    // Identity; half a turn about z, so that the quaternion's sign is a matter of w = 0; −90° about x, moved.
    const std::vector<double> poses{1,  0, 0, 0,     0, 1,  0, 0,     0, 0,  1, 0,      0, 0, 0, 1,
                                    -1, 0, 0, 0,     0, -1, 0, 0,     0, 0,  1, 0,      0, 0, 0, 1,
                                    1,  0, 0, 0.001, 0, 0,  1, 0.002, 0, -1, 0, -0.003, 0, 0, 0, 1};
    write_npy(path("object_pose.npy"), {3, 4, 4}, poses.data());
    std::string per_frame;
    for (int f = 0; f < 3; ++f)
      per_frame += fmt::format(
          "    - {{press_force_n: {}, {}stand_off_m: 1.0e-05, min_volume_ratio: 0.5, intersections: 0, "
          "inverted_tets: 0, newton_iterations: {}, velocity_residual_m_s: 0.002, force_residual_n: 0.25, "
          "friction_residual_n: 0, balance_relative: 0.125, balance_n: 0.5, pose_error_m: 0, contact_area_mm2: 4, "
          "sticking: 1, slipping: {}}}\n",
          0.5 * f, f > 0 ? fmt::format("min_gap_m: {}, ", 1e-5 * (f + 1)) : "", 7 * f, f);
    write_file(
        path("press.yaml"),
        fmt::format("stage: press\nversion: 1-test\ninputs:\n{}summary:\n  frames: 3\n  element: linear\n  d_hat_m: "
                    "4.0e-05\n  friction_coefficient: 0.75\n  newton_iterations: 21\n  press_force_n: 1\n  "
                    "tangential_force_n: 0.5\n  min_distance_m: 1.0e-05\n  min_volume_ratio: 0.5\n  "
                    "max_balance_relative: 0.125\n  verdict: pass\n  limits: {{balance_relative: 0.001}}\n  "
                    "per_frame:\n{}",
                    inputs({{"config", "press.yaml"},
                            {"sensor", "toy.yaml"},
                            {"gel", "gel.msh"},
                            {"object", "object.ply"},
                            {"path", "path.csv"}}) +
                        input("sample", "../sample.yaml", root_ / (folder_ + "/sample.yaml")),
                    per_frame));
  }

  /// Adds stress to the press, of five tetrahedra, and its maps to the pictures.
  void write_stress() {
    const auto counted = [](std::size_t count, double unit) {
      std::vector<double> all(count);
      for (std::size_t i = 0; i < count; ++i) all[i] = unit * static_cast<double>(i);
      return all;
    };
    const auto path = [&](const std::string& name) { return root_ / (folder_ + "/press/" + name); };
    write_npy(path("stress.npy"), {3, 5, 6}, counted(90, 1.0).data());
    write_npy(path("front_pressure.npy"), {3, 2, 2}, counted(12, 10.0).data());
    write_npy(path("front_shear.npy"), {3, 2, 2, 3}, counted(36, 100.0).data());
    has_stress_ = true;
    write_render();
  }

  void write_render() {
    std::string outputs;
    const auto add = [&](const std::string& name, auto&& write) {
      const auto path = root_ / (folder_ + "/render/" + name);
      std::filesystem::create_directories(path.parent_path());
      write(path);
      outputs += fmt::format("  {}: {}\n", name, content_hash(path));
    };
    for (const int f : {0, 2}) {
      const std::string at = fmt::format("frame_{:04}/", f);
      add(at + "tactile.png", [&](const auto& path) { write_png(path, test_picture(f, 3)); });
      add(at + "red/tactile.png", [&](const auto& path) { write_png(path, test_picture(f + 5, 3)); });
      add(at + "indentation.exr", [&](const auto& path) { write_exr(path, test_map(f, 1, 1e-5f), {"Y"}); });
      add(at + "depth.exr", [&](const auto& path) { write_exr(path, test_map(f, 1, 1e-4f), {"Y"}); });
      add(at + "normal.exr", [&](const auto& path) { write_exr(path, test_map(f, 3, 0.25f), {"R", "G", "B"}); });
      if (has_stress_) {
        add(at + "pressure.exr", [&](const auto& path) { write_exr(path, test_map(f, 1, 1.0f), {"Y"}); });
        add(at + "shear.exr", [&](const auto& path) { write_exr(path, test_map(f, 3, 1.0f), {"R", "G", "B"}); });
      }
      add(at + "contact.png", [&](const auto& path) { write_png(path, levels({0, 255})); });
      add(at + "stick_slip.png", [&](const auto& path) { write_png(path, levels({0, 127, 254})); });
      add(at + "segment.png", [&](const auto& path) { write_png(path, levels({0, 60, 120, 180, 240})); });
      add(at + "marker_px.npy", [&](const auto& path) {
        const double hidden = f == 0 ? 2.5 : std::numeric_limits<double>::quiet_NaN();
        write_npy(path, {2, 2}, std::vector<double>{0.5 + f, 1.5, hidden, hidden}.data());
      });
    }
    write_file(
        root_ / (folder_ + "/render/render.yaml"),
        fmt::format("stage: render\nversion: 1-test\ninputs:\n{}outputs:\n{}reference: synthetic\nsummary:\n  frames: "
                    "[0, 2]\n  clipped_fraction: 0.25\n  max_indentation_mm: 1.5\n  variants:\n    - name: red\n",
                    inputs({{"config", "render.yaml"}, {"sensor", "toy.yaml"}}) +
                        input("press", "../press", root_ / (folder_ + "/press")),
                    outputs));
  }

 private:
  static ByteImage levels(const std::vector<std::uint8_t>& codes) {
    ByteImage image(4, 3, 1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = codes[i % codes.size()];
    return image;
  }
  static std::string input(const std::string& flag, const std::string& path, const std::filesystem::path& file) {
    return fmt::format("  {}: {{path: {}, hash: {}}}\n", flag, path, content_hash(file));
  }
  std::string inputs(const std::vector<std::pair<std::string, std::string>>& files) const {
    // As seen from <folder>/press, whatever its depth.
    std::string lines;
    for (const auto& [flag, name] : files) {
      const auto file = root_ / ("made_from/" + name);
      lines += input(flag, file.lexically_relative(root_ / (folder_ + "/press")).generic_string(), file);
    }
    return lines;
  }

  const ScratchFolder& root_;
  std::string folder_;
  bool has_stress_ = false;
};

}  // namespace tacipc
