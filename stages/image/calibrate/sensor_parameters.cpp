#include "stages/image/calibrate/sensor_parameters.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

Value triple(const Vector3& v) { return Value::List{v.x(), v.y(), v.z()}; }

}  // namespace

SensorParameters::SensorParameters(const std::filesystem::path& sensor, std::vector<FreeParameter> free)
    : free_(std::move(free)) {
  ConfigReader in = ConfigReader::from_file(sensor);
  content_ = in.content();
  nominal_ = Sensor::read(in);
  in.finish();
  if (nominal_.leds.empty())
    throw UsageError(fmt::format("{} has no leds, whose colours sensor_fit could fit", sensor.string()));
  read_nominal_values(in);
  lower_.resize(count());
  upper_.resize(count());
  for (Eigen::Index i = 0; i < count(); ++i) set_bounds(i, sensor.string());
}

void SensorParameters::read_nominal_values(ConfigReader& in) {
  Values& have = nominal_values_;
  ConfigReader leds = in.section("leds"), camera = in.section("camera");
  if (auto ring = leds.optional_section("ring")) {
    have["ring_radius_mm"] = ring->number("radius_mm");
    have["ring_z_mm"] = ring->number("z_mm");
    have["ring_azimuth_deg"] = ring->number_or("first_azimuth_deg", 0.0);
    have["ring_tilt_deg"] = ring->number_or("tilt_deg", 0.0);
    ring_leds_ = ring->sections("lit").size();
  }
  for (std::size_t i = 0; i < nominal_.leds.size(); ++i)
    led_paths_.push_back(i < ring_leds_ ? fmt::format("leds.ring.lit[{}]", i)
                                        : fmt::format("leds.list[{}]", i - ring_leds_));
  if (nominal_.leds.size() > ring_leds_) {
    for (const char* name : {"list_x_mm", "list_y_mm", "list_z_mm", "list_azimuth_deg"}) have[name] = 0.0;
    have["list_scale"] = 1.0;
  }
  if (leds.has("emission_exponent")) have["emission_exponent"] = leds.number("emission_exponent");
  const bool rectified = nominal_.camera.model == Camera::Model::rectified;
  for (int k = 0; k < 3; ++k) {
    const char axis = "xyz"[k];
    have[fmt::format("camera_{}_mm", axis)] = 1e3 * nominal_.camera.position_m[k];
    if (k == 2 || !rectified)
      have[fmt::format("camera_rotation_{}_deg", axis)] = kDegrees * nominal_.camera.rotation_rad[k];
  }
  for (const auto& [key, length] : {std::pair{"window_mm", 2u}, {"intrinsics_px", 4u}}) {
    if (!camera.has(key)) continue;
    window_key_ = key;
    window_ = camera.numbers(key, length);
  }
  if (camera.has("horizontal_fov_deg")) {
    window_key_ = "horizontal_fov_deg";
    window_ = {camera.number("horizontal_fov_deg")};
  }
  have["window_scale"] = 1.0;
  have["vignetting_v2"] = nominal_.camera.vignetting[0];
  have["vignetting_v4"] = nominal_.camera.vignetting[1];
  have["gamma"] = nominal_.response.curve == "linear" ? 1.0 : nominal_.response.gamma;
  if (nominal_.coating.specular_f0 > 0.0) {
    have["specular_f0"] = nominal_.coating.specular_f0;
    have["ggx_alpha"] = nominal_.coating.ggx_alpha;
  }
}

void SensorParameters::set_bounds(Eigen::Index i, const std::string& sensor) {
  FreeParameter& p = free_[i];
  const auto nominal = nominal_values_.find(p.name);
  if (nominal == nominal_values_.end()) {
    std::vector<std::string> names;
    for (const std::string& name : parameter_names())
      if (nominal_values_.contains(name)) names.push_back(name);
    throw UsageError(
        fmt::format("sensor_fit.parameters.{}: {} has none; it has {}", p.name, sensor, fmt::join(names, ", ")));
  }
  if (!p.mean) p.mean = nominal->second;
  // Error of the sensor at a value; empty if there is none.
  const auto fault_at = [&](double value) {
    try {
      changed_sensor(content_, changes_of({{p.name, value}}));
      return std::string();
    } catch (const DataError& error) {
      return std::string(error.what());
    }
  };
  std::array<double, 2> bounds = p.bounds.value_or(std::array{*p.mean - 4 * p.sigma, *p.mean + 4 * p.sigma});
  if (!p.bounds && fault_at(*p.mean).empty())
    for (double& bound : bounds)
      for (int tries = 50; !fault_at(bound).empty(); --tries)
        bound = tries > 0 ? *p.mean + 0.9 * (bound - *p.mean) : *p.mean;  // the mean itself may be an end
  if (*p.mean < bounds[0] || *p.mean > bounds[1])
    throw UsageError(fmt::format("sensor_fit.parameters.{}: its mean, {:g}, is outside its bounds, {:g} … {:g}", p.name,
                                 *p.mean, bounds[0], bounds[1]));
  lower_[i] = (bounds[0] - *p.mean) / p.sigma;
  upper_[i] = (bounds[1] - *p.mean) / p.sigma;
  for (const double value : {*p.mean, bounds[0], bounds[1]}) {
    const std::string fault = fault_at(value);
    if (fault.empty()) continue;
    throw UsageError(fmt::format("sensor_fit.parameters.{}: {:g} makes no valid sensor; give other bounds{}", p.name,
                                 value, fault.substr(fault.find('\n'))));
  }
}

