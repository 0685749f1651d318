#include "stages/image/calibrate/train_network.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/rng.h"

namespace tacipc {
namespace {

constexpr std::uint64_t kStartStream = 0x73746172, kShuffleStream = 0x73687566, kDropStream = 0x64726f70;

/// Draws a mask with sixteen random bits per value, so each random number gives four.
Eigen::MatrixXf dropout_mask(Eigen::Index rows, Eigen::Index columns, double dropout, std::uint64_t seed,
                             std::uint64_t& counter) {
  const auto threshold = static_cast<std::uint64_t>(dropout * 65536.0);
  const auto kept = static_cast<float>(1.0 / (1.0 - dropout));
  Eigen::MatrixXf mask(rows, columns);
  float* value = mask.data();
  const Eigen::Index size = mask.size();
  for (Eigen::Index i = 0; i < size; i += 4) {
    std::uint64_t bits = random_bits(seed, kDropStream, counter++);
    for (Eigen::Index k = i; k < std::min(i + 4, size); ++k, bits >>= 16)
      value[k] = (bits & 0xffff) < threshold ? 0.0F : kept;
  }
  return mask;
}

/// Adam's two running means for one array of parameters.
struct Moments {
  Eigen::ArrayXf first, second;

  void step(float* parameters, const float* gradient, Eigen::Index size, double rate, int t) {
    if (first.size() == 0) {
      first = Eigen::ArrayXf::Zero(size);
      second = Eigen::ArrayXf::Zero(size);
    }
    constexpr float kFirst = 0.9F, kSecond = 0.999F, kSmall = 1e-8F;
    const Eigen::Map<const Eigen::ArrayXf> g(gradient, size);
    Eigen::Map<Eigen::ArrayXf> p(parameters, size);
    first = kFirst * first + (1.0F - kFirst) * g;
    second = kSecond * second + (1.0F - kSecond) * g * g;
    const auto bias1 = static_cast<float>(1.0 - std::pow(double{kFirst}, t));
    const auto bias2 = static_cast<float>(1.0 - std::pow(double{kSecond}, t));
    p -= static_cast<float>(rate) * (first / bias1) / ((second / bias2).sqrt() + kSmall);
  }
};

}  // namespace

NetworkSamples network_samples(const std::vector<std::vector<ContactPixel>>& balls, int width_px, int height_px) {
  std::vector<const ContactPixel*> wanted;
  for (const auto& pixels : balls)
    for (const ContactPixel& pixel : pixels)
      if (pixel.all_used() && (pixel.slope_x != 0.0 || pixel.slope_y != 0.0)) wanted.push_back(&pixel);
  NetworkSamples samples;
  samples.inputs.resize(5, static_cast<Eigen::Index>(wanted.size()));
  samples.targets.resize(3, samples.inputs.cols());
  for (Eigen::Index i = 0; i < samples.inputs.cols(); ++i) {
    const ContactPixel& pixel = *wanted[i];
    const auto input = LightNetwork::input(pixel.x, pixel.y, width_px, height_px, pixel.slope_x, pixel.slope_y);
    samples.inputs.col(i) = Eigen::Map<const Eigen::Matrix<float, 5, 1>>(input.data());
    for (Eigen::Index c = 0; c < 3; ++c) samples.targets(c, i) = static_cast<float>(pixel.target[c] / 255.0);
  }
  return samples;
}

LightNetwork initial_network(std::uint64_t seed) {
  LightNetwork network;
  std::uint64_t counter = 0;
  for (LightNetwork::Layer& layer : network.layers) {
    const double bound = 1.0 / std::sqrt(static_cast<double>(layer.weights.cols()));
    const auto next = [&] {
      return static_cast<float>(bound * (2.0 * random_uniform(seed, kStartStream, counter++) - 1.0));
    };
    for (float& weight : layer.weights.reshaped()) weight = next();
    for (float& bias : layer.bias) bias = next();
  }
  return network;
}

double loss_and_gradient(const LightNetwork& network, const NetworkSamples& samples, const DropoutMasks& masks,
                         LightNetwork& gradient) {
  constexpr std::size_t kHidden = LightNetwork::kLayers - 1;
  std::array<Eigen::MatrixXf, LightNetwork::kLayers> values;  // input of each layer
  std::array<Eigen::MatrixXf, kHidden> slopes;                // derivative of each layer's output by its sum
  values[0] = samples.inputs;
  for (std::size_t l = 0; l < kHidden; ++l) {
    Eigen::MatrixXf sums = (network.layers[l].weights * values[l]).colwise() + network.layers[l].bias;
    const bool dropped = masks[l].size() > 0;
    slopes[l] = dropped ? masks[l] : Eigen::MatrixXf::Ones(sums.rows(), sums.cols());
    if (l < LightNetwork::kRectified) slopes[l] = (sums.array() > 0.0F).select(slopes[l], 0.0F);
    values[l + 1] = sums.cwiseProduct(slopes[l]);
  }
  const LightNetwork::Layer& last = network.layers[kHidden];
  const Eigen::MatrixXf residual = ((last.weights * values[kHidden]).colwise() + last.bias) - samples.targets;
  const double count = static_cast<double>(residual.size());
  Eigen::MatrixXf back = static_cast<float>(2.0 / count) * residual;
  for (std::size_t l = LightNetwork::kLayers; l-- > 0;) {
    gradient.layers[l].weights = back * values[l].transpose();
    gradient.layers[l].bias = back.rowwise().sum();
    if (l > 0) back = (network.layers[l].weights.transpose() * back).cwiseProduct(slopes[l - 1]).eval();
  }
  return residual.cast<double>().squaredNorm() / count;
}

LightNetwork train_network(const NetworkSamples& samples, const NetworkFit& settings) {
  const Eigen::Index count = samples.inputs.cols();
  if (count == 0) throw DataError("no ball has a slanted pixel in its contact that is not clipped");
  LightNetwork network = initial_network(settings.seed), gradient;
  std::array<std::array<Moments, 2>, LightNetwork::kLayers> moments;
  std::vector<Eigen::Index> order(count);
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::uint64_t shuffled = 0, dropped = 0;
  int steps = 0;
  for (int epoch = 0; epoch < settings.epochs; ++epoch) {
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[random_bits(settings.seed, kShuffleStream, shuffled++) % (i + 1)]);
    double loss = 0.0;
    for (Eigen::Index first = 0; first < count; first += settings.batch) {
      const Eigen::Index size = std::min<Eigen::Index>(settings.batch, count - first);
      const std::span chosen(order.data() + first, static_cast<std::size_t>(size));
      const NetworkSamples batch{.inputs = samples.inputs(Eigen::all, chosen),
                                 .targets = samples.targets(Eigen::all, chosen)};
      DropoutMasks masks;
      if (settings.dropout > 0.0)
        for (std::size_t l = 0; l < masks.size(); ++l)
          masks[l] = dropout_mask(LightNetwork::kWidths[l + 1], size, settings.dropout, settings.seed, dropped);
      loss += loss_and_gradient(network, batch, masks, gradient) * static_cast<double>(size);
      ++steps;
      for (std::size_t l = 0; l < LightNetwork::kLayers; ++l) {
        LightNetwork::Layer& layer = network.layers[l];
        const LightNetwork::Layer& slope = gradient.layers[l];
        moments[l][0].step(layer.weights.data(), slope.weights.data(), layer.weights.size(), settings.rate, steps);
        moments[l][1].step(layer.bias.data(), slope.bias.data(), layer.bias.size(), settings.rate, steps);
      }
    }
    constexpr int kEpochsPerLine = 50;
    if ((epoch + 1) % kEpochsPerLine == 0)
      log_info("epoch {}: {:.2f} codes", epoch + 1, 255.0 * std::sqrt(loss / static_cast<double>(count)));
  }
  return network;
}

}  // namespace tacipc
