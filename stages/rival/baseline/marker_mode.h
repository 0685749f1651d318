// Runs `baseline` with a section `markers`: writes folders of marker displacements in the format of press.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// Writes a folder depth_NNNN for every frame of the press in --press: a press to the depth of that frame, followed by
/// the motion after the press. Markers, poses and phases have the format that marker_fit reads.
void move_markers(Stage& stage);

}  // namespace tacipc
