// Specification of an identification of a sensor's mechanics: parameters with priors, measurements, simulations.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Prior distribution of a number: normal, or log-normal if `logarithmic`, truncated to [low, high].
struct Prior {
  double mean = 0.0;
  double sigma = 0.0;  // standard deviation of the number, or of its natural logarithm
  double low = 0.0, high = 0.0;
  bool logarithmic = false;

  /// Reads `{mean, sigma}` or `{mean, factor}` (logarithmic: one standard deviation is this factor), and `bounds`,
  /// which lie within `natural` and default to it.
  static Prior read(ConfigReader& in, const Range& natural);
};

/// A parameter of the sensor. A parameter on which the press run depends has nodes: the values at which it is
/// simulated, ascending.
struct MechanicsParameter {
  std::string name;
  Prior prior;
  std::vector<double> nodes = {};
};

inline constexpr const char* kModulus = "youngs_modulus_pa";
inline constexpr const char* kPoisson = "poissons_ratio";
inline constexpr const char* kThickness = "thickness_mm";
inline constexpr const char* kFriction = "friction";
inline constexpr const char* kMount = "mount_compliance_mm_per_n";
inline constexpr const char* kShearMount = "mount_shear_compliance_mm_per_n";

/// Kind of a measurement: force over depth, force over travel, force over time, or marker displacements.
enum class MeasurementKind { press, shear, relaxation, markers };

/// A column of a table, and the factor that converts its numbers to the units and signs of this project.
struct MeasuredColumn {
  std::string quantity;
  std::string column;
  double factor = 1.0;
};

/// Marker displacements in two photographs of one press, with a shear between them.
struct MarkerMeasurement {
  std::string press_file, shear_file;                    // tables with columns Mx,My,dx,dy, px
  Eigen::Vector2d contact_px = Eigen::Vector2d::Zero();  // position of the ball when pressed
  double contact_sigma_px = 0.0;
  double shift_sigma_px = 0.0;  // standard deviation of the whole image's shift from rest to load
  double scale_sigma = 0.0;     // standard deviation of the whole image's scale from rest to load
  double sigma_px = 0.0;        // standard deviation of a coordinate of a measured displacement
  Prior depth_mm, travel_mm;
};

/// One measurement.
struct Measurement {
  std::string name;
  MeasurementKind kind = MeasurementKind::press;
  // The indenter: a ball, or a mesh below the shared data, tip on +z.
  std::optional<double> ball_radius_mm;
  double edge_mm = 0.0;  // longest edge of a ball, spacing of a mesh
  std::string mesh, unit;
  double edge_radius_mm = 0.0;
  Eigen::Vector2d center_mm = Eigen::Vector2d::Zero();  // position on the gel

  std::string file;                            // table below the shared data; for markers, the folder of the tables
  MeasuredColumn at, force;                    // depth, travel or time, and force, in each row
  double sigma_relative = 0.0, sigma_n = 0.0;  // standard deviation of a force
  std::optional<double> fit_to_mm;     // press: largest depth of rows that are fitted; deeper rows are predicted
  std::optional<Prior> depth_zero_mm;  // correction added to the table's depth; absent: 0
  double depth_mm = 0.0;               // shear, relaxation: depth of the press
  double ramp_s = 0.0;                 // relaxation: duration of the press
  std::vector<double> predict_mm;      // press: depths to predict, which need no row
  std::optional<MarkerMeasurement> markers;

  // Simulated runs.
  std::vector<double> depths_mm;  // largest depth alone, or ascending depths of sheared runs
  int press_frames = 0;           // frames of a press
  double travel_mm = 0.0;         // travel of a shear
  int shear_frames = 0;
  double direction_deg = 0.0;

  /// Returns whether the measurement has a shear.
  bool sheared() const { return kind == MeasurementKind::shear || kind == MeasurementKind::markers; }
};

/// A model check: the middle node simulated with a change. The change of the result estimates the model's own error.
struct ModelCheck {
  std::string name;
  std::string mesh, press;           // configurations that replace the spec's
  std::vector<std::string> changes;  // changes of the sensor file, as `tacipc set` takes them
};

/// One combination of nodes; the first parameter with nodes varies slowest.
struct RunNode {
  std::string name;            // n00, n01, …
  std::vector<double> values;  // values of the parameters with nodes
};

/// Contents of a file such as configs/studies/identify/gsmini_force.yaml. Paths of settings are relative to the file,
/// paths of data to the shared data.
struct IdentifySpec {
  std::string title;
  std::string sensor, mesh, press;
  std::vector<std::string> changes;  // changes of the sensor file, as `tacipc set` takes them
  int seed = 1;
  int draws = 0;    // number of draws from the posterior
  int members = 0;  // number of members of the ensemble
  std::vector<MechanicsParameter> parameters;
  std::vector<std::pair<MechanicsParameter, MechanicsParameter>> relaxation;  // fraction and time_s of each term
  std::vector<Measurement> measurements;
  std::vector<ModelCheck> checks;

  static IdentifySpec read(ConfigReader& in);
  /// Returns the parameter of this name, or null.
  const MechanicsParameter* find(const std::string& name) const;
  /// Returns the parameters with nodes, in the order kPoisson, kThickness, kFriction.
  std::vector<const MechanicsParameter*> axes() const;
  /// Returns all combinations of nodes.
  std::vector<RunNode> nodes() const;
  /// Returns the combination of the middle values (the lower one of an even number).
  RunNode middle() const;
};

/// Returns the name of one run of a measurement: the measurement's name, followed by the depth in µm if it is sheared.
std::string run_name(const Measurement& measurement, double depth_mm);

}  // namespace tacipc