std::vector<SensorChange> SensorParameters::changes(const Eigen::VectorXd& u) const {
  Values values;
  for (Eigen::Index i = 0; i < count(); ++i) values[name(i)] = value(i, u[i]);
  return changes_of(values);
}

Sensor SensorParameters::sensor(const Eigen::VectorXd& u) const { return changed_sensor(content_, changes(u)); }

std::vector<SensorChange> SensorParameters::changes_of(const Values& values) const {
  std::vector<SensorChange> out;
  const auto given = [&](const std::string& name) { return values.contains(name); };
  // A value that is not free comes from the file.
  const auto at = [&](const std::string& name) { return given(name) ? values.at(name) : nominal_values_.at(name); };
  const auto put = [&](const std::string& name, const std::string& path) {
    if (given(name)) out.push_back({path, values.at(name)});
  };
  put("ring_radius_mm", "leds.ring.radius_mm");
  put("ring_z_mm", "leds.ring.z_mm");
  put("ring_azimuth_deg", "leds.ring.first_azimuth_deg");
  put("ring_tilt_deg", "leds.ring.tilt_deg");
  put("emission_exponent", "leds.emission_exponent");
  const bool turns = given("list_azimuth_deg");
  if (turns || given("list_x_mm") || given("list_y_mm") || given("list_z_mm") || given("list_scale")) {
    const Matrix3 turn = Eigen::AngleAxisd(at("list_azimuth_deg") / kDegrees, Vector3::UnitZ()).toRotationMatrix();
    const Vector3 shift(at("list_x_mm"), at("list_y_mm"), at("list_z_mm"));
    const Vector3 scale(at("list_scale"), at("list_scale"), 1.0);
    for (std::size_t i = ring_leds_; i < nominal_.leds.size(); ++i) {
      const Led& led = nominal_.leds[i];
      out.push_back({led_paths_[i] + ".position_mm", triple(turn * scale.cwiseProduct(1e3 * led.position_m) + shift)});
      if (turns) out.push_back({led_paths_[i] + ".normal", triple(turn * led.normal)});
    }
  }
  if (given("camera_x_mm") || given("camera_y_mm") || given("camera_z_mm"))
    out.push_back({"camera.position_mm", triple({at("camera_x_mm"), at("camera_y_mm"), at("camera_z_mm")})});
  if (given("camera_rotation_x_deg") || given("camera_rotation_y_deg") || given("camera_rotation_z_deg")) {
    Vector3 rotation = kDegrees * nominal_.camera.rotation_rad;
    for (int k = 0; k < 3; ++k) {
      const std::string turn = fmt::format("camera_rotation_{}_deg", "xyz"[k]);
      if (given(turn)) rotation[k] = values.at(turn);
    }
    out.push_back({"camera.rotation_deg", triple(rotation)});
  }
  if (given("window_scale")) {
    const double scale = values.at("window_scale");
    std::vector<double> window = window_;
    if (window_key_ == "window_mm") {
      for (double& edge : window) edge *= scale;
    } else if (window_key_ == "intrinsics_px") {
      window[0] /= scale;
      window[1] /= scale;
    } else {
      const double half = 0.5 * window[0] / kDegrees;
      window[0] = 2.0 * kDegrees *
                  (nominal_.camera.model == Camera::Model::fisheye ? scale * half : std::atan(scale * std::tan(half)));
    }
    out.push_back({"camera." + window_key_, window.size() > 1 ? Value(window) : Value(window[0])});
  }
  put("vignetting_v2", "camera.vignetting.v2");
  put("vignetting_v4", "camera.vignetting.v4");
  if (given("gamma")) {
    out.push_back({"response.curve", "gamma"});
    out.push_back({"response.gamma", values.at("gamma")});
  }
  put("specular_f0", "coating.specular_f0");
  put("ggx_alpha", "coating.ggx_alpha");
  return out;
}

}  // namespace tacipc
