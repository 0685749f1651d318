// One sample as an episode in the layout of UniVTAC: HDF5, groups tactile/left_tactile.
#pragma once

#include <filesystem>
#include <string>

#include "common/format/hdf5_reader.h"

namespace tacipc {

/// Writes rgb, rgb_marker (u8), depth and press_depth (f4, mm, positive: away from the camera, into the gel), marker
/// (T, 2, N, 2: [reference, current] column and row), pose (T, 7: x, y, z in mm and quaternion w, x, y, z of the object
/// in S) of those the sample has; what it has not says why in an attribute of the group.
void write_univtac(const Hdf5Reader& shard, const std::string& id, const std::filesystem::path& path);

}  // namespace tacipc
