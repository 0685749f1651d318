// Episodes in the layout of UniVTAC's HDF5Handler: an HDF5 file each, encoded images, scalar-first quaternions, metres.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/value.h"
#include "stages/dataset/repack/episodes.h"

namespace tacipc {

/// Files `<kind>/<split>/hdf5/<index>.hdf5`; the index is the sample's in the plan, of a grasp that of its left finger.
/// docs/pack.md lists the contents; for content that an episode lacks, an attribute of the group says why. Returns what
/// the record says.
Value::Map write_univtac(std::vector<std::filesystem::path> shards, const OutputPath& output);

}  // namespace tacipc
