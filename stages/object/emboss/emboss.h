// Makes a coin with a relief from a pattern.
#pragma once

#include "common/image/image.h"
#include "stages/object/emboss/emboss_config.h"

namespace tacipc {

/// Height of a wall across its outline, as a fraction: a ramp of width `wall` centred on d = 0, its two corners rounded
/// by averaging over d ± rounding. With P(t) = ∫ ramp = 0, (t + w/2)² / 2w, t for t below, on and above the wall:
/// (P(d + r) − P(d − r)) / 2r. C¹, 0 for d ≤ −w/2 − r, 1 for d ≥ w/2 + r.
/// \pre wall > 0, rounding > 0
double wall_height(double signed_distance_m, double wall_m, double rounding_m);

/// Height of a picture pattern.
/// \throw DataError if the file is not a readable image or has a single grey level
Height read_picture_height(const PictureSource& source, const ReliefShape& relief);

/// Relief over the face as a fraction of its height; 0 from `free_radius_m` + wall/2 + rounding on.
/// \throw DataError as read_picture_height
Height face_relief(const EmbossConfig& config);

/// The coin and its measures.
struct EmbossedCoin {
  TriangleMesh mesh;
  double spacing_m = 0.0;        // spacing of the vertices on the face
  double relief_height_m = 0.0;  // highest point above the plain face
  double raised_share = 0.0;     // fraction of the face's area that is higher than half the relief
};

/// Makes the coin.
/// \throw DataError if the pattern leaves the face plain
EmbossedCoin emboss(const EmbossConfig& config, const Height& relief);

/// Picture of the relief seen from outside, x right, y up: grey level 255 · fraction, over the square around the coin.
ByteImage relief_picture(const EmbossConfig& config, const Height& relief, int width_px);

}  // namespace tacipc
