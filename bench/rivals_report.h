// What a tactile image costs by each method, as a table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/benchmark/image_speeds.h"

namespace tacipc::bench {

/// A row per method, columns per size, as measured on `processor` after a minute in which `load` processes wanted one.
/// `frames`: of TacIPC's presses. \pre all methods in each size, in one order
std::string rivals_table(const std::vector<ImageSpeed>& speeds, std::size_t frames, const std::string& processor,
                         double load);

}  // namespace tacipc::bench
