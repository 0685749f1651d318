// The ONNX files that depthnet writes and predict reads (docs/depthnet.md): model_<width>x<height>.onnx.
#pragma once

namespace tacipc {

struct DepthModel {
  static constexpr const char* kProducer = "tacipc depthnet";
  // Inputs, codes, f32 (1, H, W, 3).
  static constexpr const char* kImage = "image";
  static constexpr const char* kReference = "reference";
  // Output, f32 (1, 1, H, W).
  static constexpr const char* kIndentation = "indentation_mm";
  // Metadata: what the images of the training looked like (common/benchmark/trained_look.h).
  static constexpr const char* kTrainedLook = "trained_look";
};

}  // namespace tacipc
