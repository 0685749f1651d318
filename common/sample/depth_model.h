// The ONNX files that depthnet writes and predict reads (docs/depthnet.md): model_<width>x<height>.onnx.
#pragma once

namespace tacipc {

struct DepthModel {
  static constexpr const char* producer = "tacipc depthnet";
  // Inputs, codes, f32 (1, H, W, 3).
  static constexpr const char* image = "image";
  static constexpr const char* reference = "reference";
  // Output, f32 (1, 1, H, W).
  static constexpr const char* indentation = "indentation_mm";
};

}  // namespace tacipc
