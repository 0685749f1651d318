// Poisson's ratio from which `press` uses averaged-volume elements, for code that predicts the cost of a press run.
#pragma once

namespace tacipc {

/// Poisson's ratio from which element averaged_volume is the better choice: smaller force error for the same time
/// (docs/performance.md).
constexpr double kAveragedVolumeFrom = 0.4;

}  // namespace tacipc
