#include "stages/image/calibrate/fit_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/statistics.h"
#include "common/optics/seen_membrane.h"
#include "stages/image/calibrate/fit_lamps.h"

namespace tacipc {
namespace {

LightGeometry start_geometry(const CalibrateConfig& config, const Sensor& sensor) {
  LightGeometry geometry = config.geometry;
  geometry.field_half_width_m = 0.5 * sensor.camera.window_width_m;
  set_lamps(geometry, config.lamps);
  return geometry;
}

double label_radius_m(const Ball& ball, const Sensor& sensor) {
  return ball.label.radius_px * sensor.camera.window_width_m / sensor.camera.width_px;
}

/// Gap at the labels' radii, the median over balls, so that a single wrong label does not matter.
double fitted_gap(const std::vector<Ball>& balls, const BallPress& press, const Sensor& sensor) {
  std::vector<double> gaps;
  for (const Ball& ball : balls)
    gaps.push_back(
        gap_at_radius(press.at_depth(ball.depth_m), ball.depth_m, press.radius_m, label_radius_m(ball, sensor)));
  return std::max(upper_median(std::move(gaps)), 1e-6);  // below the barrier's smallest gap there is no rim
}

/// Sets each contact's residual for given weights.
/// \return residual of all samples, grey levels
double measure_misfit(const std::vector<Contact*>& contacts, const std::vector<Eigen::MatrixXd>& features,
                      const Codes& weights) {
  double squares = 0.0, count = 0.0;
  for (std::size_t b = 0; b < contacts.size(); ++b) {
    const Eigen::VectorXd r = residuals_of(contacts[b]->samples, features[b], weights);
    contacts[b]->rmse_codes = std::sqrt(r.squaredNorm() / std::max(contacts[b]->samples.used.sum(), 1.0));
    squares += r.squaredNorm();
    count += contacts[b]->samples.used.sum();
  }
  return std::sqrt(squares / count);
}

/// Fits centre and depth of one ball to its photograph under the current light, with its label as a prior.
void fit_ball(Ball& ball, const BallPress& press, const Sensor& sensor, const LightField& light, double sigma_px,
              const CalibrateConfig& config) {
  const double pixel = sensor.camera.window_width_m / sensor.camera.width_px;
  // Prior of the label's radius: with d ≈ a² / R, its deviation is two of the centre's in units of the depth.
  const double contact = label_radius_m(ball, sensor);
  const Vector3 label(ball.x_m, ball.y_m, ball.depth_m);
  const Vector3 sigma = sigma_px * pixel * Vector3(1.0, 1.0, std::max(2.0 * contact / config.ball_radius_m, 0.1));
  const double typical = std::max(ball.rmse_codes, 1.0) * std::sqrt(samples_per_fact(config));
  const auto residuals = [&](const Eigen::VectorXd& u) {
    Ball at = ball;
    std::tie(at.x_m, at.y_m, at.depth_m) = std::tuple(u[0], u[1], u[2]);
    at.view = view_ball(press, at, sensor);
    const Eigen::VectorXd pixels =
        residuals_of(at.samples, feature_matrix(light.geometry, at.view, at.samples), light.weights);
    Eigen::VectorXd all(pixels.size() + 3);
    all << pixels, typical * (Vector3(u) - label).cwiseQuotient(sigma);
    return all;
  };
  const double deepest = press.depth_m.back(), reach = 5.0 * sigma_px * pixel;
  GaussNewtonSettings settings{.step = Eigen::Vector3d(0.1 * pixel, 0.1 * pixel, 5e-6),
                               .lower = Eigen::Vector3d(ball.x_m - reach, ball.y_m - reach, 1e-5),
                               .upper = Eigen::Vector3d(ball.x_m + reach, ball.y_m + reach, deepest),
                               .max_iterations = 4,
                               .relative_decrease = 1e-3};
  const GaussNewtonResult result = gauss_newton(residuals, label, settings);
  std::tie(ball.x_m, ball.y_m, ball.depth_m) =
      std::tuple(result.parameters[0], result.parameters[1], result.parameters[2]);
  ball.view = view_ball(press, ball, sensor);
}

struct Part {
  ModelKind kind;
  Eigen::Index first, last;
};

std::vector<Part> parts_of(const LightGeometry& geometry) {
  const Eigen::Index lamps = geometry.first_environment_feature(), all = geometry.num_features();
  std::vector<Part> parts;
  if (lamps > 0) parts.push_back({ModelKind::lamps, 0, lamps});
  if (all > lamps) parts.push_back({ModelKind::environment, lamps, all});
  if (lamps > 0 && all > lamps) parts.push_back({ModelKind::both, 0, all});
  return parts;
}

/// Error of photographs, or parts of them, under the light fitted to the others.
class LeftOut {
 public:
  void add(const NormalEquations& left, const NormalEquations& kept, double ridge) {
    const auto residual = left.residual(kept.solve(ridge));
    for (std::size_t c = 0; c < 3; ++c) {
      squares_ += residual[c];
      count_ += left.count[c];
    }
  }
  double rmse() const { return std::sqrt(squares_ / count_); }

