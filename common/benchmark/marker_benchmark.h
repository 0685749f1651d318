// A benchmark of marker displacements measured under a ball, pressed and then sheared, as one file.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Quantities that are fixed while depth and shear are fitted. A variant changes some of them.
struct MarkerAssumptions {
  double ball_radius_m = 0.0;
  double friction = 0.0;
  double px_per_m = 0.0;
  Eigen::Vector2d contact_px = Eigen::Vector2d::Zero();  // position of the ball after the press: column, row
};

/// A variant of the assumptions.
struct MarkerVariant {
  std::string name;
  MarkerAssumptions assumed;
  std::optional<double> gel_thickness_m = std::nullopt;  // thickness that replaces the sensor's
  bool own_runs = false;  // another ball, friction or gel, so that the base's simulations do not apply
};

/// Contents of a file such as configs/studies/fots/fots_markers.yaml. Paths of settings are relative to the file, paths
/// of data to a folder below the shared data.
struct MarkerBenchmark {
  std::string title;
  std::string data;        // folder below the shared data
  std::string press_file;  // file below `data`: markers after the press
  std::string shear_file;  // markers after the shear; both hold rest positions and displacements since rest, px
  bool remove_press_median = false;
  bool remove_shear_median = false;
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d shear_marker_px = Eigen::Vector2d::Zero();  // rest position of the marker that the shear is fitted to
  double least_length_px = 0.0;                // smallest measured length for which directions are compared
  double direction_deg = 0.0;                  // direction of the shear: 0 along x, 90 along y
  double ball_edge_m = 0.0;                    // longest edge of the ball's mesh
  std::string sensor, mesh, press;             // configurations of the stages
  double shallowest_m = 0.0, deepest_m = 0.0;  // smallest and largest depth of the sheared runs
  int depths = 0;                              // number of depths, evenly spaced
  double press_step_m = 0.0;                   // depth between frames of the press
  double shear_m = 0.0;
  int shear_steps = 0;
  MarkerAssumptions assumed;
  std::vector<MarkerVariant> variants;

  static MarkerBenchmark read(ConfigReader& in);
  /// Returns the simulated depths, ascending, m.
  std::vector<double> depths_m() const;
};

}  // namespace tacipc
