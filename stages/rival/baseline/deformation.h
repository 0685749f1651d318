// Membrane of depth-based simulators: the object's own shape, blurred.
#pragma once

#include "stages/rival/baseline/baseline_config.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Protrusion h = max(front − depth, 0) of the object into the undeformed gel, m. NaN (nothing visible) counts as 0.
/// \pre equal sizes
Raster protrusion(const Raster& depth_m, const Raster& front_depth_m);

/// Indentation of the membrane, m, > 0 into the gel, from the protrusion h:
/// - difference of Gaussians [Gomes2021]: with S(f, k) = max(k * f · max h / max(k * f), h) (factor 1 if max(k * f) is
/// 0), a = Sᵗ(h, k1), b = Sᵗ(Sᵗ(h, k2), k1) over t iterations, 2 a − b. It bulges (< 0) around the contact.
/// - exponential kernel [baseline of Tacchi2023]: the 13 × 13 kernel on h, 0 outside the image.
/// - two Gaussians, as in Chen et al. (2022): with M(f, k) = max(k * f, h): S = Mᵗ(h, k1), B = Mᵘ(h, k2), and k1 * (2 S
/// − B).
/// - pyramid [SiYuan2022, Zhao2024]: starting from f = h, every level but the last sets f ← k * f and then f = h where
/// the object keeps its height (held_pixels). The last level blurs the result.
/// - rigid, none: h. A rigid object's own normals may light it; the normals of a map are its slopes.
/// \param pressed_m depth of the press; the deepest protrusion counts if it is larger
Raster membrane_indentation(const Raster& protrusion_m, const DeformationConfig& config, double pressed_m = 0.0);

/// Pixels of a pyramid that keep the object's height: in contact, and deeper than contact_share of `pressed_m` (or of
/// the deepest protrusion, if that is larger).
std::vector<bool> held_pixels(const Raster& protrusion_m, const DeformationConfig& config, double pressed_m);

/// Adds N(0, σ) to every value, which depends only on seed and pixel.
void add_texture(Raster& depth_m, double sigma_m, std::uint64_t seed);

}  // namespace tacipc
