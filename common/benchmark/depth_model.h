// Depth networks in ONNX files model_<width>x<height>.onnx: written by `depthnet`, read by `depthnet` and `predict`
// (docs/depthnet.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/trained_look.h"
#include "common/benchmark/unet.h"

namespace tacipc {

/// Weights (out × in × width × width) and biases (out) of a convolution.
struct Convolution {
  std::vector<float> weights, biases;
  bool operator==(const Convolution&) const = default;
};

/// A network that estimates depth from images of one size.
/// Files may come from untrusted sources, so a file determines numbers only: sizes and weights are taken from it, the
/// graph is built from them, and a file with another graph is refused.
struct DepthModel {
  // Inputs, 8-bit levels as f32, (1, H, W, 3).
  static constexpr const char* kImage = "image";
  static constexpr const char* kReference = "reference";
  // Output, f32 (1, 1, H, W).
  static constexpr const char* kIndentation = "indentation_mm";

  NetworkConfig network;
  int rows = 0, columns = 0;
  std::vector<Convolution> convolutions;  // order of write_unet()
  std::optional<TrainedLook> look;        // statistics of the training images; absent in files of earlier versions

  /// Returns the file's bytes (operator set 11).
  /// \pre as many weights as the network has
  std::string to_onnx() const;
  /// Reads a network; `name` stands for the file in messages.
  /// \throw DataError if the bytes are no such file, are damaged, or hold weights that are not finite
  static DepthModel from_onnx(const std::string& bytes, const std::string& name);
};

/// Reads a file.
/// \throw DataError as from_onnx(). A TorchScript archive, which is a program, is not run; the message names it
DepthModel read_depth_model(const std::filesystem::path& file);

}  // namespace tacipc
