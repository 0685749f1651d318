// A tactile image and its background described by few numbers, by which photographs are compared with the images that a
// network was trained on (trained_look.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/image/image.h"

namespace tacipc {

/// Parts of a look: two of the background, two of the image's change against it.
/// - pattern: mean code of each of 8 × 6 cells, per channel
/// - relief: what a plane of its own leaves of each cell's 4 × 4 blocks: edges of something that touches
/// - level: quartiles over the cells of the change, per channel: most of a gel is not touched
/// - shading: of the changed region, each independent of its place: to which side each channel gets lighter (lamps have
///   sides), each channel's share of the change, their correlations, and the logarithm of the change
enum class LookPart { pattern, relief, level, shading };
inline constexpr std::array kLookParts{"pattern", "relief", "level", "shading"};
inline constexpr std::array<Eigen::Index, kLookParts.size()> kLookSizes{144, 2304, 9, 13};

/// Numbers of each part, in units of the smallest difference that matters: 2 codes, 1 code, 1.5 codes, a tenth. Those
/// of the change are empty where only a background is looked at.
struct ImageLook {
  std::array<Eigen::VectorXd, kLookParts.size()> parts;
  double change_codes = 0.0;  // root of the mean square of the change, without its noise

  const Eigen::VectorXd& operator[](LookPart part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Both as a network sees them, codes. \pre three channels, of one size
ImageLook look_of(const FloatImage& background, const FloatImage& image);
ImageLook look_of(const FloatImage& background);

/// How rough each of the 8 × 6 cells is by a relief, or by what it is off another one: the root of the mean square,
/// less that of the median cell, so that noise, which is everywhere, does not count.
Eigen::VectorXd roughness_of(const Eigen::VectorXd& relief);
inline constexpr Eigen::Index kRoughnessSize = 48;

/// How a picture may differ from what the camera saw.
struct ImageTurn {
  bool swapped = false;     // red and blue
  bool transposed = false;  // rows and columns, then …
  bool left_right = false;  // mirrored
  bool top_bottom = false;

  bool operator==(const ImageTurn&) const = default;
};
FloatImage turned(const FloatImage& image, const ImageTurn& turn);

}  // namespace tacipc
