#include "stages/object/emboss/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/rng.h"

namespace tacipc {
namespace {

using std::numbers::pi;
using std::numbers::sqrt3;

Vector2 on_circle(double radius, double angle) { return radius * Vector2(std::cos(angle), std::sin(angle)); }

/// u minus the nearest multiple of the pitch.
double wrapped(double u, double pitch) { return u - pitch * std::round(u / pitch); }

/// Random point of square (i, j), in units of the pitch.
Vector2 cell_point(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  // Points lie at 0.1 … 0.9 of the square, so that two never coincide.
  const auto row = static_cast<std::uint64_t>(j), column = static_cast<std::uint64_t>(i);
  const auto inside = [&](std::uint64_t axis) { return 0.1 + 0.8 * random_uniform(seed, row, 2 * column + axis); };
  return {static_cast<double>(i) + inside(0), static_cast<double>(j) + inside(1)};
}

}  // namespace

double segment_distance(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 ab = b - a, ap = p - a;
  const double squared = ab.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(ap.dot(ab) / squared, 0.0, 1.0) : 0.0;
  return (ap - t * ab).norm();
}

double polygon_distance(const Points2& corners, const Vector2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Vector2 &a = corners[j], &b = corners[i];
    nearest = std::min(nearest, segment_distance(p, a, b));
    // A ray to the right crosses ab if it passes the height of p; the lower end counts, the upper end does not.
    if ((a.y() <= p.y()) != (b.y() <= p.y())) {
      const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (x > p.x()) inside = !inside;
    }
  }
  return inside ? nearest : -nearest;
}

Points2 regular_polygon(int sides, double radius_m, double turn_rad) {
  Points2 corners;
  for (int i = 0; i < sides; ++i) corners.push_back(on_circle(radius_m, pi / 2 + turn_rad + 2 * pi * i / sides));
  return corners;
}

Points2 star_polygon(int points, double outer_m, double inner_m) {
  Points2 corners;
  for (int i = 0; i < 2 * points; ++i)
    corners.push_back(on_circle(i % 2 == 0 ? outer_m : inner_m, pi / 2 + pi * i / points));
  return corners;
}

Points2 gear_polygon(int teeth, double root_m, double tip_m, double tip_share) {
  constexpr int kChords = 6;
  const double pitch = 2 * pi / teeth;
  Points2 corners;
  const auto arc = [&](double radius, double from, double to) {
    for (int i = 0; i <= kChords; ++i) corners.push_back(on_circle(radius, from + (to - from) * i / kChords));
  };
  for (int tooth = 0; tooth < teeth; ++tooth) {
    const double middle = pi / 2 + pitch * tooth;
    arc(tip_m, middle - tip_share * pitch / 2, middle + tip_share * pitch / 2);
    arc(root_m, middle + pitch / 4, middle + 3 * pitch / 4);
  }
  return corners;
}

double bars_distance(double u, double pitch_m, double width_m) { return width_m / 2 - std::abs(wrapped(u, pitch_m)); }

double checker_distance(const Vector2& p, double square_m) {
  const double column = std::round(p.x() / square_m), row = std::round(p.y() / square_m);
  const double to_line = square_m / 2 - std::max(std::abs(p.x() - column * square_m), std::abs(p.y() - row * square_m));
  const bool up = std::fmod(std::abs(column + row), 2.0) == 0.0;
  return up ? to_line : -to_line;
}

double bricks_distance(const Vector2& p, double length_m, double height_m, double gap_m) {
  const double row = std::round(p.y() / height_m);
  const double shift = std::fmod(std::abs(row), 2.0) * length_m / 2;
  const double dx = (length_m - gap_m) / 2 - std::abs(wrapped(p.x() - shift, length_m));
  const double dy = (height_m - gap_m) / 2 - std::abs(p.y() - row * height_m);
  if (dx < 0.0 && dy < 0.0) return -std::hypot(dx, dy);
  return std::min(dx, dy);
}

Vector2 nearest_hexagonal(const Vector2& p, double pitch_m) {
  // The lattice consists of two rectangular ones, the second shifted by half a rectangle.
  const Vector2 side(pitch_m, sqrt3 * pitch_m);
  Vector2 best = Vector2::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const double shift : {0.0, 0.5}) {
    const Vector2 q(side.x() * (std::round(p.x() / side.x() - shift) + shift),
                    side.y() * (std::round(p.y() / side.y() - shift) + shift));
    if (const double squared = (p - q).squaredNorm(); squared < least) {
      least = squared;
      best = q;
    }
  }
  return best;
}

double hexagon_border_distance(const Vector2& p, double pitch_m) {
  const Vector2 r = p - nearest_hexagonal(p, pitch_m);
  const double towards =
      std::max({std::abs(r.x()), std::abs(r.x() + sqrt3 * r.y()) / 2, std::abs(r.x() - sqrt3 * r.y()) / 2});
  return pitch_m / 2 - towards;
}

double cell_border_distance(const Vector2& p, double pitch_m, std::uint64_t seed) {
  const Vector2 q = p / pitch_m;
  const auto i0 = static_cast<std::int64_t>(std::floor(q.x())), j0 = static_cast<std::int64_t>(std::floor(q.y()));
  // The nearest point, and the neighbours that bound its cell near p, are at most two squares away.
  constexpr int kReachSquares = 2, kSide = 2 * kReachSquares + 1;
  std::array<Vector2, kSide * kSide> points;
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto di = static_cast<std::int64_t>(k % kSide) - kReachSquares,
               dj = static_cast<std::int64_t>(k / kSide) - kReachSquares;
    points[k] = cell_point(i0 + di, j0 + dj, seed);
    if ((points[k] - q).squaredNorm() < (points[nearest] - q).squaredNorm()) nearest = k;
  }
  const Vector2 a = points[nearest];
  double border = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k == nearest) continue;
    const Vector2 b = points[k];
    border = std::min(border, ((a + b) / 2 - q).dot((b - a).normalized()));
  }
  return pitch_m * border;
}

}  // namespace tacipc
