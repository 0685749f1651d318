#include "stages/image/calibrate/led_intensities.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "common/base/tone_curve.h"
#include "stages/image/calibrate/blocks.h"

namespace tacipc {
namespace {

FloatImage block_medians(const FloatImage& image, int block) {
  return reduced_blocks(image, block, [](const std::vector<float>& values) { return upper_median(values); });
}

}  // namespace

double condition_of(const Eigen::MatrixXd& gram) {
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return std::sqrt(values.maxCoeff() / std::max(values.minCoeff(), 1e-300));
}

IntensityConfig IntensityConfig::read(ConfigReader& file) {
  ConfigReader in = file.section("intensities");
  IntensityConfig config{.curve = in.choice("curve", {"srgb", "linear"}),
                         .shot_gain = in.number("shot_gain", Range::non_negative()),
                         .read_noise = in.number("read_noise", Range::positive())};
  config.block_px = in.integer("block_px", 1, 1000);
  return config;
}

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& y) {
  const Eigen::Index n = a.cols();
  const Eigen::MatrixXd gram = a.transpose() * a;
  const Eigen::VectorXd moment = a.transpose() * y;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> free;
  const double tolerance = 1e-12 * moment.cwiseAbs().maxCoeff();
  const auto solve_free = [&] {
    const Eigen::MatrixXd part = gram(free, free);
    const Eigen::VectorXd right = moment(free);
    Eigen::VectorXd full = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd solved = part.ldlt().solve(right);
    full(free) = solved;
    return full;
  };
  for (Eigen::Index step = 0; step < 10 * n; ++step) {
    const Eigen::VectorXd slope = moment - gram * x;
    Eigen::Index enter = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (std::ranges::find(free, i) != free.end() || slope[i] <= tolerance) continue;
      if (enter < 0 || slope[i] > slope[enter]) enter = i;
    }
    if (enter < 0) return x;
    free.push_back(enter);
    Eigen::VectorXd wanted = solve_free();
    // Move towards the free optimum until a value would turn negative; values that reach zero become fixed.
    while (!free.empty() && wanted(free).minCoeff() <= 0.0) {
      double share = 1.0;
      for (const Eigen::Index i : free)
        if (wanted[i] <= 0.0) share = std::min(share, x[i] / (x[i] - wanted[i]));
      if (!std::isfinite(share)) share = 0.0;
      x += share * (wanted - x);
      std::erase_if(free, [&](Eigen::Index i) { return wanted[i] <= 0.0 && x[i] <= 1e-15 * x.cwiseAbs().maxCoeff(); });
      for (Eigen::Index i = 0; i < n; ++i)
        if (std::ranges::find(free, i) == free.end()) x[i] = 0.0;
      wanted = free.empty() ? Eigen::VectorXd(Eigen::VectorXd::Zero(n)) : solve_free();
    }
    x = wanted;
  }
  throw SolverError("non-negative least squares did not end: the basis images are nearly equal");
}

IntensityFit fit_intensities(const std::vector<FloatImage>& basis, const FloatImage& veil, const FloatImage& codes,
                             const IntensityConfig& config) {
  const FloatImage seen = block_medians(codes, config.block_px), uniform = block_medians(veil, config.block_px);
  std::vector<FloatImage> blocks;
  for (const FloatImage& image : basis) blocks.push_back(block_medians(image, config.block_px));
  const auto leds = static_cast<Eigen::Index>(basis.size()), unknowns = leds + 1;
  IntensityFit fit{.rgb = {}, .residual = FloatImage(seen.width, seen.height, 3)};
  fit.rgb.resize(leds, 3);
  const ToneCurve curve = ToneCurve::named(config.curve);
  for (int c = 0; c < 3; ++c) {
    std::vector<std::array<int, 2>> used;
    for (int y = 0; y < seen.height; ++y)
      for (int x = 0; x < seen.width; ++x)
        if (seen.at(x, y, c) > 0.0f && seen.at(x, y, c) < 255.0f) used.push_back({x, y});
    const Eigen::Index rows = std::ssize(used);
    if (rows <= unknowns) throw DataError("channel {}: {} usable blocks for {} unknowns", c, rows, unknowns);
    Eigen::MatrixXd a(rows, unknowns);
    Eigen::VectorXd y(rows), weight(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto [u, v] = used[i];
      for (Eigen::Index l = 0; l < leds; ++l) a(i, l) = blocks[l].at(u, v, c);
      a(i, leds) = uniform.at(u, v, 0);
      y[i] = curve.value_of(seen.at(u, v, c));
      weight[i] = 1.0 / std::sqrt(config.shot_gain * y[i] + config.read_noise * config.read_noise);
    }
    const Eigen::MatrixXd weighted = weight.asDiagonal() * a;
    // Unit columns: the solver then treats LEDs of any strength and the veil alike.
    const Eigen::VectorXd scale = weighted.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Eigen::VectorXd x =
        scale.cwiseProduct(nonnegative_least_squares(weighted * scale.asDiagonal(), weight.cwiseProduct(y)));
    fit.rgb.col(c) = x.head(leds);
    fit.veil[c] = x[leds];
    const Eigen::MatrixXd gram = weighted.transpose() * weighted;
    const Eigen::VectorXd left = a * x - y;
    fit.rmse[c] = std::sqrt(left.squaredNorm() / static_cast<double>(rows));
    fit.condition = std::max(fit.condition, condition_of(gram.topLeftCorner(leds, leds)));
    fit.condition_with_veil = std::max(fit.condition_with_veil, condition_of(gram));
    fit.covariance[c] = gram.ldlt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
    for (Eigen::Index i = 0; i < rows; ++i) fit.residual.at(used[i][0], used[i][1], c) = static_cast<float>(left[i]);
  }
  return fit;
}

}  // namespace tacipc
