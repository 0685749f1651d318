// Statistics of a network's training images, disturbed as its training disturbs them.
#pragma once

#include <vector>

#include "common/benchmark/trained_look.h"
#include "stages/image/depthnet/depthnet_config.h"
#include "stages/image/depthnet/training_set.h"

namespace tacipc {

/// Statistics of the items of this size, or of some hundreds spread over them; frames of a sample belong together. \pre
/// there is one
TrainedLook training_look(const std::vector<DepthItem>& items, const ImageSize& size, const DepthnetConfig& config);

/// How an item that is not disturbed compares with it.
LookComparison compare(const TrainedLook& look, const DepthItem& item);

}  // namespace tacipc
