// A sample of a shard as small files, each frame apart: what a folder and a WebDataset archive hold.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/format/hdf5_reader.h"

namespace tacipc {

/// Takes a file's name and bytes.
using TakeFile = std::function<void(const std::string& name, std::string_view bytes)>;

/// Files `<id>/frame_NNNN.<rest>`, frame after frame; `rest` holds the first dot of the name, so that WebDataset takes
/// the files of a frame together:
/// - `<field>.png` for images of codes, `<field>.npy` for other fields of more than 16 numbers; of `sim` and of
/// variants
///   `sim.<field>.…`, `<variant>.<field>.…`
/// - `json` with all smaller fields and, under `sample`, the sample's attributes
/// - with frame 0 alone, fields that have no frames and the configurations the sample was made with (`<name>.yaml`).
void write_frames(const Hdf5Reader& shard, const std::string& id, const TakeFile& take);

/// What one needs to read the files: the attributes of the shard, of its sensors and of each field.
std::string fields_json(const Hdf5Reader& shard);

}  // namespace tacipc
