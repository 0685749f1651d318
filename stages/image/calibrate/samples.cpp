#include "stages/image/calibrate/samples.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "stages/image/calibrate/led_intensities.h"

namespace tacipc {

Samples make_samples(const ByteImage& photograph, const ByteImage& background, const std::string& image,
                     const std::function<bool(int, int)>& inside, const std::function<bool(int, int)>& far,
                     int stride) {
  Samples samples;
  std::array<double, 3> sum{};
  double count = 0.0;
  for (int y = 0; y < photograph.height; ++y) {
    for (int x = 0; x < photograph.width; ++x) {
      if (far(x, y)) {
        for (int c = 0; c < 3; ++c) sum[c] += int{photograph.at(x, y, c)} - int{background.at(x, y, c)};
        count += 1.0;
      }
      if (x % stride == 0 && y % stride == 0 && inside(x, y)) samples.pixels.push_back({x, y});
    }
  }
  if (count == 0.0) throw DataError("{}: no pixel lies far enough from the contact to tell the drift", image);
  const Eigen::Index rows = std::ssize(samples.pixels);
  samples.target.resize(rows, 3);
  samples.used.resize(rows, 3);
  samples.clipped.resize(rows, 3);
  for (int c = 0; c < 3; ++c) {
    const double drift = samples.drift[c] = sum[c] / count;
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto [x, y] = samples.pixels[i];
      const int code = photograph.at(x, y, c), before = background.at(x, y, c);
      const bool known = before > 0 && before < 255;
      samples.target(i, c) = code - before - drift;
      samples.used(i, c) = known && code > 0 && code < 255 ? 1.0 : 0.0;
      samples.clipped(i, c) = !known ? 0.0 : code == 0 ? -1.0 : code == 255 ? 1.0 : 0.0;
    }
  }
  return samples;
}

Samples make_samples(const ByteImage& photograph, const ByteImage& background, const BallLabel& label,
                     const CalibrateConfig& config) {
  const auto distance = [&](int x, int y) { return std::hypot(x - label.x_px, y - label.y_px); };
  return make_samples(
      photograph, background, label.image, [&](int x, int y) { return distance(x, y) < config.fit_radius_px; },
      [&](int x, int y) { return distance(x, y) > config.drift_radius_px; }, config.fit_stride_px);
}

Eigen::MatrixXd feature_matrix(const LightGeometry& geometry, const MembraneView& view, const Samples& samples) {
  const Eigen::Index rows = std::ssize(samples.pixels);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> out(rows, geometry.num_features());
  const LightFeatures of(geometry, view);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto [x, y] = samples.pixels[i];
    of.at(x, y, out.row(i).data());
  }
  return out;
}

Codes active_samples(const Samples& samples, const Codes& simulated) {
  const Codes beyond = (simulated - samples.target).cwiseProduct(samples.clipped);
  return samples.used + (beyond.array() < 0.0).cast<double>().matrix();
}

Eigen::VectorXd residuals_of(const Samples& samples, const Eigen::MatrixXd& features, const Codes& weights) {
  const Codes simulated = features * weights;
  const Codes difference = (simulated - samples.target).cwiseProduct(active_samples(samples, simulated));
  return Eigen::Map<const Eigen::VectorXd>(difference.data(), difference.size());
}

namespace {

Eigen::MatrixXd gram_of(const Eigen::MatrixXd& features) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(features.cols(), features.cols());
  if (features.rows() == 0) return gram;
  gram.selfadjointView<Eigen::Lower>().rankUpdate(features.transpose());
  return gram.selfadjointView<Eigen::Lower>();
}

}  // namespace

NormalEquations normal_equations(const Eigen::MatrixXd& features, const Samples& samples, const Codes& active) {
  // Nearly all samples count in all channels, so their sums are computed once.
  std::vector<Eigen::Index> common;
  std::array<std::vector<Eigen::Index>, 3> own;
  for (Eigen::Index i = 0; i < features.rows(); ++i) {
    if (active.row(i).minCoeff() > 0.0)
      common.push_back(i);
    else
      for (Eigen::Index c = 0; c < 3; ++c)
        if (active(i, c) > 0.0) own[c].push_back(i);
  }
  const Eigen::MatrixXd shared = gram_of(features(common, Eigen::all));
  NormalEquations out;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::VectorXd target = samples.target.col(c).cwiseProduct(active.col(c));
    out.gram[c] = shared + gram_of(features(own[c], Eigen::all));
    out.moment[c] = features.transpose() * target;
    out.square[c] = target.squaredNorm();
    out.count[c] = active.col(c).sum();
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
    weights.col(c) = solved;
  }
  return weights;
}

std::array<double, 3> NormalEquations::residual(const Codes& weights) const {
  std::array<double, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto w = weights.col(c);
    out[c] = std::max(0.0, square[c] - 2.0 * w.dot(moment[c]) + w.dot(gram[c] * w));
  }
  return out;
}

double NormalEquations::condition() const {
  return std::max({condition_of(gram[0]), condition_of(gram[1]), condition_of(gram[2])});
}

}  // namespace tacipc
