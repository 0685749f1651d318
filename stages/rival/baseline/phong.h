// Phong shading of depth-based simulators over a photograph: light by light, in whole grey levels.
#pragma once

#include "common/image/image.h"
#include "stages/rival/baseline/baseline_config.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Blend ⌊clamp((1 − opacity) image + opacity colour, 0, 255)⌋. The opacity may leave [0, 1]; only the grey level is
/// clamped.
std::uint8_t overlaid(double code, double opacity, double color);

/// Opacity of one light on a membrane of unit normal (nx, ny, nz):
///   max(k_d d, 0) + k_s R_z^p,  d = N · L, R = 2 d N − L   (L not normalised; odd powers keep the sign).
double phong_opacity(const PhongLight& light, const std::array<double, 3>& normal, int shininess);

/// Normal (−dz/dx, −dz/dy, 1) / |…| of depth / metres_per_pixel at a pixel, by central differences along columns (to
/// the right) and rows (downwards); 0 across the outermost pixels, as for a mirrored border.
std::array<double, 3> phong_normal(const Raster& depth_m, double metres_per_pixel, int x, int y);

/// Tactile image [Gomes2021]: ambient × background fades to black with `darkening` / gel thickness (clamped to [0, 1]).
/// Then each light's colour is blended in with its opacity; grey levels are truncated every time. The blur comes last.
/// \param darkening_m protrusion of the object or indentation of the membrane, m
/// \pre equal sizes, RGB
ByteImage phong_image(const ByteImage& background, const Raster& depth_m, const Raster& darkening_m,
                      const PhongConfig& config);

}  // namespace tacipc
