// Seeds that follow from names: any sample can be made alone, in any order.
#pragma once

#include <cstdint>
#include <string_view>

#include "common/base/rng.h"

namespace tacipc {

/// Seed of what has this name in a dataset of this global seed; 53 bits, which every reader of numbers keeps.
constexpr std::uint64_t seed_of(std::uint64_t global_seed, std::string_view name) {
  return random_bits(global_seed, hash_of(name), 0) >> 11;
}

}  // namespace tacipc
