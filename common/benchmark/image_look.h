// Look of a tactile image: a few numbers that describe image and background, for comparing photographs with the
// training images of a network (trained_look.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/image/image.h"

namespace tacipc {

/// Parts of a look: two of the background, two of the image's change against it.
/// - pattern: mean value of each of 8 × 6 cells, per channel
/// - relief: residual of each cell's 4 × 4 blocks after subtracting a plane: edges of anything that touches
/// - level: quartiles over the cells of the change, per channel, because most of a gel is not in contact
/// - shading: numbers of the changed region that do not depend on its position: the direction in which each channel
///   gets lighter (lights have directions), each channel's fraction of the change, their correlations, and the
///   logarithm of the change
enum class LookPart { pattern, relief, level, shading };
inline constexpr std::array kLookParts{"pattern", "relief", "level", "shading"};
inline constexpr std::array<Eigen::Index, kLookParts.size()> kLookSizes{144, 2304, 9, 13};

/// A look. The numbers of each part are in units of the smallest relevant difference: 2, 1 and 1.5 8-bit levels, and a
/// tenth. Parts of the change are empty if only a background is described.
struct ImageLook {
  std::array<Eigen::VectorXd, kLookParts.size()> parts;
  double change_codes = 0.0;  // root mean square of the change, without its noise

  const Eigen::VectorXd& operator[](LookPart part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Describe an image and its background, or a background alone, as a network receives them (8-bit levels).
/// \pre three channels, of one size
ImageLook look_of(const FloatImage& background, const FloatImage& image);
ImageLook look_of(const FloatImage& background);

/// Returns the roughness of each of the 8 × 6 cells from a relief, or from the difference of two reliefs: the root mean
/// square, minus the median cell's, so that noise, which is everywhere, does not count.
Eigen::VectorXd roughness_of(const Eigen::VectorXd& relief);
inline constexpr Eigen::Index kRoughnessSize = 48;

/// Possible mirroring or channel swap between a picture and the camera's image.
struct ImageTurn {
  bool swapped = false;     // red and blue exchanged
  bool transposed = false;  // rows and columns exchanged, before mirroring
  bool left_right = false;  // mirrored
  bool top_bottom = false;

  bool operator==(const ImageTurn&) const = default;
};
/// Applies the turn.
FloatImage turned(const FloatImage& image, const ImageTurn& turn);

}  // namespace tacipc