 private:
  double squares_ = 0.0, count_ = 0.0;
};

/// The balls come first among `equations`; the objects after them are never left out.
double held_out_rmse(const std::vector<NormalEquations>& equations, std::size_t balls, const Part& part,
                     const CalibrateConfig& config) {
  LeftOut error;
  for (int fold = 0; fold < config.folds; ++fold) {
    NormalEquations kept, left;
    for (std::size_t b = 0; b < equations.size(); ++b) {
      const bool leave = b < balls && static_cast<int>(b) % config.folds == fold;
      (leave ? left : kept).add(equations[b].part(part.first, part.last));
    }
    if (left.gram[0].size() > 0) error.add(left, kept, config.ridge);
  }
  return error.rmse();
}

/// Sum over all photographs but one.
NormalEquations all_but(std::size_t which, const std::vector<NormalEquations>& equations, const Part& part) {
  NormalEquations others;
  for (std::size_t b = 0; b < equations.size(); ++b)
    if (b != which) others.add(equations[b].part(part.first, part.last));
  return others;
}

/// Error of one photograph under the light of all others.
double left_out_rmse(const std::vector<NormalEquations>& equations, std::size_t which, const Part& part,
                     const CalibrateConfig& config) {
  LeftOut error;
  error.add(equations[which].part(part.first, part.last), all_but(which, equations, part), config.ridge);
  return error.rmse();
}

/// Error of blocks of 16 × 16 pixels of an object's photograph. An eighth of them is left out of the fit at a time:
/// neighbouring pixels are similar, so single pixels left out would show no error.
double left_out_blocks_rmse(const KnownObject& object, std::size_t which, const std::vector<NormalEquations>& equations,
                            const LightField& light, const Part& part, const CalibrateConfig& config) {
  constexpr int kBlockPx = 16;
  constexpr std::size_t kFolds = 8;
  const Samples& samples = object.samples;
  const Eigen::MatrixXd features = feature_matrix(light.geometry, object.view, samples);
  const Codes active = active_samples(samples, features * light.weights);
  std::array<NormalEquations, kFolds> of_fold;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    Codes own = active;
    for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
      const auto [x, y] = samples.pixels[i];
      if (static_cast<std::size_t>(x / kBlockPx + 3 * (y / kBlockPx)) % kFolds != fold) own.row(i).setZero();
    }
    of_fold[fold] = normal_equations(features, samples, own).part(part.first, part.last);
  }
  const NormalEquations others = all_but(which, equations, part);
  LeftOut error;
  for (const NormalEquations& left : of_fold) {
    NormalEquations kept = others;
    for (const NormalEquations& other : of_fold)
      if (&other != &left) kept.add(other);
    error.add(left, kept, config.ridge);
  }
  return error.rmse();
}

LightGeometry part_of(const LightGeometry& geometry, ModelKind kind) {
  LightGeometry out = geometry;
  if (kind == ModelKind::lamps) {
    out.environment_degree = 0;
    out.environment_depth = false;
    out.dome = {};
  }
  if (kind == ModelKind::environment) set_lamps(out, {});
  return out;
}

}  // namespace

std::string name_of(ModelKind kind) {
  return kind == ModelKind::lamps ? "lamps" : kind == ModelKind::environment ? "environment" : "both";
}

MembraneView view_ball(const BallPress& press, const Ball& ball, const Sensor& sensor) {
  return view_membrane(moved(press.at_depth(ball.depth_m), ball.x_m, ball.y_m, 0.0), press.front, sensor);
}

