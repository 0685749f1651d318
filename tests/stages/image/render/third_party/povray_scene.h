// A membrane and its lights as a scene of POV-Ray, a renderer that shares no line with ours.
#pragma once

#include <filesystem>
#include <string>

#include "common/image/image.h"
#include "common/optics/membrane.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// What both renderers can do of a sensor: its pinhole at the same place with the same window, light that goes
/// straight, white Lambert paint, no veil, and eight point lights, equally strong in all directions, on the ring of its
/// first LED: three red, three green, two blue ones. \throw DataError if its picture cannot be halved
Sensor comparable_sensor(const Sensor& sensor);

struct PovrayScene {
  std::string text = {};
  /// Radiance that POV-Ray calls 1. It follows from the lights alone, and nothing in the picture is brighter.
  double white = 0.0;
};

/// POV-Ray weakens light by 2 / (1 + (d / f)²): with f of 10 µm that is 2 f² / d² within 1e-6 from a centimetre on, so
/// a light of I / (2 f² w) gives I cos θ / (w d²). Our paint's radiance is I cos θ / (π d²): hence white = w / π. One
/// unit is 0.1 mm: POV-Ray overlooks what a shadow ray meets within 1e-3 units, here 1e-7 m.
/// \pre the sensor is a comparable one
PovrayScene povray_scene(const Membrane& membrane, const Sensor& sensor);

/// Whether there is a program `povray`.
bool povray_is_there();

/// Renders the scene file into a picture beside it: a ray through each pixel's centre, linear values.
/// \throw DataError if that fails; `povray.log` beside it says why
void run_povray(const std::filesystem::path& scene, const std::filesystem::path& picture, const Camera& camera,
                int threads);

/// A PPM file of 16 bits per value (big-endian, as written by POV-Ray), values 0 … 1.
/// \throw DataError for anything else
FloatImage read_ppm16(const std::filesystem::path& path);

}  // namespace tacipc
