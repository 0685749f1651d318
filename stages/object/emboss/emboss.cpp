#include "stages/object/emboss/emboss.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "stages/object/emboss/picture_relief.h"

namespace tacipc {
namespace {

/// Least difference between high and low that counts as a relief, as a fraction of its height.
constexpr double kLeastContrast = 0.01;

}  // namespace

double wall_height(double signed_distance_m, double wall_m, double rounding_m) {
  const auto integral = [&](double t) {
    if (t <= -wall_m / 2) return 0.0;
    return t >= wall_m / 2 ? t : (t + wall_m / 2) * (t + wall_m / 2) / (2 * wall_m);
  };
  // Exact values outside the wall, where differences of integrals would leave rounding errors.
  if (std::abs(signed_distance_m) >= wall_m / 2 + rounding_m) return signed_distance_m > 0.0 ? 1.0 : 0.0;
  const double mean =
      (integral(signed_distance_m + rounding_m) - integral(signed_distance_m - rounding_m)) / (2 * rounding_m);
  return std::clamp(mean, 0.0, 1.0);
}

Height read_picture_height(const PictureSource& source, const ReliefShape& relief) {
  return picture_height(read_png(source.path, 1),
                        {.width_m = source.width_m, .wall_m = relief.wall_m, .dark_is_high = source.dark_is_high},
                        source.path.string());
}

namespace {

/// Relief of the pattern alone.
Height pattern_relief(const EmbossConfig& config) {
  const double rim = config.free_radius_m();
  const auto wall = [shape = config.relief](double d) { return wall_height(d, shape.wall_m, shape.rounding_m); };
  if (const auto* outline = std::get_if<Outline>(&config.pattern)) {
    return [=, distance = outline->distance](const Vector2& p) { return wall(std::min(distance(p), rim - p.norm())); };
  }
  const auto* texture = std::get_if<Texture>(&config.pattern);
  const Height inside =
      texture ? texture->height : read_picture_height(std::get<PictureSource>(config.pattern), config.relief);
  return [=](const Vector2& p) {
    const double window = wall(rim - p.norm());
    return window > 0.0 ? window * inside(p) : 0.0;
  };
}

}  // namespace

Height face_relief(const EmbossConfig& config) {
  const Height pattern = pattern_relief(config);
  const Roughness rough = config.roughness;
  if (rough.height_m == 0.0) return pattern;
  const double rim = config.free_radius_m(), share = rough.height_m / config.relief.height_m;
  return [=, shape = config.relief](const Vector2& p) {
    const double window = wall_height(rim - p.norm(), shape.wall_m, shape.rounding_m);
    return pattern(p) + (window > 0.0 ? window * share * stone_height(p, rough.size_m, 1, 1.0, rough.seed) : 0.0);
  };
}

EmbossedCoin emboss(const EmbossConfig& config, const Height& relief) {
  EmbossedCoin coin;
  coin.spacing_m = coin_spacing(config.coin, config.vertices);
  const double height = config.relief.height_m;
  coin.mesh = coin_mesh(config.coin, coin.spacing_m, [&](const Vector2& p) { return height * relief(p); });

  // The rings of the face come first; all vertices represent nearly equal areas.
  const double inner = config.free_radius_m() - config.relief.wall_m / 2 - config.relief.rounding_m;
  double low = 1.0, high = 0.0;
  std::int64_t seen = 0, raised = 0;
  for (Eigen::Index v = 0; v < coin.mesh.num_vertices(); ++v) {
    const Vector3 x = coin.mesh.positions.row(v);
    const double radius = x.head<2>().norm(), fraction = (x.z() - config.coin.thickness_m) / height;
    if (radius > config.coin.face_radius_m()) break;
    ++seen;
    if (fraction > 0.5) ++raised;
    if (radius <= inner) low = std::min(low, fraction);
    if (radius <= inner) high = std::max(high, fraction);
  }
  if (high - low < kLeastContrast) {
    throw DataError("the pattern leaves the face plain: its height goes from {:.3f} to {:.3f} of {:.3f} mm",
                    std::min(low, high), high, 1e3 * height);
  }
  coin.relief_height_m = height * high;
  coin.raised_share = static_cast<double>(raised) / static_cast<double>(seen);
  return coin;
}

ByteImage relief_picture(const EmbossConfig& config, const Height& relief, int width_px) {
  ByteImage image(width_px, width_px, 1);
  const double pixel = 2.0 * config.coin.radius_m / width_px;
  tbb::parallel_for(0, width_px, [&](int row) {
    for (int column = 0; column < width_px; ++column) {
      const Vector2 p = pixel * Vector2(column + 0.5 - 0.5 * width_px, 0.5 * width_px - row - 0.5);
      image.at(column, row, 0) = static_cast<std::uint8_t>(std::lround(255.0 * relief(p)));
    }
  });
  return image;
}

}  // namespace tacipc
