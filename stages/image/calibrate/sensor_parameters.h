// Free values of a sensor file: their paths, and the sensor that results from them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/sensor/sensor.h"
#include "stages/image/calibrate/sensor_file.h"
#include "stages/image/calibrate/sensor_fit_config.h"

namespace tacipc {

/// Parameters u are in prior standard deviations from the prior's mean: u = (value − mean) / sigma.
class SensorParameters {
 public:
  /// \throw UsageError for a parameter that this sensor does not have, and for a mean or bound that gives no valid
  /// sensor
  SensorParameters(const std::filesystem::path& sensor, std::vector<FreeParameter> free);

  Eigen::Index count() const { return std::ssize(free_); }
  const std::string& name(Eigen::Index i) const { return free_[i].name; }
  double mean(Eigen::Index i) const { return *free_[i].mean; }
  double sigma(Eigen::Index i) const { return free_[i].sigma; }
  double value(Eigen::Index i, double u) const { return mean(i) + sigma(i) * u; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  /// Changes of the sensor file to these values.
  std::vector<SensorChange> changes(const Eigen::VectorXd& u) const;
  /// Sensor with these values.
  /// \throw DataError if they form no valid sensor together
  Sensor sensor(const Eigen::VectorXd& u) const;
  /// Sensor of the unchanged file.
  const Sensor& nominal() const { return nominal_; }
  /// Path of each LED's colour in the sensor file, without the colour's key: leds.ring.lit[0].
  const std::vector<std::string>& led_paths() const { return led_paths_; }

 private:
  using Values = std::map<std::string, double>;
  void read_nominal_values(ConfigReader& in);
  /// Sets the bounds of parameter i in prior standard deviations, and its mean if the configuration has none. `sensor`
  /// names the file.
  void set_bounds(Eigen::Index i, const std::string& sensor);
  std::vector<SensorChange> changes_of(const Values& values) const;

  Value content_;
  Sensor nominal_;
  Values nominal_values_;  // value of every parameter that this sensor has
  std::vector<FreeParameter> free_;
  Eigen::VectorXd lower_, upper_;
  std::vector<std::string> led_paths_;
  std::size_t ring_leds_ = 0;        // number of LEDs on the ring; they come first
  std::string window_key_ = {};      // key of `camera` that gives the field of view
  std::vector<double> window_ = {};  // value of that key
};

}  // namespace tacipc
