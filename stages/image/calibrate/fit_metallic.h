// Colours of TACTO's lamps from photographs of balls and known objects on its own membranes: the object itself, cut by
// the front.
#pragma once

#include <vector>

#include "common/rival/metallic_lamps.h"
#include "common/sensor/sensor.h"
#include "stages/image/calibrate/samples.h"

namespace tacipc {

/// Samples of one photograph under the lamps: light of each, of colour 1, on the object and on the front without it.
struct MetallicSamples {
  Samples samples;
  Eigen::MatrixXd object, empty;  // samples × lamps; equal where the object is not in the gel
};

/// The ball about (x, y), `depth_m` deep, on the camera's rays.
MetallicSamples metallic_samples(const Samples& samples, const Vector3& ball_m, double radius_m,
                                 const std::vector<MetallicLamp>& lamps, const Sensor& sensor);

/// An object by its height into the gel (m) on the camera's rays, with the normals of that map.
MetallicSamples metallic_samples(const Samples& samples, const FloatImage& height_m,
                                 const std::vector<MetallicLamp>& lamps, const Sensor& sensor);

/// Change of code of sample i in channel c.
double metallic_change(const MetallicSamples& samples, const MetallicLamps& lamps, Eigen::Index i, std::size_t c);

/// Root mean square of change − photograph over the samples used, codes.
double metallic_rmse(const std::vector<MetallicSamples>& balls, const MetallicLamps& lamps);

/// Least squares over the colours (≥ 0) and the factor, from where `start` has them; the places stay.
MetallicLamps fit_metallic(const std::vector<MetallicSamples>& balls, const MetallicLamps& start);

}  // namespace tacipc