LightFit fit_light(std::vector<Ball>& balls, std::vector<KnownObject>& objects, BallPress* press, const Sensor& sensor,
                   const CalibrateConfig& config) {
  if (static_cast<int>(balls.size()) < config.folds)
    throw DataError("{} photographs cannot be divided into {} folds", balls.size(), config.folds);
  LightFit fit;
  fit.contact_gap_m = config.contact_gap_m;
  LightGeometry geometry = start_geometry(config, sensor);
  std::vector<LampGuess> lamps = config.lamps;
  std::vector<Ball> labelled = balls;
  std::vector<Contact*> contacts;
  for (Ball& ball : balls) contacts.push_back(&ball);
  for (KnownObject& object : objects) contacts.push_back(&object);
  const std::vector<const Contact*> seen(contacts.begin(), contacts.end());
  const bool fit_balls = press && config.label_sigma_px > 0.0;
  int rounds = !fit_balls ? 1 : config.fit_contact_gap ? 20 : 3;
  std::vector<NormalEquations> equations;
  for (int round = 0; round < rounds; ++round) {
    if (config.fit_lamps && !lamps.empty()) {
      fit.lamps = fit_lamps(seen, lamps, geometry, config);
      lamps = lamps_at(lamps, fit.lamps->parameters, config);
      set_lamps(geometry, lamps);
    }
    const auto features = all_features(seen, geometry);
    Weights best = best_weights(seen, features, config.ridge);
    equations = std::move(best.equations);
    fit.light = {.geometry = geometry, .weights = std::move(best.codes), .blur_px = config.blur_px};
    log_info("round {}: residual {:.3f} codes over {} photographs", round + 1,
             measure_misfit(contacts, features, fit.light.weights), seen.size());
    if (round + 1 == rounds) break;
    tbb::parallel_for(std::size_t{0}, contacts.size(), [&](std::size_t b) {
      if (b >= balls.size()) {
        fit_object(objects[b - balls.size()], sensor, fit.light);
        return;
      }
      Ball ball = labelled[b];  // the label is the prior, not the previous round
      ball.rmse_codes = balls[b].rmse_codes;
      fit_ball(ball, *press, sensor, fit.light, config.label_sigma_px, config);
      balls[b] = ball;
    });
    if (!config.fit_contact_gap) continue;
    const double before = fit.contact_gap_m;
    fit.contact_gap_m = fitted_gap(balls, *press, sensor);
    constexpr double kGapTolerance = 0.01;
    if (std::abs(fit.contact_gap_m - before) < kGapTolerance * before)
      rounds = round + 2;  // then one last fit of the light
    log_info("round {}: gap at the rim {:.4f} mm", round + 1, 1e3 * fit.contact_gap_m);
    press->set_rim(fit.contact_gap_m);
    for (Ball& ball : labelled) ball.depth_m = press->depth_of_contact(label_radius_m(ball, sensor), ball.label.image);
  }
  if (fit.lamps) fit.knowledge = lamp_knowledge(seen, lamps, geometry, config);
  double best = std::numeric_limits<double>::infinity();
  Part chosen{};
  for (const Part& part : parts_of(geometry)) {
    fit.held_out.push_back({part.kind, held_out_rmse(equations, balls.size(), part, config)});
    if (!(fit.held_out.back().rmse_codes < best)) continue;
    best = fit.held_out.back().rmse_codes;
    chosen = part;
  }
  for (std::size_t o = 0; o < objects.size(); ++o) {
    const std::size_t which = balls.size() + o;
    objects[o].left_out_rmse_codes = left_out_rmse(equations, which, chosen, config);
    objects[o].left_out_blocks_rmse_codes =
        left_out_blocks_rmse(objects[o], which, equations, fit.light, chosen, config);
  }
  const NormalEquations all = sum_of(equations).part(chosen.first, chosen.last);
  fit.kind = chosen.kind;
  fit.light = {
      .geometry = part_of(geometry, chosen.kind), .weights = all.solve(config.ridge), .blur_px = config.blur_px};
  fit.condition = all.condition();
  const auto residual = all.residual(fit.light.weights);
  double used = 0.0, total = 0.0;
  for (std::size_t c = 0; c < 3; ++c) fit.rmse_codes[c] = std::sqrt(residual[c] / all.count[c]);
  for (const Contact* contact : seen) {
    used += contact->samples.used.sum();
    total += static_cast<double>(contact->samples.used.size());
  }
  fit.unused_fraction = 1.0 - used / total;
  return fit;
}

}  // namespace tacipc
