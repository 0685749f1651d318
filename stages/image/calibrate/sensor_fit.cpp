#include "stages/image/calibrate/sensor_fit.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/statistics.h"
#include "common/optics/develop.h"
#include "stages/image/calibrate/blocks.h"
#include "stages/image/calibrate/gauss_newton.h"
#include "stages/image/calibrate/led_intensities.h"

namespace tacipc {
namespace {

struct Photograph {
  std::string name;
  FloatImage codes;  // NaN: clipped
  BlockTracer tracer;
  std::array<std::vector<Eigen::Index>, 3> used;  // blocks that count, per channel
};

/// Colours and veil for given parameters.
struct Colors {
  std::array<Eigen::VectorXd, 3> value;  // groups, then the veil
  std::array<Eigen::MatrixXd, 3> gram;   // normal equations of the weighted columns
};

class Problem {
 public:
  Problem(const SensorParameters& parameters, const SensorFitConfig& config, const ByteImage& background,
          const std::vector<BallPhotograph>& balls, const BallPress* press);

  Eigen::Index unknowns() const { return parameters_.count() + 3 * fitted_balls_; }
  Eigen::VectorXd lower() const { return bounds(parameters_.lower(), -4.0); }
  Eigen::VectorXd upper() const { return bounds(parameters_.upper(), 4.0); }

  /// Residuals at p = (u, o₁, o₂, …): grey levels of fit − photograph over sigma, then the rows of the priors.
  Eigen::VectorXd residuals(const Eigen::VectorXd& p) {
    const std::vector<const BlockLight*> light = lights(p);
    const Sensor& now = sensor(p);
    const Colors colors = solve_colors(light, now.response);
    Eigen::VectorXd out(num_rows() + unknowns());
    Eigen::Index row = 0;
    each_used([&](std::size_t k, std::size_t c, Eigen::Index block) {
      out[row++] = difference(k, c, block, light, colors, now.response) / sigma_;
    });
    out.tail(unknowns()) = p;
    return out;
  }

  double sigma() const { return sigma_; }
  Colors colors(const Eigen::VectorXd& p) { return solve_colors(lights(p), sensor(p).response); }

  /// Removes blocks beyond five robust standard deviations. Sigma becomes the root mean square of the rest if that
  /// exceeds `least`, and more if neighbouring blocks correlate, because they are then not independent.
  /// \return true if anything changed
  bool reweigh(const Eigen::VectorXd& p, double least) {
    const std::vector<const BlockLight*> light = lights(p);
    const Response response = sensor(p).response;
    const Colors now = solve_colors(light, response);
    std::vector<double> size;
    each_used([&](std::size_t k, std::size_t c, Eigen::Index block) {
      size.push_back(std::abs(difference(k, c, block, light, now, response)));
    });
    const double most =
        std::max(5.0 * 1.4826 * upper_median(std::move(size)), 0.5);  // grey levels; rounding alone makes 0.5
    std::size_t dropped = 0;
    double sum = 0.0, together = 0.0;
    for (std::size_t k = 0; k < photographs_.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        std::map<Eigen::Index, double> neighbourhoods;
        const Eigen::Index width = photographs_[k].codes.width;
        dropped += std::erase_if(photographs_[k].used[c], [&](Eigen::Index block) {
          const double r = difference(k, c, block, light, now, response);
          if (std::abs(r) > most) return true;
          sum += r * r;
          neighbourhoods[block / width / kNeighbourhoodBlocks * width + block % width / kNeighbourhoodBlocks] += r;
          return false;
        });
        for (const auto& [place, total] : neighbourhoods) together += total * total;
      }
    outliers_ += dropped;
    const double before = sigma_;
    // Σ (Σ r)² equals Σ r² if neighbours are independent, and kNeighbourhoodBlocks² times that if all agree.
    sigma_ = std::max(least, std::sqrt(std::max(sum, together) / static_cast<double>(num_rows())));
    return dropped > 0 || std::abs(sigma_ - before) > 0.02 * before;
  }

  const Sensor& sensor(const Eigen::VectorXd& p) {
    const Eigen::VectorXd u = p.head(parameters_.count());
    if (!sensor_ || sensor_->first != u) sensor_.emplace(u, parameters_.sensor(u));
    return sensor_->second;
  }

  /// \pre `covariance` belongs to p
  void describe(const Eigen::VectorXd& p, const Eigen::MatrixXd& covariance, SensorFit& fit);

