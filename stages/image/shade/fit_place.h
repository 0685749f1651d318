// Finds the position of a simulated press on a photograph.
#pragma once

#include "common/benchmark/image_places.h"
#include "common/image/image.h"
#include "common/sample/front_frames.h"
#include "common/sensor/light_field.h"
#include "common/sensor/print_relief.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Front of a press, moved from the origin to its position in the image.
Positions at_place(const Positions& front, const ImagePlace& place, const Sensor& sensor);

/// Camera's view of a frame at a position, with the object's print if its relief is given.
MembraneView view_at(const FrontFrames& press, int frame, const ImagePlace& place, const PrintRelief* relief,
                     const Sensor& sensor);

/// Position at which the press explains the photograph best, by search_place.
FittedPlace fit_place(const FrontFrames& press, int frame, const ImagePlace& start, const PlaceFit& fit,
                      const ByteImage& photograph, const ByteImage& background, const LightField& light,
                      const Sensor& sensor, const PrintRelief* relief = nullptr);

}  // namespace tacipc
