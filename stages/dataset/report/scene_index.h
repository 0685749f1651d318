// The page over several scenes: of each a row of pictures and its key numbers, and a link to its own page.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// Reads the scenes that --scene names and writes the page and its pictures; the record counts the gels that passed and
/// failed, as on a page of their own. \throw DataError for a folder that has no scene
void report_scenes(Stage& stage);

}  // namespace tacipc
