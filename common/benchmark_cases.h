// A benchmark against photographs as one file: which images, which objects at which depths, where in the image.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/config.h"

namespace tacipc {

/// A photograph `<name><ending>` of an object pressed to a depth.
struct PhotographCase {
  std::string name;
  double depth_m = 0.0;
};

struct ObjectCase {
  std::string name;
  std::optional<double> ball_radius_m;  // a ball …
  std::string mesh;                     // … or a mesh below the data folder, tip on +z
  std::string unit;
  double edge_radius_m = 0.0;
  std::array<double, 2> center_px{};
  std::array<int, 4> box_px{};  // x, y, width, height of the contact
  std::string fit_image;        // the one that centre and yaw are fitted to
  bool fit_yaw = false;
  std::vector<PhotographCase> images;  // ever deeper
};

/// configs/benchmarks/gelsight_sim2real.yaml and files like it. Paths of settings are relative to the file, those of
/// data to a folder below the shared data.
struct BenchmarkCases {
  std::string title;
  std::string data;        // folder below the shared data
  std::string background;  // below `data`, as the two that follow
  std::string photographs;
  std::string labels;                                    // of the ball presses
  std::string ending;                                    // of the photographs' names
  std::string sensor, mesh, press, calibrate, baseline;  // configurations of the stages
  double ball_radius_m = 0.0;                            // of the calibration presses
  double ball_depth_m = 0.0;                             // deepest frame of their simulation
  int ball_steps = 0;
  double mesh_spacing_m = 0.0;   // of rounded meshes
  double ball_edge_m = 0.0;      // longest edge of balls
  std::array<double, 3> must{};  // least mean ssim_s, largest mean mae, least mean psnr_db in the box
  std::vector<ObjectCase> objects;

  static BenchmarkCases read(ConfigReader& in);
};

}  // namespace tacipc
