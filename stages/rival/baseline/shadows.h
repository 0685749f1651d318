// Taxim's shadows around a contact [SiYuan2022].
#pragma once

#include <vector>

#include "common/image/image.h"
#include "common/rival/shadow_table.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Pixels within two dilations of a contact by 5 × 5 pixels of `pixel_factor`, without the contact itself.
std::vector<bool> ring_around(const std::vector<bool>& contact, int width, int height, double pixel_factor);

/// Darkens `change` (grey levels) around a contact. Rays start from every pixel of the contact's ring, towards smaller
/// indentation and at −0.1, −0.05 and 0.05 rad to that direction, in steps of 1.25 pixels. Where the indentation is
/// smaller than at the ring's pixel, the change becomes at most the list's level of that step, for the direction and
/// depth (rounded down) at the ring's pixel. Step 0 of a list is never used. Then the whole change is blurred by σ = 2
/// pixels and by OpenCV's window of 5. These pixels are those of the table's own images, each `pixel_factor` pixels of
/// this image.
void cast_shadows(FloatImage& change, const ShadowTable& table, const Raster& indentation_m,
                  const std::vector<bool>& contact, double pixel_m, double pixel_factor);

}  // namespace tacipc
