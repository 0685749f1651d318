#include "common/mesh/mass_properties.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "common/base/error.h"
#include "tests/closed_surface.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace mass_properties_test {

MassProperties properties_of(const TriangleMesh& mesh) { return mass_properties(mesh.positions, mesh.triangles); }

/// An octahedron in a ball of radius 1, each face divided into four `times` times and pushed out to the ball.
TriangleMesh make_ball(int times) {
  std::vector<Vector3> vertices{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < times; ++i) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
      if (is_new) vertices.push_back((vertices[a] + vertices[b]).normalized());
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  return make_mesh(vertices, faces);
}

TEST(MassProperties, OfABoxByHand) {
  const MassProperties box = properties_of(make_box({1, 2, 3}, {4, 4, 4}));
  EXPECT_NEAR(box.volume_m3, 6.0, 1e-14);
  EXPECT_LT((box.center_m - Vector3(2.5, 3.0, 3.5)).norm(), 1e-14);
  const Matrix3 expected = Vector3(9.0, 4.0, 1.0).asDiagonal();  // squared sides
  EXPECT_LT((box.second_moment_m2 - expected / 12.0).norm(), 1e-15);
}

TEST(MassProperties, TurnWithTheBody) {
  TriangleMesh box = make_box({0, 0, 0}, {3, 2, 1});
  const Matrix3 R = Eigen::AngleAxisd(0.8, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  box.positions = box.positions * R.transpose();
  const MassProperties turned = properties_of(box);
  const Matrix3 squares = Vector3(9.0, 4.0, 1.0).asDiagonal();
  EXPECT_NEAR(turned.volume_m3, 6.0, 1e-14);
  EXPECT_LT((turned.center_m - R * Vector3(1.5, 1.0, 0.5)).norm(), 1e-14);
  EXPECT_LT((turned.second_moment_m2 - R * squares * R.transpose() / 12.0).norm(), 1e-14);
}

/// Two boxes of volume 3 and 1, joined by the parallel-axis theorem.
TEST(MassProperties, OfAnLByHand) {
  const TriangleMesh mesh = make_l_shape();
  expect_closed(mesh.triangles);
  const MassProperties shape = properties_of(mesh);
  const Vector3 c(1.25, 0.75, 0.5), to_long = Vector3(1.5, 0.5, 0.5) - c, to_short = Vector3(0.5, 1.5, 0.5) - c;
  const Matrix3 long_part = Vector3(9, 1, 1).asDiagonal(), short_part = Vector3(1, 1, 1).asDiagonal();
  const Matrix3 S = 0.75 * (long_part / 12.0 + to_long * to_long.transpose()) +
                    0.25 * (short_part / 12.0 + to_short * to_short.transpose());
  EXPECT_NEAR(shape.volume_m3, 4.0, 1e-14);
  EXPECT_LT((shape.center_m - c).norm(), 1e-14);
  EXPECT_LT((shape.second_moment_m2 - S).norm(), 1e-14);
}

TEST(MassProperties, OfFinerBallsConvergeAtSecondOrder) {
  const auto volume_error = [](int times) {
    return std::abs(properties_of(make_ball(times)).volume_m3 / (4.0 / 3.0 * std::numbers::pi) - 1.0);
  };
  const auto moment_error = [](int times) {
    return (properties_of(make_ball(times)).second_moment_m2 / 0.2 - Matrix3::Identity()).norm();  // R²/5
  };
  EXPECT_NEAR(std::log2(volume_error(4) / volume_error(5)), 2.0, 0.02);
  EXPECT_NEAR(std::log2(moment_error(4) / moment_error(5)), 2.0, 0.02);
  EXPECT_LT(volume_error(6), 1e-3);
  EXPECT_LT(moment_error(6), 1e-3);
  EXPECT_LT(properties_of(make_ball(5)).center_m.norm(), 1e-15);
}

/// 12 mm at 1 km, in numbers that a double holds exactly.
TEST(MassProperties, LoseNoDigitsFarFromTheOrigin) {
  TriangleMesh mesh = make_l_shape();
  mesh.positions *= 0x1p-8;
  const MassProperties near = properties_of(mesh);
  const Vector3 offset(1024, -512, 256);
  mesh.positions.rowwise() += offset.transpose();
  const MassProperties far = properties_of(mesh);
  EXPECT_EQ(far.volume_m3, near.volume_m3);
  EXPECT_EQ(far.second_moment_m2, near.second_moment_m2);
  EXPECT_LT((far.center_m - offset - near.center_m).norm(), 2e-13);
}

TEST(MassProperties, OfWhatEnclosesNothingAreRefused) {
  TriangleMesh inwards = make_box({0, 0, 0}, {1, 1, 1});
  inwards.triangles.col(0).swap(inwards.triangles.col(1));
  EXPECT_THROW(properties_of(inwards), DataError);
  EXPECT_THROW(properties_of(make_box({0, 0, 0}, {1, 1, 0})), DataError);
  EXPECT_THROW(mass_properties(Positions(0, 3), Triangles(0, 3)), DataError);
  TriangleMesh damaged = make_box({0, 0, 0}, {1, 1, 1});
  damaged.positions(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(properties_of(damaged), DataError);
}

TEST(MassProperties, InertiaTensorOfABoxByHand) {
  const Matrix3 I = inertia_tensor(24.0, properties_of(make_box({0, 0, 0}, {3, 2, 1})).second_moment_m2);
  const Matrix3 expected = Vector3(2.0 * (4 + 1), 2.0 * (9 + 1), 2.0 * (9 + 4)).asDiagonal();
  EXPECT_LT((I - expected).norm(), 1e-13);
}

TEST(MassProperties, SecondMomentsThatNoSolidHasAreRefused) {
  const auto diagonal = [](double a, double b, double c) -> Matrix3 { return Vector3(a, b, c).asDiagonal(); };
  EXPECT_NO_THROW(require_solid(diagonal(1, 2, 3)));
  EXPECT_NO_THROW(require_solid(diagonal(1e-3, 1e-3, 1e-9)));  // a plate, a thousand times as wide as thick
  EXPECT_THROW(require_solid(diagonal(1, 2, -0.1)), DataError);
  EXPECT_THROW(require_solid(diagonal(1, 2, 0)), DataError);
  EXPECT_THROW(require_solid(Matrix3::Zero()), DataError);
  EXPECT_THROW(require_solid(diagonal(1, 2, std::numeric_limits<double>::infinity())), DataError);
  Matrix3 skew = diagonal(1, 2, 3);
  skew(0, 1) = 1e-3;
  EXPECT_THROW(require_solid(skew), DataError);
  try {
    require_solid(diagonal(2, 1, -0.5));  // 3 > 0.5 + 1.5
    ADD_FAILURE();
  } catch (const DataError& error) {
    const std::string message = error.what();
    for (const char* moment : {"0.5", "1.5", "3"}) EXPECT_NE(message.find(moment), std::string::npos) << message;
  }
}

}  // namespace mass_properties_test
}  // namespace tacipc
