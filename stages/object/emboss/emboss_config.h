// Content of configs/objects/patterns/*.yaml.
#pragma once

#include "common/config/config.h"
#include "stages/object/emboss/coin.h"
#include "stages/object/emboss/pattern.h"

namespace tacipc {

/// Shape of the relief.
struct ReliefShape {
  double height_m = 0.0;
  double wall_m = 0.0;      // width of a wall seen from above
  double rounding_m = 0.0;  // half width of the rounding at a wall's foot and top
};

/// Fine noise on everything inside the margin, as on a print or a cast.
struct Roughness {
  double height_m = 0.0;  // 0: no noise
  double size_m = 1.0;    // grain size
  std::uint64_t seed = 0;
};

/// Configuration of emboss.
struct EmbossConfig {
  CoinShape coin;
  ReliefShape relief;
  Roughness roughness;
  double margin_m = 0.0;  // width of the plain face between relief and fillet
  int vertices = 0;       // least number of mesh vertices
  Pattern pattern;

  /// Radius of the outline that bounds the relief; its wall ends `margin` before the fillet.
  double free_radius_m() const;

  static EmbossConfig read(ConfigReader& in);
};

}  // namespace tacipc
