// What `baseline` does with a section `markers`: folders of marker displacements as press writes them.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// For every frame of the press in --press a folder depth_NNNN with a press as deep as it, followed by the motion that
/// follows that press; markers, poses and phases as marker_fit reads them.
void move_markers(Stage& stage);

}  // namespace tacipc
