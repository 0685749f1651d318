// The network as an ONNX file, for readers without libtorch: predict, ONNX Runtime, TensorRT.
#pragma once

#include <string>

#include "stages/image/depthnet/depthnet_config.h"
#include "stages/image/depthnet/network.h"

namespace tacipc {

/// An ONNX model (operator set 11) that says what `forward` of the module says, for images of one size alone; inputs
/// and output are those of common/sample/depth_model.h, and so is the look of the training, if it is known. \pre the
/// module is make_network(config, …)
std::string onnx_of(const torch::jit::Module& module, const NetworkConfig& config, const ImageSize& size,
                    const TrainedLook* look = nullptr);

}  // namespace tacipc
