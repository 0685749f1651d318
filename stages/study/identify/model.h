// Predicts the measurements for given mechanics, and computes the residuals.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/identify_spec.h"
#include "common/benchmark/measured_field.h"
#include "common/benchmark/pressed_runs.h"
#include "common/sensor/camera_model.h"
#include "stages/study/identify/force_model.h"
#include "stages/study/identify/node_grid.h"
#include "stages/study/identify/parameters.h"

namespace tacipc {

/// A row of a table: depth (mm), travel (mm) or time (s), and force (N).
struct MeasuredForce {
  double at = 0.0;
  double force_n = 0.0;
  double sigma_n = 0.0;
};

/// Measured forces and their simulations.
struct ForceData {
  std::vector<MeasuredForce> fitted, held_out;
  CurveTable press;                // force, N per Pa, over depth, mm
  std::vector<CurveTable> shears;  // tangential force over travel, for each depth of Measurement::depths_mm
};

/// Measured marker vectors and their simulations.
struct MarkerData {
  std::vector<PressedRuns> runs;  // simulated runs of each node
  MarkerField press, shear;
};

/// Data of one measurement; exactly one of the two is set.
struct MeasurementData {
  std::optional<ForceData> force;
  std::optional<MarkerData> markers;
};

/// Model of all measurements of an identification.
class MechanicsModel {
 public:
  /// \param data in the order of spec.measurements
  /// \param held the sensor's own mechanics, for parameters that are not fitted
  MechanicsModel(const IdentifySpec& spec, std::vector<MeasurementData> data, const Sensor& held);

  const IdentifySpec& spec() const { return spec_; }
  const Unknowns& unknowns() const { return unknowns_; }
  const MeasurementData& data(std::size_t measurement) const { return data_[measurement]; }

  /// Predicted fitted rows of a measurement: forces, N, or displacements, px (x and y of each fitted marker of the
  /// press, then of the shear).
  Eigen::VectorXd predicted(std::size_t measurement, const Eigen::VectorXd& u) const;
  /// Measured values of these rows, and their standard deviations.
  Eigen::VectorXd measured(std::size_t measurement) const;
  Eigen::VectorXd sigma(std::size_t measurement) const;
  /// Predicted force of a press to a depth on the table's scale, N. `depth_mm` in mm.
  double press_force_n(std::size_t measurement, const Eigen::VectorXd& u, double depth_mm) const;
  /// Predicted marker displacements of the press (first) and of the shear (second), px; 2 × markers.
  std::pair<Eigen::Matrix2Xd, Eigen::Matrix2Xd> marker_px(std::size_t measurement, const Eigen::VectorXd& u) const;

  /// Fitted markers: all, or only the even or odd ones, so that the others are predictions.
  enum class Markers { all, even, odd };
  Markers fitted_markers = Markers::all;
  bool fits_marker(Eigen::Index i) const {
    return fitted_markers == Markers::all || (i % 2 == 0) == (fitted_markers == Markers::even);
  }
  /// Factors on the measurements' standard deviations (1 unless the fit found them too small).
  std::vector<double> sigma_factor;
  /// (predicted − measured) / deviation of the fitted rows of a measurement.
  Eigen::VectorXd off(std::size_t measurement, const Eigen::VectorXd& u) const {
    return (predicted(measurement, u) - measured(measurement)).cwiseQuotient(sigma(measurement));
  }
  /// Residuals off() of every measurement, then (u − mean) / deviation of every prior.
  Eigen::VectorXd residuals(const Eigen::VectorXd& u) const;
  Eigen::Index rows() const;  // number of fitted rows, without priors
  Eigen::Vector2d camera_px() const { return {held_.camera.width_px, held_.camera.height_px}; }

 private:
  Eigen::VectorXd fitted_coordinates(const Eigen::Matrix2Xd& press, const Eigen::Matrix2Xd& shear) const;
  Mounting mounting(const Eigen::VectorXd& u) const;
  Eigen::VectorXd node_weights(const Eigen::VectorXd& u) const;
  double zero_mm(std::size_t measurement, const Eigen::VectorXd& u) const;

  IdentifySpec spec_;
  Unknowns unknowns_;
  NodeGrid grid_;
  std::vector<MeasurementData> data_;
  Sensor held_;
  std::optional<CameraModel> camera_;
};

}  // namespace tacipc
