// Collisions known by construction: pairs that touch at a known time, exactly, in numbers that doubles hold.
#pragma once

#include "tests/stages/gel/press/contact/exact_collision.h"
#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {

struct Impact {
  FourPoints start, displacement;
  double time;  // when start + time × displacement touches
};

/// What is special about the four points when they touch.
enum class Meeting {
  plain,       // mostly inside triangle or edges
  one_plane,   // all four points and their paths are in one plane
  parallel,    // parallel edges; a point that slides in the triangle's plane
  degenerate,  // a triangle without area, an edge without length
};
constexpr Meeting kMeetings[] = {Meeting::plain, Meeting::one_plane, Meeting::parallel, Meeting::degenerate};

inline FourPoints operator*(double s, FourPoints x) {
  for (Vector3& point : x) point *= s;
  return x;
}
inline FourPoints operator+(FourPoints x, const FourPoints& y) {
  for (int i = 0; i < 4; ++i) x[i] += y[i];
  return x;
}
inline FourPoints operator-(const FourPoints& x, const FourPoints& y) { return x + -1.0 * y; }

inline int random_int(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

/// Moves the first point into the triangle, or the second edge so that it crosses the first, at multiples of 1/16 of
/// the points given.
inline FourPoints touching(ContactPair::Kind kind, FourPoints y, std::mt19937& random) {
  const double scale = 16;
  if (kind == ContactPair::Kind::point_triangle) {
    const int b1 = random_int(random, 0, 16), b2 = random_int(random, 0, 16 - b1);
    y[0] = ((16 - b1 - b2) * y[1] + b1 * y[2] + b2 * y[3]) / scale;
  } else {
    // Edge x2x3 through a point of edge x0x1, cut there in a ratio of small integers.
    const int s = random_int(random, 0, 16);
    const Vector3 meeting = ((16 - s) * y[0] + s * y[1]) / scale;
    const Vector3 along = y[3];
    y[2] = meeting - random_int(random, 0, 3) * along;
    y[3] = meeting + random_int(random, 0, 3) * along;
  }
  return y;
}

/// Coordinates are multiples of 1/256 below 2^11.
inline Impact random_impact(ContactPair::Kind kind, Meeting meeting, std::mt19937& random) {
  FourPoints y = lattice_points(random, 64), v = lattice_points(random, random() % 3 == 0 ? 1 : 100);
  const bool point_triangle = kind == ContactPair::Kind::point_triangle;
  if (meeting == Meeting::one_plane) {
    const FourPoints axes = lattice_points(random, 3);
    const auto in_plane = [&](FourPoints x) {
      for (Vector3& point : x) point = point.x() * axes[0] + point.y() * axes[1];
      return x;
    };
    y = in_plane(lattice_points(random, 8));
    v = in_plane(lattice_points(random, 8));
  }
  if (meeting == Meeting::degenerate) {
    // Corners in one line, or in one point.
    const Vector3 along = y[3];
    for (int i = point_triangle ? 2 : 1; i < 4; ++i) y[i] = y[1] + random_int(random, -2, 2) * along;
  }
  if (meeting == Meeting::parallel && !point_triangle) {
    const Vector3 along = lattice_points(random, 8)[0];
    y[1] = y[0] + 4 * along;
    y[2] = y[0] + random_int(random, 0, 4) * along;
    y[3] = y[0] + random_int(random, -4, 8) * along;
  } else if (meeting == Meeting::degenerate && !point_triangle) {
    y[3] = y[2] = y[0] + random_int(random, 0, 4) * (y[1] - y[0]) / 4;
    if (random() % 2 == 0) y = {y[2], y[3], y[0], y[1]};
  } else {
    y = touching(kind, y, random);
  }
  if (meeting == Meeting::parallel && point_triangle) {
    v[0] = v[1] + random_int(random, -3, 3) * (y[2] - y[1]) + random_int(random, -3, 3) * (y[3] - y[1]);
    v[2] = v[3] = v[1];
  }
  const double time = random_int(random, 0, 16) / 16.0;
  return {y - time * v, v, time};
}

/// The same elsewhere, in a frame that moves, and of another size; all exact for powers of two and integers below 2^40.
inline Impact transformed(const Impact& impact, double scale, const Vector3& offset, const Vector3& velocity) {
  const FourPoints by{offset, offset, offset, offset}, moving{velocity, velocity, velocity, velocity};
  return {scale * (impact.start + by - impact.time * moving), scale * (impact.displacement + moving), impact.time};
}

}  // namespace tacipc
