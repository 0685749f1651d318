// Light network of the simulator FOTS [Zhao2024]: a small network that maps pixel position and normal to a colour
// change.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace tacipc {

/// Layers 5 → 32 → 32 → 32 → 3, ReLU after the first two, the others linear. Input: x/W and y/H in 0 … 1, and (n + 1)/2
/// of the unit normal n ∝ (−h_x, −h_y, 1), with h the membrane's height into the gel. Output: change of the 8-bit value
/// over 255. Single precision, one thread.
class LightNetwork {
 public:
  static constexpr std::array<int, 5> kWidths{5, 32, 32, 32, 3};
  static constexpr int kLayers = 4;
  static constexpr int kRectified = 2;  // number of layers with ReLU
  struct Layer {
    Eigen::MatrixXf weights;  // outputs × inputs
    Eigen::VectorXf bias;
  };

  LightNetwork();  // sets all weights to zero
  /// Reads weights and biases layer by layer, each matrix row by row: f8, one axis.
  /// \throw DataError if their number does not fit this network, or one is not finite
  static LightNetwork read(const std::filesystem::path& path);
  void write(const std::filesystem::path& path) const;

  /// Maps inputs, one column per pixel, to changes over 255, one column of three each.
  Eigen::MatrixXf forward(const Eigen::MatrixXf& inputs) const;
  /// Returns the input of pixel (x, y) of an image whose surface rises into the gel with these slopes along columns and
  /// rows.
  static std::array<float, 5> input(int x, int y, int width, int height, double slope_x, double slope_y);

  std::array<Layer, kLayers> layers;
};

/// Returns the number of weights and biases: 2403.
int num_parameters();

}  // namespace tacipc
