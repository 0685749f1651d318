// Membranes given by height maps alone, as simulators without a gel mesh leave them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/image/image.h"
#include "common/sensor/sensor.h"
#include "stages/image/render/deformation.h"

namespace tacipc {

/// Frame i + 1 is the i-th map. A vertex per pixel, where the ray through the pixel's centre has the height
/// −indentation; two triangles per square of four. A ring half as wide as the window continues outside it as the
/// outermost pixels are.
class HeightMaps : public Deformation {
 public:
  /// Maps hold the indentation, m, > 0 into the gel, in the camera's size. \throw DataError if a pixel does not look at
  /// the front face, or the sensor's front is not flat
  HeightMaps(std::vector<FloatImage> maps, const Sensor& sensor, bool refract);

  std::size_t num_frames() const override { return maps_.size() + 1; }
  Membrane at_rest() const override;
  void move(Membrane& membrane, std::size_t frame) const override;

 private:
  std::vector<FloatImage> maps_;
  std::vector<Vector3> rest_;   // per pixel, on z = 0
  std::vector<Vector3> shift_;  // per pixel: by how much the point on its ray moves per metre of height
};

/// Reads such maps (EXR, channel Y). \throw DataError if one is not of the camera's size or has numbers that are not
/// finite
std::vector<FloatImage> read_height_maps(const std::vector<std::filesystem::path>& files, const Camera& camera);

}  // namespace tacipc
