// Reproducible points for the tests of contact geometry.
#pragma once

#include <random>
#include <sstream>
#include <string>

#include "stages/gel/press/contact/distance.h"

namespace tacipc {

/// Integer coordinates in [−size, size]: a small size gives every degenerate case sooner or later.
inline FourPoints lattice_points(std::mt19937& random, int size) {
  FourPoints x;
  for (Vector3& point : x)
    for (double& coordinate : point) coordinate = static_cast<int>(random() % (2u * size + 1)) - size;
  return x;
}

/// Uniform in [−1, 1).
inline double random_unit(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-31 - 1; }

inline Vector3 random_vector(std::mt19937& random) {
  const double x = random_unit(random), y = random_unit(random), z = random_unit(random);
  return {x, y, z};
}

inline FourPoints random_points(std::mt19937& random) {
  FourPoints x;
  for (Vector3& point : x) point = random_vector(random);
  return x;
}

inline std::string to_string(const FourPoints& x) {
  std::ostringstream out;
  out.precision(17);
  for (const Vector3& point : x) out << '(' << point.transpose() << ") ";
  return out.str();
}

}  // namespace tacipc
