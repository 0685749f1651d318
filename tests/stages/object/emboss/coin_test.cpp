#include "stages/object/emboss/coin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "stages/object/emboss/emboss.h"
#include "tests/closed_surface.h"

namespace tacipc {
namespace coin_test {

using std::numbers::pi;

const CoinShape kCoin{.radius_m = 5.6e-3, .thickness_m = 2e-3, .fillet_m = 0.2e-3};

double plain(const Vector2&) { return 0.0; }

/// A smooth hill of 0.4 mm in the middle.
double hill(const Vector2& p) {
  const double t = std::max(0.0, 1.0 - p.squaredNorm() / 16e-6);
  return 0.4e-3 * t * t;
}

void expect_closed_sphere(const TriangleMesh& mesh) {
  expect_closed(mesh.triangles);
  EXPECT_EQ(2 * mesh.num_vertices() - mesh.num_triangles(), 4) << "Euler: three edges for two triangles";
}

/// πR²T less the fillet's corner: area (1 − π/4) f², its centroid f / (6 − 3π/2) inside the circle's centre line
/// (Pappus).
double coin_volume(const CoinShape& s) {
  const double corner = (1.0 - pi / 4) * s.fillet_m * s.fillet_m;
  const double centroid = s.face_radius_m() + s.fillet_m / (6.0 - 1.5 * pi);
  return pi * s.radius_m * s.radius_m * s.thickness_m - 2 * pi * centroid * corner;
}

TEST(CoinMesh, IsClosedWithAndWithoutReliefAndFillet) {
  for (const double fillet : {0.0, 0.2e-3, 1.9e-3}) {
    CoinShape shape = kCoin;
    shape.fillet_m = fillet;
    for (const double spacing : {3e-3, 0.5e-3, 0.11e-3}) {
      SCOPED_TRACE(testing::Message() << "fillet " << fillet << ", spacing " << spacing);
      expect_closed_sphere(coin_mesh(shape, spacing, plain));
      expect_closed_sphere(coin_mesh(shape, spacing, hill));
    }
  }
}

TEST(CoinMesh, VolumeIsTheCoinsLessTheChords) {
  const auto missing = [](double spacing) {
    return 1.0 - signed_volume(coin_mesh(kCoin, spacing, plain)) / coin_volume(kCoin);
  };
  // Chords of the coarsened lower rings keep a little missing at any spacing of the face.
  for (const double spacing : {0.4e-3, 0.1e-3, 0.05e-3}) {
    EXPECT_GT(missing(spacing), 0.0) << spacing;
    EXPECT_LT(missing(spacing), spacing == 0.4e-3 ? 0.004 : 0.0015) << spacing;
  }
}

TEST(CoinMesh, ReliefAddsItsOwnVolume) {
  // ∫ 0.4 mm (1 − r²/a²)² = 0.4 mm π a² / 3, a = 4 mm
  const double added = signed_volume(coin_mesh(kCoin, 0.05e-3, hill)) - signed_volume(coin_mesh(kCoin, 0.05e-3, plain));
  EXPECT_NEAR(added, 0.4e-3 * pi * 16e-6 / 3, 1e-3 * added);
}

TEST(CoinMesh, TrianglesOfThePlainFaceAreNearlyEquilateral) {
  const TriangleMesh mesh = coin_mesh(kCoin, 0.1e-3, plain);
  double worst_angle = pi, least_area = 1.0;
  for (Eigen::Index t = 0; t < mesh.num_triangles(); ++t) {
    const auto corner = [&](int c) -> Vector3 { return mesh.positions.row(mesh.triangles(t, c % 3)); };
    least_area = std::min(least_area, 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm());
    const bool on_face = corner(0).z() == 2e-3 && corner(1).z() == 2e-3 && corner(2).z() == 2e-3;
    for (int c = 0; on_face && c < 3; ++c) {
      const Vector3 a = corner(c + 1) - corner(c), b = corner(c + 2) - corner(c);
      worst_angle = std::min(worst_angle, std::acos(a.dot(b) / (a.norm() * b.norm())));
    }
  }
  EXPECT_GT(worst_angle, 35.0 * pi / 180);
  EXPECT_GT(least_area, 0.2 * 0.1e-3 * 0.1e-3);
}

TEST(CoinMesh, LiesWhereItsShapeSays) {
  const TriangleMesh mesh = coin_mesh(kCoin, 0.2e-3, hill);
  EXPECT_DOUBLE_EQ(mesh.positions(0, 2), 2.4e-3);
  EXPECT_EQ(mesh.positions(mesh.num_vertices() - 1, 2), 0.0);
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3 x = mesh.positions.row(v);
    const double r = x.head<2>().norm();
    EXPECT_LE(r, 5.6e-3 * (1 + 1e-15));
    EXPECT_GE(x.z(), 0.0);
    if (r < 4e-3 && x.z() > 1e-3) {
      EXPECT_DOUBLE_EQ(x.z(), 2e-3 + hill(x.head<2>()));
    }
    if (r > 5.4001e-3 && x.z() > 1.8e-3) {
      EXPECT_NEAR(std::hypot(r - 5.4e-3, x.z() - 1.8e-3), 0.2e-3, 1e-15);
    }
  }
}

TEST(CoinRings, FaceRingsHaveSixTimesTheirNumberOfVertices) {
  const auto rings = coin_rings(kCoin, 0.1e-3);
  for (int k = 1; k <= 54; ++k) EXPECT_EQ(rings[static_cast<std::size_t>(k - 1)].count, 6 * k);
  EXPECT_EQ(rings.back().z_m, 0.0);
}

TEST(CoinSpacing, GivesAtLeastTheVerticesAndLittleMore) {
  for (const int wanted : {500, 5000, 50000, 500000}) {
    const int vertices = coin_vertices(coin_rings(kCoin, coin_spacing(kCoin, wanted)));
    EXPECT_GE(vertices, wanted);
    EXPECT_LT(vertices, 1.25 * wanted);
    if (wanted >= 50000) {
      EXPECT_LT(vertices, 1.03 * wanted);
    }
  }
}

}  // namespace coin_test
}  // namespace tacipc
