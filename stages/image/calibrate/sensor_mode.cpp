#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/sensor/camera_image.h"
#include "stages/image/calibrate/modes.h"
#include "stages/image/calibrate/sensor_fit.h"

namespace tacipc {
namespace {

/// Picture of eight times the fit's residual around grey, in the photograph's size; black where blocks do not count.
ByteImage residual_picture(const FloatImage& residual, int block) {
  ByteImage out(residual.width * block, residual.height * block, 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float codes = residual.at(x / block, y / block, c);
        if (std::isfinite(codes))
          out.at(x, y, c) = static_cast<std::uint8_t>(std::clamp(std::lround(128.0 + 8.0 * codes), 1L, 255L));
      }
  return out;
}

std::vector<BallPhotograph> read_balls(const Stage& stage, const Camera& camera) {
  std::vector<BallPhotograph> balls;
  for (BallLabel& label : read_labels(*stage.optional_input("--labels"))) {
    ByteImage image = read_photograph(*stage.optional_input("--photographs") / label.image, camera);
    balls.push_back({std::move(image), std::move(label)});
  }
  return balls;
}

Value::List parameter_lines(const SensorParameters& parameters, const SensorFit& fit) {
  Value::List lines;
  for (Eigen::Index i = 0; i < parameters.count(); ++i) {
    // The prior contributed the fraction σ²/σ_prior² of the final knowledge of a parameter.
    const double share = fit.covariance(i, i), deviation = std::sqrt(share);
    lines.push_back(Value::Map{{"name", parameters.name(i)},
                               {"value", parameters.value(i, fit.u[i])},
                               {"sigma", parameters.sigma(i) * deviation},
                               {"prior_mean", parameters.mean(i)},
                               {"prior_sigma", parameters.sigma(i)},
                               {"sigma_over_prior", deviation},
                               {"told_by", share > 0.5 ? "prior" : "photographs"},
                               {"at_bound", static_cast<bool>(fit.at_bound[i])}});
  }
  return lines;
}

Value::List covariance_rows(const SensorParameters& parameters, const SensorFit& fit) {
  Value::List rows;
  for (Eigen::Index i = 0; i < parameters.count(); ++i) {
    Value::List row;
    for (Eigen::Index j = 0; j < parameters.count(); ++j)
      row.push_back(parameters.sigma(i) * parameters.sigma(j) * fit.covariance(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

Value::List three(const Eigen::RowVector3d& v) { return {v[0], v[1], v[2]}; }

Value::List color_lines(const Sensor& sensor, const SensorFit& fit) {
  Value::List lines;
  const auto groups = light_groups(sensor.leds);
  const double exposure = fit.rgb.maxCoeff();  // factor that the sensor file separates from the colours
  for (std::size_t g = 0; g <= groups.size(); ++g) {
    const auto row = static_cast<Eigen::Index>(g);
    Value::Map line;
    if (g == groups.size())
      line.emplace_back("name", "ambient");
    else if (!groups[g].name.empty())
      line.emplace_back("name", groups[g].name);
    if (g < groups.size()) line.emplace_back("leds", Value::List(groups[g].leds.begin(), groups[g].leds.end()));
    Eigen::RowVector3d value = fit.veil.transpose();
    if (g < groups.size()) value = fit.rgb.row(row);
    line.emplace_back("rgb", three(value / exposure));
    line.emplace_back("sigma", three(fit.color_sigma.row(row) / exposure));
    lines.emplace_back(std::move(line));
  }
  return lines;
}

Value::Map summary_of(const SensorParameters& parameters, const SensorFit& fit) {
  Value::List photographs, balls;
  for (const PhotographFit& one : fit.photographs)
    photographs.push_back(
        Value::Map{{"name", one.name},
                   {"blocks", Value::List{one.blocks[0], one.blocks[1], one.blocks[2]}},
                   {"rmse_codes", Value::List{one.rmse_codes[0], one.rmse_codes[1], one.rmse_codes[2]}}});
  for (const BallFit& ball : fit.balls)
    balls.push_back(Value::Map{{"name", ball.image},
                               {"x_mm", 1e3 * ball.place.x_m},
                               {"y_mm", 1e3 * ball.place.y_m},
                               {"depth_mm", 1e3 * ball.place.depth_m},
                               {"label_offset_px", three(ball.offsets_px.transpose())},
                               {"label_offset_sigma_px", three(ball.sigma_px.transpose())}});
  Value::Map summary{{"converged", fit.converged},
                     {"iterations", fit.iterations},
                     {"sigma_codes", fit.sigma_codes},
                     {"outliers", fit.outliers},
                     {"photographs", std::move(photographs)},
                     {"parameters", parameter_lines(parameters, fit)},
                     {"colors", color_lines(parameters.nominal(), fit)},
                     {"condition_number", fit.condition},
                     {"condition_number_leds", fit.condition_leds},
                     {"condition_number_with_veil", fit.condition_with_veil},
                     {"covariance", covariance_rows(parameters, fit)}};
  if (!balls.empty()) summary.emplace_back("balls", std::move(balls));
  return summary;
}

void warn_of_misfit(const SensorParameters& parameters, const SensorFitConfig& config, const SensorFit& fit) {
  for (const PhotographFit& one : fit.photographs) {
    const double most = *std::ranges::max_element(one.rmse_codes);
    if (most > 4.0 * config.sigma_codes)
      log_warning("{}: {:.1f} codes of residual, sigma_codes is {:g}: the model lacks something, see residuals/",
                  one.name, most, config.sigma_codes);
  }
  for (Eigen::Index i = 0; i < parameters.count(); ++i)
    if (fit.at_bound[i]) log_warning("{} ends at its bound, {:.6g}", parameters.name(i), parameters.value(i, fit.u[i]));
  if (!fit.converged) log_warning("the fit did not converge");
}

}  // namespace

void calibrate_sensor(Stage& stage) {
  int ball_flags = 0;
  for (const char* flag : {"--photographs", "--labels", "--press", "--gel"})
    ball_flags += stage.optional_input(flag).has_value();
  for (const char* flag : {"--basis", "--shapes"})
    if (!stage.inputs(flag).empty()) throw UsageError(fmt::format("{} cannot be combined with sensor_fit", flag));
  const auto config = stage.read_config<SensorFitConfig>("--config");
  if (ball_flags != (config.balls ? 4 : 0))
    throw UsageError(
        "--photographs, --labels, --press, --gel and the section sensor_fit.balls belong together: give all or none");
  const SensorParameters parameters(stage.input("--sensor"), config.parameters);
  const Camera& camera = parameters.nominal().camera;
  const ByteImage background = read_photograph(stage.input("--background"), camera);
  std::vector<BallPhotograph> balls;
  std::optional<BallPress> press;
  if (config.balls) {
    if (parameters.nominal().gel.dome_radius_m)
      throw UsageError("photographs of balls need a flat gel: a press is moved to where its photograph shows it");
    balls = read_balls(stage, camera);
    press = read_ball_press(*stage.optional_input("--press"), *stage.optional_input("--gel"), config.balls->radius_m,
                            config.balls->contact_gap_m);
  }
  const SensorFit fit = fit_sensor(parameters, config, background, balls, press ? &*press : nullptr);
  warn_of_misfit(parameters, config, fit);
  const std::string text = changed_sensor(stage.input("--sensor"), fitted_changes(parameters, fit, "reference.png"),
                                          "Made by calibrate: values fitted to photographs are marked as derived.");
  write_file(stage.output("sensor.yaml"), text);
  write_png(stage.output("reference.png"), background);
  for (const PhotographFit& one : fit.photographs) {
    const std::string name = "residuals/" + std::filesystem::path(one.name).replace_extension().string();
    write_exr(stage.output(name + ".exr"), one.residual, {"R", "G", "B"});
    write_png(stage.output(name + ".png"), residual_picture(one.residual, config.block_px));
  }
  stage.summarize(summary_of(parameters, fit));
}

}  // namespace tacipc
