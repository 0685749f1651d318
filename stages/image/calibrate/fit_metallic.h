// Fits the colours of TACTO's light sources to photographs of balls and known objects. The membrane is TACTO's: the
// object itself, cut by the front.
#pragma once

#include <vector>

#include "common/rival/metallic_lamps.h"
#include "common/sensor/sensor.h"
#include "stages/image/calibrate/samples.h"

namespace tacipc {

/// Samples of one photograph, with the light of each source of colour 1, on the object and on the front without it.
struct MetallicSamples {
  Samples samples;
  Eigen::MatrixXd object, empty;  // samples × light sources; equal where the object is not in the gel
};

/// Samples of a ball around (x, y), `depth_m` deep, on the camera's rays.
MetallicSamples metallic_samples(const Samples& samples, const Vector3& ball_m, double radius_m,
                                 const std::vector<MetallicLamp>& lamps, const Sensor& sensor);

/// Samples of an object given by its height into the gel (m) on the camera's rays, with the normals of that map.
MetallicSamples metallic_samples(const Samples& samples, const FloatImage& height_m,
                                 const std::vector<MetallicLamp>& lamps, const Sensor& sensor);

/// Change of grey level of sample i in channel c.
double metallic_change(const MetallicSamples& samples, const MetallicLamps& lamps, Eigen::Index i, std::size_t c);

/// Root mean square of change − photograph over the used samples, grey levels.
double metallic_rmse(const std::vector<MetallicSamples>& balls, const MetallicLamps& lamps);

/// Least squares over the colours (≥ 0) and the factor, starting from `start`; the positions stay.
MetallicLamps fit_metallic(const std::vector<MetallicSamples>& balls, const MetallicLamps& start);

}  // namespace tacipc
