// The images that a dataset stores for each frame: key `maps` of the dataset's configuration. `plan` writes it to
// maps.yaml, `render` reads it. The only unit that names the key and the file.
#pragma once

#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/render_folder.h"

namespace tacipc {

/// Selection of images per frame.
struct DatasetMaps {
  std::vector<FrameFile> files = {};  // ordered as the enum

  /// Returns whether the selection holds this image.
  bool has(FrameFile file) const;
  /// Reads the key `maps`. Without it: the images that `pack` stores, and traction.
  /// \throw ConfigError if the tactile image is missing
  static DatasetMaps read(ConfigReader& in);
  /// Returns the selection as the text of maps.yaml.
  std::string yaml() const;
};

}  // namespace tacipc
