// Statistics of a network's training images, augmented as in its training.
#pragma once

#include <vector>

#include "common/benchmark/trained_look.h"
#include "stages/image/depthnet/depthnet_config.h"
#include "stages/image/depthnet/training_set.h"

namespace tacipc {

/// Statistics of the items of this size, or of some hundreds spread over them; frames of a sample belong together.
/// \pre there is such an item
TrainedLook training_look(const std::vector<DepthItem>& items, const ImageSize& size, const DepthnetConfig& config);

/// Compares an item without augmentation with these statistics.
LookComparison compare(const TrainedLook& look, const DepthItem& item);

}  // namespace tacipc
