// A benchmark against photographs, as one file: images, objects with their depths, positions in the image.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/contact_circles.h"
#include "common/config/config.h"

namespace tacipc {

/// Reads a text that Make and the shell take as one word, or a path of such words; any other text is an error.
std::string plain(ConfigReader& in, const std::string& key);

/// Reads a list of two numbers. If there is a fallback, the key may be absent.
Eigen::Vector2d pair_of(ConfigReader& in, const std::string& key, std::vector<double> fallback = {});

/// Reads x, y, width and height of a region of an image.
std::array<int, 4> pixel_box(ConfigReader& in, const std::string& key);

/// A photograph of an object pressed to a known depth, or of a ball of which only the contact circle is known.
struct PhotographCase {
  std::string name;
  double depth_m = 0.0;
  std::string photograph = {};  // file name below `photographs`
  std::array<int, 4> box_px{};  // x, y, width, height of the contact
  std::optional<BallLabel> circle = std::nullopt;
};

/// An object and its photographs.
struct ObjectCase {
  std::string name;
  std::optional<double> ball_radius_m;  // radius of a ball; absent: `mesh` is used
  std::string mesh;                     // mesh below the data folder, tip on +z
  std::string unit;
  double edge_radius_m = 0.0;
  std::array<double, 2> center_px{};
  std::array<int, 4> box_px{};  // x, y, width, height of the contact
  std::string fit_image;        // image to which centre and yaw are fitted; empty if contact circles give the position
  bool fit_yaw = false;
  std::string calibrates;  // image that calibrates the light in addition to the balls, and is excluded from means
  std::vector<PhotographCase> images;  // photographs in order of increasing depth
};

/// Contents of a file such as configs/studies/sim2real/gelsight_sim2real.yaml. Paths of settings are relative to the
/// file, paths of data to a folder below the shared data.
struct BenchmarkCases {
  std::string title;
  std::string data;        // folder below the shared data
  std::string background;  // path below `data`, as the next two
  std::string photographs;
  std::string labels;                                    // label file of the ball presses
  std::string ending;                                    // suffix of the photographs' names
  std::string sensor, mesh, press, calibrate, baseline;  // configurations of the stages
  double ball_radius_m = 0.0;                            // ball of the calibration presses
  double ball_depth_m = 0.0;                             // deepest frame of their simulation
  int ball_steps = 0;
  double mesh_spacing_m = 0.0;  // spacing for rounded meshes
  double ball_edge_m = 0.0;     // longest edge of ball meshes
  /// Limits in the box: smallest mean ssim_s, largest mean mae, smallest mean psnr_db. Absent: TacIPC must only be the
  /// best.
  std::optional<std::array<double, 3>> must;
  std::string circles;                       // table of contact circles below `data`
  std::optional<CircleTable> circle_table;   // columns of that table; replaces background, labels and objects
  std::vector<BallLabel> labels_of_circles;  // photographs that calibrate; `image` is their file
  std::vector<ObjectCase> objects;

  static BenchmarkCases read(ConfigReader& in);
};

/// For benchmarks with `circles`, reads labels from the table at `path`, and one object `ball` with an image per test
/// photograph and a contact box about its circle. Leaves other benchmarks unchanged.
/// \throw DataError if the table is faulty or leaves no photograph to test
/// \throw UsageError if a table is given but not named by the benchmark, or the reverse
void add_circles(BenchmarkCases& cases, const std::optional<std::filesystem::path>& path);

}  // namespace tacipc
