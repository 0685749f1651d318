// The free values of a sensor file: where they stand, and the sensor they make.
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

/// Parameters u are counted in prior deviations from the prior's mean: u = (value − mean) / sigma.
class SensorParameters {
 public:
  /// \throw UsageError for a parameter that this sensor does not have, and for a mean or bound that makes no valid
  /// sensor.
  SensorParameters(const std::filesystem::path& sensor, std::vector<FreeParameter> free);

  Eigen::Index count() const { return std::ssize(free_); }
  const std::string& name(Eigen::Index i) const { return free_[i].name; }
  double mean(Eigen::Index i) const { return *free_[i].mean; }
  double sigma(Eigen::Index i) const { return free_[i].sigma; }
  double value(Eigen::Index i, double u) const { return mean(i) + sigma(i) * u; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  /// What the sensor file says with these values.
  std::vector<SensorChange> changes(const Eigen::VectorXd& u) const;
  /// \throw DataError if they make no valid sensor together
  Sensor sensor(const Eigen::VectorXd& u) const;
  /// The file as it is.
  const Sensor& nominal() const { return nominal_; }
  /// Where the colour of each of the sensor's LEDs stands, without the colour's key: leds.ring.lit[0].
  const std::vector<std::string>& led_paths() const { return led_paths_; }

 private:
  using Values = std::map<std::string, double>;
  void read_nominal_values(ConfigReader& in);
  /// Of parameter i in prior deviations; its mean too, if the configuration has none. `sensor` names the file.
  void set_bounds(Eigen::Index i, const std::string& sensor);
  std::vector<SensorChange> changes_of(const Values& values) const;

  Value content_;
  Sensor nominal_;
  Values nominal_values_;  // of every parameter that this sensor has
  std::vector<FreeParameter> free_;
  Eigen::VectorXd lower_, upper_;
  std::vector<std::string> led_paths_;
  std::size_t ring_leds_ = 0;        // they come first
  std::string window_key_ = {};      // of `camera`: how the file says what the camera sees
  std::vector<double> window_ = {};  // and what it says
};

}  // namespace tacipc
