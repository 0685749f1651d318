// Table of the cost of a tactile image by simulator.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/benchmark/image_speeds.h"

namespace tacipc::bench {

/// A row per simulator, columns per image size.
/// \param frames number of frames of TacIPC's presses
/// \param processor model of the machine that measured
/// \param load mean number of ready processes in the minute before
/// \pre every size has all simulators, in the same order
std::string rivals_table(const std::vector<ImageSpeed>& speeds, std::size_t frames, const std::string& processor,
                         double load);

}  // namespace tacipc::bench
