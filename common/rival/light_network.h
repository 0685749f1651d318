// Light of a sensor as a small network of place and normal, as FOTS has it [Zhao2024].
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace tacipc {

/// Layers 5 → 32 → 32 → 32 → 3, ReLU behind the first two, the others linear. Input: x/W and y/H in 0 … 1, (n + 1)/2 of
/// the unit normal (−h_x, −h_y, 1), h the membrane's height into the gel. Output: change of code over 255.
/// Single precision, one thread.
class LightNetwork {
 public:
  static constexpr std::array<int, 5> kWidths{5, 32, 32, 32, 3};
  static constexpr int kLayers = 4;
  static constexpr int kRectified = 2;  // layers with ReLU
  struct Layer {
    Eigen::MatrixXf weights;  // outputs × inputs
    Eigen::VectorXf bias;
  };

  LightNetwork();  // all zero
  /// Weights and biases layer by layer, each matrix row by row: f8, one axis. \throw DataError if there are not as many
  /// as this network has, or one is not finite
  static LightNetwork read(const std::filesystem::path& path);
  void write(const std::filesystem::path& path) const;

  /// A column of inputs per pixel → change over 255, a column of three.
  Eigen::MatrixXf forward(const Eigen::MatrixXf& inputs) const;
  /// The input of pixel (x, y) of an image whose surface rises into the gel by these slopes along columns and rows.
  static std::array<float, 5> input(int x, int y, int width, int height, double slope_x, double slope_y);

  std::array<Layer, kLayers> layers;
};

/// 2403
int num_parameters();

}  // namespace tacipc
