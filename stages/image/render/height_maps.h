// Membranes from height maps alone, as simulators without a gel mesh give them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/image/render/deformation.h"

namespace tacipc {

/// Membrane with a vertex per pixel, on the ray through the pixel's centre at the height −indentation, and two
/// triangles per square of four. Frame i + 1 is the i-th map. A ring half as wide as the field of view continues it
/// outside like the outermost pixels.
class HeightMaps : public Deformation {
 public:
  /// \param maps indentation, m, > 0 into the gel, in the camera's size
  /// \throw DataError if a pixel does not look at the front face, or the sensor's front is not flat
  HeightMaps(std::vector<FloatImage> maps, const Sensor& sensor, bool refract);

  std::size_t num_frames() const override { return maps_.size() + 1; }
  Membrane at_rest() const override;
  void move(Membrane& membrane, std::size_t frame) const override;

 private:
  std::vector<FloatImage> maps_;
  std::vector<Vector3> rest_;   // per pixel, on z = 0
  std::vector<Vector3> shift_;  // per pixel, displacement of the point on its ray per metre of height
};

/// Reads such maps (EXR, channel Y).
/// \throw DataError if one does not have the camera's size or has numbers that are not finite
std::vector<FloatImage> read_height_maps(const std::vector<std::filesystem::path>& files, const Camera& camera);

}  // namespace tacipc
