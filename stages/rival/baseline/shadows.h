// Taxim's shadows beside a contact [SiYuan2022].
#pragma once

#include <vector>

#include "common/image/image.h"
#include "common/rival/shadow_table.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Pixels within two dilations by 5 × 5 pixels of `pixel_factor` of a contact, the contact apart.
std::vector<bool> ring_around(const std::vector<bool>& contact, int width, int height, double pixel_factor);

/// Darkens `change` (codes) beside a contact: from every pixel of its ring, rays go downhill and −0.1, −0.05 and 0.05
/// rad beside it, in steps of 1.25 pixels; where the membrane is lower than at the ring's pixel, the change becomes at
/// most the list's code of that step, of the direction and depth (rounded down) there. Step 0 of a list is never used.
/// Then all of the change is blurred by σ = 2 pixels and OpenCV's window of 5. Pixels are those of the table's own
/// images: `pixel_factor` of this image's each.
void cast_shadows(FloatImage& change, const ShadowTable& table, const Raster& indentation_m,
                  const std::vector<bool>& contact, double pixel_m, double pixel_factor);

}  // namespace tacipc
