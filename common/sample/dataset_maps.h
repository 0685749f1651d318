// Which images of a frame a dataset wants: `maps` of its configuration, passed on by `plan` in maps.yaml, obeyed by
// `render`. The only place that knows their names.
#pragma once

#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/render_folder.h"

namespace tacipc {

struct DatasetMaps {
  std::vector<FrameFile> files = {};  // in the order of the enum

  bool has(FrameFile file) const;
  /// The key `maps`; without it what `pack` stores, and traction. The tactile image must be among them.
  static DatasetMaps read(ConfigReader& in);
  /// The same as a file.
  std::string yaml() const;
};

}  // namespace tacipc
