// What a sensor's mechanics are identified from, as one file: parameters with priors, measurements, what is simulated.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// What is known of a number before the measurements: normal, or with `logarithmic` its logarithm is; none outside
/// [low, high].
struct Prior {
  double mean = 0.0;
  double sigma = 0.0;  // of the number, or of its natural logarithm
  double low = 0.0, high = 0.0;
  bool logarithmic = false;

  /// `{mean, sigma}` or `{mean, factor}` (logarithmic: one deviation is a factor of that), and `bounds`, which lie
  /// within `natural` and are that where they are not given.
  static Prior read(ConfigReader& in, const Range& natural);
};

/// A parameter of the sensor. One that the press has to be run for has nodes: values it is run at, ascending.
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

enum class MeasurementKind { press, shear, relaxation, markers };

/// A column of a table, and what its numbers are multiplied by to be in our units and signs.
struct MeasuredColumn {
  std::string quantity;
  std::string column;
  double factor = 1.0;
};

/// Marker vectors in two photographs of one press, which is dragged between them.
struct MarkerMeasurement {
  std::string press_file, shear_file;                    // Mx,My,dx,dy, px
  Eigen::Vector2d contact_px = Eigen::Vector2d::Zero();  // the ball's place when pressed
  double contact_sigma_px = 0.0;
  double shift_sigma_px = 0.0;  // of the image as a whole between the photographs at rest and under load
  double scale_sigma = 0.0;     // alike
  double sigma_px = 0.0;        // of a coordinate of a measured vector
  Prior depth_mm, travel_mm;
};

struct Measurement {
  std::string name;
  MeasurementKind kind = MeasurementKind::press;
  // The indenter: a ball, or a mesh below the shared data, tip on +z.
  std::optional<double> ball_radius_mm;
  double edge_mm = 0.0;  // longest edge of a ball, spacing of a mesh
  std::string mesh, unit;
  double edge_radius_mm = 0.0;
  Eigen::Vector2d center_mm = Eigen::Vector2d::Zero();  // on the gel

  std::string file;                            // table below the shared data (of markers the fields' folder)
  MeasuredColumn at, force;                    // depth, travel or time, and force, of each row
  double sigma_relative = 0.0, sigma_n = 0.0;  // of a force
  std::optional<double> fit_to_mm;             // press: deeper rows are predicted, not fitted
  std::optional<Prior> depth_zero_mm;          // by which the gel is deeper than the table says; absent: 0
  double depth_mm = 0.0;                       // shear, relaxation: of the press
  double ramp_s = 0.0;                         // relaxation: how long the press took
  std::vector<double> predict_mm;              // press: depths of which no row is needed
  std::optional<MarkerMeasurement> markers;

  // What is simulated.
  std::vector<double> depths_mm;  // press, relaxation: the deepest alone; else of each run that is sheared, ascending
  int press_frames = 0;           // of a press
  double travel_mm = 0.0;         // of a shear
  int shear_frames = 0;
  double direction_deg = 0.0;

  bool sheared() const { return kind == MeasurementKind::shear || kind == MeasurementKind::markers; }
};

/// The middle of all nodes pressed with something changed: what that changes is the model's own error.
struct ModelCheck {
  std::string name;
  std::string mesh, press;           // configurations in place of the case's …
  std::vector<std::string> changes;  // … or changes of the sensor file, as `tacipc set` takes them
};

/// One combination of nodes; the first parameter with nodes varies slowest.
struct RunNode {
  std::string name;            // n00, n01, …
  std::vector<double> values;  // of the parameters with nodes
};

/// configs/studies/identify/gsmini_force.yaml and files like it. Paths of settings are relative to the file, those of
/// data to the shared data.
struct IdentifySpec {
  std::string title;
  std::string sensor, mesh, press;
  std::vector<std::string> changes;  // of the sensor file, as `tacipc set` takes them
  int seed = 1;
  int draws = 0;    // from the posterior
  int members = 0;  // of the ensemble
  std::vector<MechanicsParameter> parameters;
  std::vector<std::pair<MechanicsParameter, MechanicsParameter>> relaxation;  // part and time_s of each term
  std::vector<Measurement> measurements;
  std::vector<ModelCheck> checks;

  static IdentifySpec read(ConfigReader& in);
  const MechanicsParameter* find(const std::string& name) const;
  /// Those with nodes, in the order of kPoisson, kThickness, kFriction.
  std::vector<const MechanicsParameter*> axes() const;
  std::vector<RunNode> nodes() const;
  /// That of the middle value of each axis (the lower one of an even number).
  RunNode middle() const;
};

/// Name of one run of a measurement: that of the measurement, and for those that are sheared the depth in µm.
std::string run_name(const Measurement& measurement, double depth_mm);

}  // namespace tacipc
