// A benchmark against photographs as one file: which images, which objects at which depths, where in the image.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/contact_circles.h"
#include "common/config/config.h"

namespace tacipc {

/// A text that Make and the shell take for one word, or a path of such words; anything else is a fault.
std::string plain(ConfigReader& in, const std::string& key);

/// Two numbers of a list; with a fallback the key may be absent.
Eigen::Vector2d pair_of(ConfigReader& in, const std::string& key, std::vector<double> fallback = {});

/// x, y, width and height of a part of an image.
std::array<int, 4> pixel_box(ConfigReader& in, const std::string& key);

/// A photograph of an object pressed to a depth, or of a ball whose contact circle alone is known.
struct PhotographCase {
  std::string name;
  double depth_m = 0.0;
  std::string photograph = {};  // file below `photographs`
  std::array<int, 4> box_px{};  // x, y, width, height of the contact
  std::optional<BallLabel> circle = std::nullopt;
};

struct ObjectCase {
  std::string name;
  std::optional<double> ball_radius_m;  // a ball …
  std::string mesh;                     // … or a mesh below the data folder, tip on +z
  std::string unit;
  double edge_radius_m = 0.0;
  std::array<double, 2> center_px{};
  std::array<int, 4> box_px{};  // x, y, width, height of the contact
  std::string fit_image;        // the one that centre and yaw are fitted to; none where circles tell the place
  bool fit_yaw = false;
  std::string calibrates;              // the one that calibrates the light beside the balls, and counts in no mean
  std::vector<PhotographCase> images;  // ever deeper
};

/// configs/studies/sim2real/gelsight_sim2real.yaml and files like it. Paths of settings are relative to the file, those
/// of data to a folder below the shared data.
struct BenchmarkCases {
  std::string title;
  std::string data;        // folder below the shared data
  std::string background;  // below `data`, as those that follow
  std::string photographs;
  std::string labels;                                    // of the ball presses
  std::string ending;                                    // of the photographs' names
  std::string sensor, mesh, press, calibrate, baseline;  // configurations of the stages
  double ball_radius_m = 0.0;                            // of the calibration presses
  double ball_depth_m = 0.0;                             // deepest frame of their simulation
  int ball_steps = 0;
  double mesh_spacing_m = 0.0;  // of rounded meshes
  double ball_edge_m = 0.0;     // longest edge of balls
  /// Least mean ssim_s, largest mean mae, least mean psnr_db in the box; without it ours must be ahead, no more.
  std::optional<std::array<double, 3>> must;
  std::string circles;                       // table of contact circles below `data` …
  std::optional<CircleTable> circle_table;   // … in place of background, labels and objects
  std::vector<BallLabel> labels_of_circles;  // the photographs that calibrate, `image` their file
  std::vector<ObjectCase> objects;

  static BenchmarkCases read(ConfigReader& in);
};

/// Benchmarks with `circles`: labels, and one object `ball` with an image per photograph that tests, its contact box
/// about the circle, from the table at `path`. Others stay as they are. \throw DataError for a fault of the table, or
/// if no photograph is left to test; UsageError if a table is given that the benchmark does not name, or the reverse
void add_circles(BenchmarkCases& cases, const std::optional<std::filesystem::path>& path);

}  // namespace tacipc
