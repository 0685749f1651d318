// Shadow table of the simulator Taxim [SiYuan2022]: lists of darkening along a ray that leaves the contact, measured
// once at a pin pressed to several depths.
#pragma once

#include <filesystem>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// The table: one list per channel, direction and depth of the pin.
struct ShadowTable {
  static constexpr double kDirectionStep = 0.1;   // rad, directions begin at 0
  static constexpr double kFirstDepthM = 0.4e-3;  // first depth of the pin
  static constexpr double kDepthStepM = 0.1e-3;
  int directions = 0, depths = 0, steps = 0;
  std::vector<double> codes;  // 8-bit levels, 3 × directions × depths × steps, ≤ 0; the first 0 ends a list

  /// Reads an array of that shape.
  /// \throw DataError if the shape differs, a value is not finite or above 0, or the directions are not a full turn in
  /// steps of 0.1 rad (63)
  static ShadowTable read(const std::filesystem::path& path);

  /// Returns the list of a channel from its first step on, without the terminating 0.
  /// \pre indices in range
  std::vector<double> list(int channel, int direction, int depth) const;
};

}  // namespace tacipc
