// The ONNX files that depthnet writes, and that depthnet and predict read (docs/depthnet.md):
// model_<width>x<height>.onnx.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/trained_look.h"
#include "common/benchmark/unet.h"

namespace tacipc {

/// Weights of a convolution: out × in × width × width of them, and out.
struct Convolution {
  std::vector<float> weights, biases;
  bool operator==(const Convolution&) const = default;
};

/// A network that reads depth from images of one size.
///
/// Files come from strangers, so a file decides numbers and nothing else: sizes and weights are taken from it, the
/// graph is built from them, and a file whose graph is any other is refused.
struct DepthModel {
  // Inputs, codes, f32 (1, H, W, 3).
  static constexpr const char* kImage = "image";
  static constexpr const char* kReference = "reference";
  // Output, f32 (1, 1, H, W).
  static constexpr const char* kIndentation = "indentation_mm";

  NetworkConfig network;
  int rows = 0, columns = 0;
  std::vector<Convolution> convolutions;  // in the order of write_unet
  std::optional<TrainedLook> look;        // of the training's images; files of earlier versions have none

  /// The file's bytes (operator set 11). \pre as many weights as the network has
  std::string to_onnx() const;
  /// \throw DataError, which begins with the name, if the bytes are no such file, are damaged, or hold weights that are
  /// no numbers
  static DepthModel from_onnx(const std::string& bytes, const std::string& name);
};

/// \throw DataError as from_onnx. A TorchScript archive, which is a program, is not run and refused by that name.
DepthModel read_depth_model(const std::filesystem::path& file);

}  // namespace tacipc
