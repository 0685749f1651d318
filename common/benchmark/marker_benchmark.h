// A benchmark of marker vectors measured under a ball, pressed and then dragged, as one file.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// What is held while depth and shear are fitted. A variant changes some of it.
struct MarkerAssumptions {
  double ball_radius_m = 0.0;
  double friction = 0.0;
  double px_per_m = 0.0;
  Eigen::Vector2d contact_px = Eigen::Vector2d::Zero();  // where the ball stands after the press; column, row
};

struct MarkerVariant {
  std::string name;
  MarkerAssumptions assumed;
  std::optional<double> gel_thickness_m = std::nullopt;  // in place of the sensor's
  bool own_runs = false;  // another ball, friction or gel: what was simulated for the base does not serve
};

/// configs/studies/fots/fots_markers.yaml and files like it. Paths of settings are relative to the file, those of data
/// to a folder below the shared data.
struct MarkerBenchmark {
  std::string title;
  std::string data;        // folder below the shared data
  std::string press_file;  // below `data`: markers after the press …
  std::string shear_file;  // … and after the shear; rest place and displacement since rest, px
  bool remove_press_median = false;
  bool remove_shear_median = false;
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d shear_marker_px = Eigen::Vector2d::Zero();  // rest place of the marker that the shear is fitted to
  double least_length_px = 0.0;                               // of a measured vector whose direction is compared
  double direction_deg = 0.0;                                 // of the shear: 0 along x, 90 along y
  double ball_edge_m = 0.0;                                   // longest edge of its mesh
  std::string sensor, mesh, press;                            // configurations of the stages
  double shallowest_m = 0.0, deepest_m = 0.0;                 // of the presses that are sheared
  int depths = 0;                                             // how many, evenly
  double press_step_m = 0.0;                                  // between frames of the press
  double shear_m = 0.0;
  int shear_steps = 0;
  MarkerAssumptions assumed;
  std::vector<MarkerVariant> variants;

  static MarkerBenchmark read(ConfigReader& in);
  /// The depths that are simulated, ascending, m.
  std::vector<double> depths_m() const;
};

}  // namespace tacipc
