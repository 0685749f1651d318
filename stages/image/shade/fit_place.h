// Finds where on a photograph a simulated press belongs.
#pragma once

#include "common/image/image.h"
#include "common/sample/front_frames.h"
#include "common/sensor/light_field.h"
#include "common/sensor/print_relief.h"
#include "common/sensor/sensor.h"
#include "stages/image/shade/shade_config.h"

namespace tacipc {

/// Front of a press moved from the origin to its place in the image.
Positions at_place(const Positions& front, const ImagePlace& place, const Sensor& sensor);
/// The rigid motion that does it: Rz(yaw), then the translation.
Matrix4 place_pose(const ImagePlace& place, const Sensor& sensor);

/// What the camera sees of a frame at a place, with the object's print if its relief is given.
MembraneView view_at(const FrontFrames& press, int frame, const ImagePlace& place, const PrintRelief* relief,
                     const Sensor& sensor);

struct FittedPlace {
  ImagePlace place;
  double rmse_before = 0.0;  // codes, in the box
  double rmse_after = 0.0;
  int views = 0;  // images computed
};

/// Minimises over centre and yaw (if asked) the square sum, over the box, of background + change − photograph less each
/// channel's mean difference outside the box. Pattern search: steps of 1 pixel and 1 degree both ways along each
/// parameter, halved when none improves it, until 1/32: the result does not depend on derivatives of a tessellated
/// surface.
FittedPlace fit_place(const FrontFrames& press, int frame, const ImagePlace& start, const PlaceFit& fit,
                      const ByteImage& photograph, const ByteImage& background, const LightField& light,
                      const Sensor& sensor, const PrintRelief* relief = nullptr);

}  // namespace tacipc