 private:
  Eigen::VectorXd bounds(const Eigen::VectorXd& of_parameters, double of_labels) const {
    Eigen::VectorXd out = Eigen::VectorXd::Constant(unknowns(), of_labels);
    out.head(parameters_.count()) = of_parameters;
    return out;
  }

  static constexpr Eigen::Index kNeighbourhoodBlocks = 8;  // edge of a neighbourhood, in blocks

  template <typename Function>
  void each_used(const Function& visit) const {
    for (std::size_t k = 0; k < photographs_.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        for (const Eigen::Index block : photographs_[k].used[c]) visit(k, c, block);
  }

  Eigen::Index num_rows() const {
    std::size_t rows = 0;
    for (const Photograph& photograph : photographs_)
      for (const auto& used : photograph.used) rows += used.size();
    return static_cast<Eigen::Index>(rows);
  }

  /// Offsets of a ball's label at p, in pixels.
  /// \pre photograph k shows a ball
  Eigen::Vector3d offsets(const Eigen::VectorXd& p, std::size_t k) const {
    if (fitted_balls_ == 0) return Eigen::Vector3d::Zero();
    return label_sigma_px_ * p.segment<3>(parameters_.count() + 3 * (static_cast<Eigen::Index>(k) - 1));
  }

  std::vector<const BlockLight*> lights(const Eigen::VectorXd& p) {
    std::vector<const BlockLight*> out;
    const Eigen::VectorXd u = p.head(parameters_.count());
    for (std::size_t k = 0; k < photographs_.size(); ++k) {
      const Eigen::Vector3d moved = k > 0 ? offsets(p, k) : Eigen::Vector3d::Zero();
      Eigen::VectorXd key(u.size() + 3);
      key << u, moved;
      out.push_back(&photographs_[k].tracer.light(key, sensor(p), moved));
    }
    return out;
  }

  double seen(std::size_t k, std::size_t c, Eigen::Index block) const {
    return photographs_[k].codes.pixels[3 * static_cast<std::size_t>(block) + c];
  }

  double difference(std::size_t k, std::size_t c, Eigen::Index block, const std::vector<const BlockLight*>& light,
                    const Colors& now, const Response& response) const {
    return code_of((*light[k])[c].row(block).dot(now.value[c]), response) - seen(k, c, block);
  }

  Colors solve_colors(const std::vector<const BlockLight*>& light, const Response& response) const;

  const SensorParameters& parameters_;
  std::vector<Photograph> photographs_;
  const BallPress* press_;
  double label_sigma_px_ = 0.0;
  Eigen::Index fitted_balls_ = 0;
  double sigma_;
  std::size_t outliers_ = 0;
  std::optional<std::pair<Eigen::VectorXd, Sensor>> sensor_ = std::nullopt;
};

Problem::Problem(const SensorParameters& parameters, const SensorFitConfig& config, const ByteImage& background,
                 const std::vector<BallPhotograph>& balls, const BallPress* press)
    : parameters_(parameters), press_(press), sigma_(config.sigma_codes) {
  const int block = config.block_px;
  if (background.width % block != 0 || background.height % block != 0)
    throw UsageError(fmt::format("sensor_fit.block_px: {} does not divide the image's {} x {} pixels", block,
                                 background.width, background.height));
  const TraceSettings settings{.subpixels = config.subpixels, .led_samples = config.led_samples};
  photographs_.push_back(
      {"background", block_codes(background, block), BlockTracer(parameters.nominal(), block, settings), {}});
  for (const BallPhotograph& ball : balls)
    photographs_.push_back(
        {ball.label.image, block_codes(ball.image, block), BlockTracer(*press, ball.label, block, settings), {}});
  if (!balls.empty() && config.balls->label_sigma_px > 0.0) {
    label_sigma_px_ = config.balls->label_sigma_px;
    fitted_balls_ = static_cast<Eigen::Index>(balls.size());
  }
  double fit_radius_px = 0.0;
  for (const BallPhotograph& ball : balls) fit_radius_px = std::max(fit_radius_px, 2.0 * ball.label.radius_px);
  if (config.balls) fit_radius_px = config.balls->fit_radius_px.value_or(fit_radius_px);
  const Sensor start = parameters.sensor(Eigen::VectorXd::Zero(parameters.count()));
  for (Photograph& photograph : photographs_) {
    const std::vector<bool> clean = photograph.tracer.clean_blocks(start);
    const auto& label = photograph.tracer.label();
    for (std::size_t i = 0; i < clean.size(); ++i) {
      const int width = photograph.codes.width;
      const double x = (static_cast<int>(i) % width + 0.5) * block - 0.5,
                   y = (static_cast<int>(i) / width + 0.5) * block - 0.5;
      if (!clean[i] || (label && std::hypot(x - label->x_px, y - label->y_px) > fit_radius_px)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        if (std::isfinite(photograph.codes.pixels[3 * i + c]))
          photograph.used[c].push_back(static_cast<Eigen::Index>(i));
    }
  }
}

Colors Problem::solve_colors(const std::vector<const BlockLight*>& light, const Response& response) const {
  Colors out;
  for (std::size_t c = 0; c < 3; ++c) {
    Eigen::Index rows = 0;
    for (const Photograph& photograph : photographs_) rows += static_cast<Eigen::Index>(photograph.used[c].size());
    const Eigen::Index columns = (*light[0])[c].cols();
    if (rows <= columns)
      throw DataError("channel {}: {} blocks count for {} colours and the veil", c, rows, columns - 1);
    Eigen::MatrixXd a(rows, columns);
    Eigen::VectorXd y(rows);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < photographs_.size(); ++k)
      for (const Eigen::Index block : photographs_[k].used[c]) {
        const double code = seen(k, c, block);
        // A deviation of σ grey levels is σ times the inverse curve's slope as signal.
        const double weight = 1.0 / (sigma_ * (value_of(code + 0.5, response) - value_of(code - 0.5, response)));
        a.row(row) = weight * (*light[k])[c].row(block);
        y[row++] = weight * value_of(code, response);
      }
    const Eigen::VectorXd norms = a.colwise().norm();
    for (Eigen::Index g = 0; g + 1 < columns; ++g) {
      if (norms[g] > 0.0) continue;
      const LightGroup group = light_groups(parameters_.nominal().leds)[g];
      throw DataError("{} lights nothing in channel {} that counts, so its colour cannot be determined",
                      group.name.empty() ? fmt::format("LED {}", group.leds.front()) : "light group " + group.name, c);
    }
    // Unit columns: the solver then treats lights of any strength and the veil alike.
    const Eigen::VectorXd scale = norms.cwiseInverse();
    out.value[c] = scale.cwiseProduct(nonnegative_least_squares(a * scale.asDiagonal(), y));
    out.gram[c] = a.transpose() * a;
  }
  return out;
}

void Problem::describe(const Eigen::VectorXd& p, const Eigen::MatrixXd& covariance, SensorFit& fit) {
  const std::vector<const BlockLight*> light = lights(p);
  const Sensor now = sensor(p);
  const Colors found = solve_colors(light, now.response);
  const Eigen::Index groups = found.value[0].size() - 1;
  fit.u = p.head(parameters_.count());
  fit.rgb.resize(groups, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    fit.rgb.col(c) = found.value[c].head(groups);
    fit.veil[c] = found.value[c][groups];
    fit.condition_leds = std::max(fit.condition_leds, condition_of(found.gram[c].topLeftCorner(groups, groups)));
    fit.condition_with_veil = std::max(fit.condition_with_veil, condition_of(found.gram[c]));
  }
  for (std::size_t k = 0; k < photographs_.size(); ++k) {
    const Photograph& photograph = photographs_[k];
    PhotographFit one{.name = photograph.name,
                      .residual = FloatImage(photograph.codes.width, photograph.codes.height, 3,
                                             std::numeric_limits<float>::quiet_NaN())};
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (const Eigen::Index block : photograph.used[c]) {
        const double r = difference(k, c, block, light, found, now.response);
        one.residual.pixels[3 * static_cast<std::size_t>(block) + c] = static_cast<float>(r);
        sum += r * r;
      }
      one.blocks[c] = photograph.used[c].size();
      one.rmse_codes[c] = one.blocks[c] > 0 ? std::sqrt(sum / static_cast<double>(one.blocks[c])) : 0.0;
    }
    fit.photographs.push_back(std::move(one));
    if (!photograph.tracer.label()) continue;
    const Eigen::Vector3d moved = offsets(p, k);
    BallFit ball{photograph.name, ball_place(*press_, *photograph.tracer.label(), moved, now), moved};
    if (fitted_balls_ > 0) ball.sigma_px = offsets(covariance.diagonal().cwiseSqrt(), k);
    fit.balls.push_back(std::move(ball));
  }
  fit.sigma_codes = sigma_;
  fit.outliers = outliers_;
}

constexpr double kStep = 0.02;  // step of differences, in prior standard deviations

/// Standard deviations of the colours: from their own uncertainty at given parameters, and from that of the parameters.
Eigen::Matrix<double, Eigen::Dynamic, 3> color_deviations(Problem& problem, const Eigen::VectorXd& p,
                                                          const Eigen::MatrixXd& covariance) {
  const Colors here = problem.colors(p);
  const Eigen::Index colors = here.value[0].size();
  std::array<Eigen::MatrixXd, 3> slope;
  for (auto& one : slope) one.resize(colors, p.size());
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    Eigen::VectorXd moved = p;
    const double step = moved[i] + kStep > problem.upper()[i] ? -kStep : kStep;
    moved[i] += step;
    const Colors there = problem.colors(moved);
    for (std::size_t c = 0; c < 3; ++c) slope[c].col(i) = (there.value[c] - here.value[c]) / step;
  }
  Eigen::Matrix<double, Eigen::Dynamic, 3> out(colors, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    const Eigen::VectorXd scale = here.gram[c].diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd unit = scale.asDiagonal() * here.gram[c] * scale.asDiagonal();
    const Eigen::VectorXd own =
        unit.ldlt().solve(Eigen::MatrixXd::Identity(colors, colors)).diagonal().cwiseProduct(scale.cwiseAbs2());
    const Eigen::VectorXd moved = (slope[c] * covariance * slope[c].transpose()).diagonal();
    out.col(c) = (own + moved).cwiseMax(0.0).cwiseSqrt();
  }
  return out;
}

}  // namespace

