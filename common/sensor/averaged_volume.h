// Which gels press simulates with averaged volumes, for whoever predicts what that costs.
#pragma once

namespace tacipc {

/// Poisson's ratio from which averaged_volume is the better choice: less error of the force for the same time
/// (docs/performance.md).
constexpr double kAveragedVolumeFrom = 0.4;

}  // namespace tacipc
