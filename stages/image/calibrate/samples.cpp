#include "stages/image/calibrate/samples.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/base/error.h"

namespace tacipc {

Samples make_samples(const ByteImage& photograph, const ByteImage& background, const BallLabel& label,
                     const CalibrateConfig& config) {
  Samples samples;
  std::array<double, 3> sum{};
  double count = 0.0;
  for (int y = 0; y < photograph.height; ++y) {
    for (int x = 0; x < photograph.width; ++x) {
      const double distance = std::hypot(x - label.x_px, y - label.y_px);
      if (distance > config.drift_radius_px) {
        for (int c = 0; c < 3; ++c)
          sum[static_cast<std::size_t>(c)] += int{photograph.at(x, y, c)} - int{background.at(x, y, c)};
        count += 1.0;
      }
      if (distance < config.fit_radius_px && x % config.fit_stride_px == 0 && y % config.fit_stride_px == 0)
        samples.pixels.push_back({x, y});
    }
  }
  if (count == 0.0) throw DataError("{}: no pixel is farther than drift_radius_px from the contact", label.image);
  const auto rows = static_cast<Eigen::Index>(samples.pixels.size());
  samples.target.resize(rows, 3);
  samples.used.resize(rows, 3);
  for (int c = 0; c < 3; ++c) {
    const double drift = samples.drift[static_cast<std::size_t>(c)] = sum[static_cast<std::size_t>(c)] / count;
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto [x, y] = samples.pixels[static_cast<std::size_t>(i)];
      const int code = photograph.at(x, y, c), before = background.at(x, y, c);
      samples.target(i, c) = code - before - drift;
      samples.used(i, c) = code > 0 && code < 255 && before > 0 && before < 255 ? 1.0 : 0.0;
    }
  }
  return samples;
}

Eigen::MatrixXd feature_matrix(const LightGeometry& geometry, const MembraneView& view, const Samples& samples) {
  const auto rows = static_cast<Eigen::Index>(samples.pixels.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> out(rows, geometry.num_features());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto [x, y] = samples.pixels[static_cast<std::size_t>(i)];
    light_features(geometry, view, x, y, out.row(i).data());
  }
  return out;
}

NormalEquations normal_equations(const Eigen::MatrixXd& features, const Samples& samples) {
  NormalEquations out;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const Eigen::MatrixXd weighted = features.array().colwise() * samples.used.col(c).array();
    const Eigen::VectorXd target = samples.target.col(c).cwiseProduct(samples.used.col(c));
    out.gram[k] = weighted.transpose() * features;
    out.moment[k] = features.transpose() * target;
    out.square[k] = target.squaredNorm();
    out.count[k] = samples.used.col(c).sum();
  }
  return out;
}

void NormalEquations::add(const NormalEquations& other) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (gram[c].size() == 0) {
      gram[c] = other.gram[c];
      moment[c] = other.moment[c];
    } else {
      gram[c] += other.gram[c];
      moment[c] += other.moment[c];
    }
    square[c] += other.square[c];
    count[c] += other.count[c];
  }
}

NormalEquations NormalEquations::part(Eigen::Index first, Eigen::Index last) const {
  NormalEquations out = *this;
  for (std::size_t c = 0; c < 3; ++c) {
    out.gram[c] = gram[c].block(first, first, last - first, last - first).eval();
    out.moment[c] = moment[c].segment(first, last - first).eval();
  }
  return out;
}

Codes NormalEquations::solve(double ridge) const {
  Codes weights(moment[0].size(), 3);
  for (std::size_t c = 0; c < 3; ++c) {
    Eigen::MatrixXd system = gram[c];
    system.diagonal() *= 1.0 + ridge;
    const Eigen::LDLT<Eigen::MatrixXd> factor(system);
    const Eigen::VectorXd solved = factor.solve(moment[c]);
    if (factor.info() != Eigen::Success || !solved.allFinite() || factor.vectorD().minCoeff() <= 0.0)
      throw SolverError(
          "the photographs do not determine all weights of the light: give more of them or a larger ridge");
    weights.col(static_cast<Eigen::Index>(c)) = solved;
  }
  return weights;
}

std::array<double, 3> NormalEquations::residual(const Codes& weights) const {
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto w = weights.col(static_cast<Eigen::Index>(c));
    out[c] = std::max(0.0, square[c] - 2.0 * w.dot(moment[c]) + w.dot(gram[c] * w));
  }
  return out;
}

double NormalEquations::condition() const {
  double worst = 0.0;
  for (const Eigen::MatrixXd& g : gram) {
    const Eigen::VectorXd scale = g.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * g * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled, Eigen::EigenvaluesOnly);
    const double low = std::max(eigen.eigenvalues().minCoeff(), 1e-300);
    worst = std::max(worst, std::sqrt(eigen.eigenvalues().maxCoeff() / low));
  }
  return worst;
}

}  // namespace tacipc
