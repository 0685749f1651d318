// Writes episodes in the layout of UniVTAC's HDF5Handler: an HDF5 file each, encoded images, scalar-first quaternions,
// metres.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/value.h"
#include "stages/dataset/repack/episodes.h"

namespace tacipc {

/// Writes files `<kind>/<split>/hdf5/<index>.hdf5`. The index is the sample's in the plan, for a grasp that of its left
/// finger. docs/pack.md lists the contents; if an episode lacks one, an attribute of the group gives the reason.
/// \return lines of the record
Value::Map write_univtac(std::vector<std::filesystem::path> shards, const OutputPath& output);

}  // namespace tacipc
