#include "common/rival/light_network.h"

#include <cmath>

#include "common/base/error.h"
#include "common/format/npy.h"

namespace tacipc {

int num_parameters() {
  int count = 0;
  for (std::size_t l = 0; l < LightNetwork::kLayers; ++l)
    count += (LightNetwork::kWidths[l] + 1) * LightNetwork::kWidths[l + 1];
  return count;
}

LightNetwork::LightNetwork() {
  for (std::size_t l = 0; l < kLayers; ++l) {
    layers[l].weights = Eigen::MatrixXf::Zero(kWidths[l + 1], kWidths[l]);
    layers[l].bias = Eigen::VectorXf::Zero(kWidths[l + 1]);
  }
}

LightNetwork LightNetwork::read(const std::filesystem::path& path) {
  const NpyArray array = read_npy(path, {static_cast<std::size_t>(num_parameters())});
  for (const double value : array.data)
    if (!std::isfinite(value)) throw DataError("{}: a weight is not finite", path.string());
  LightNetwork network;
  const double* value = array.data.data();
  for (Layer& layer : network.layers) {
    for (float& weight : layer.weights.reshaped<Eigen::RowMajor>()) weight = static_cast<float>(*value++);
    for (float& bias : layer.bias) bias = static_cast<float>(*value++);
  }
  return network;
}

void LightNetwork::write(const std::filesystem::path& path) const {
  std::vector<double> values;
  for (const Layer& layer : layers) {
    for (const float weight : layer.weights.reshaped<Eigen::RowMajor>()) values.push_back(double{weight});
    for (const float bias : layer.bias) values.push_back(double{bias});
  }
  write_npy(path, {values.size()}, values.data());
}

Eigen::MatrixXf LightNetwork::forward(const Eigen::MatrixXf& inputs) const {
  Eigen::MatrixXf values = inputs;
  for (std::size_t l = 0; l < kLayers; ++l) {
    const Eigen::MatrixXf sums = (layers[l].weights * values).colwise() + layers[l].bias;
    values = l < kRectified ? sums.cwiseMax(0.0F).eval() : sums;
  }
  return values;
}

std::array<float, 5> LightNetwork::input(int x, int y, int width, int height, double slope_x, double slope_y) {
  const double length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
  return {static_cast<float>(x) / static_cast<float>(width), static_cast<float>(y) / static_cast<float>(height),
          static_cast<float>(0.5 * (1.0 - slope_x / length)), static_cast<float>(0.5 * (1.0 - slope_y / length)),
          static_cast<float>(0.5 * (1.0 + 1.0 / length))};
}

}  // namespace tacipc
