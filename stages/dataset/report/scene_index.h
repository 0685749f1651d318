// Page over several scenes: for each a row of pictures, key numbers, and a link to its own page.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// Reads the scenes of --scene and writes the page and its pictures. The record counts the gels that passed and failed,
/// as on the page of a scene.
/// \throw DataError for a folder without a scene
void report_scenes(Stage& stage);

}  // namespace tacipc