SensorFit fit_sensor(const SensorParameters& parameters, const SensorFitConfig& config, const ByteImage& background,
                     const std::vector<BallPhotograph>& balls, const BallPress* press) {
  Problem problem(parameters, config, background, balls, press);
  const Eigen::Index n = problem.unknowns();
  const GaussNewtonSettings settings{.step = Eigen::VectorXd::Constant(n, kStep),
                                     .lower = problem.lower(),
                                     .upper = problem.upper(),
                                     .max_iterations = 30,
                                     .relative_decrease = 1e-7};
  SensorFit fit;
  GaussNewtonResult result{.parameters = Eigen::VectorXd::Zero(n)};
  result.converged = true;
  for (int round = 0; round < 3; ++round) {
    if (n > 0) {
      result =
          gauss_newton([&](const Eigen::VectorXd& p) { return problem.residuals(p); }, result.parameters, settings);
      fit.iterations += result.iterations;
    }
    log_info("round {}: sum of squares {:.6g}", round + 1, result.sum_of_squares);
    const double before = problem.sigma();
    if (round == 2 || !problem.reweigh(result.parameters, config.sigma_codes)) break;
    // With far too much weight the photographs may have misled the fit.
    if (problem.sigma() > 2.0 * before) result.parameters.setZero();
  }
  const Eigen::VectorXd& p = result.parameters;
  problem.describe(p, result.inverse, fit);
  fit.converged = result.converged;
  fit.condition = result.condition;
  fit.covariance = result.inverse.topLeftCorner(parameters.count(), parameters.count());
  fit.color_sigma = color_deviations(problem, p, result.inverse);
  for (Eigen::Index i = 0; i < parameters.count(); ++i)
    fit.at_bound.push_back(p[i] <= problem.lower()[i] || p[i] >= problem.upper()[i]);
  return fit;
}

std::vector<SensorChange> fitted_changes(const SensorParameters& parameters, const SensorFit& fit,
                                         const std::string& reference_image) {
  std::vector<SensorChange> out = parameters.changes(fit.u);
  const double most = fit.rgb.maxCoeff();
  if (!(most > 0.0)) throw DataError("no LED shines in the photograph without contact");
  const auto rgb = [&](const Vector3& v) { return Value::List{v[0] / most, v[1] / most, v[2] / most}; };
  const auto groups = light_groups(parameters.nominal().leds);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int led : groups[g].leds) {
      const std::string& at = parameters.led_paths()[led];
      for (const char* key : {".cct_k", ".wavelength_nm", ".fwhm_nm"}) out.push_back({at + key});
      out.push_back({at + ".rgb_linear", rgb(fit.rgb.row(g))});
    }
  out.push_back({"ambient.rgb", rgb(fit.veil)});
  for (const char* key : {"response.mean_level", "response.white_balance", "response.color_matrix"})
    out.push_back({key});
  out.push_back({"response.exposure", most});
  out.push_back({"reference_image", reference_image, "known"});
  return out;
}

}  // namespace tacipc
