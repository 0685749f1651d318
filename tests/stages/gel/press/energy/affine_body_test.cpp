#include "stages/gel/press/energy/affine_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace affine_body_test {

template <typename Matrix>
Matrix random_matrix(std::uint64_t seed, Eigen::Index rows, Eigen::Index columns) {
  Matrix out(rows, columns);
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out(i / columns, i % columns) = random_normal(seed, 0, static_cast<std::uint64_t>(i));
  return out;
}
Matrix3 random_matrix3(std::uint64_t seed) { return random_matrix<Matrix3>(seed, 3, 3); }

Matrix3 some_rotation() { return Eigen::AngleAxisd(2.2, Vector3(1, -2, 0.5).normalized()).toRotationMatrix(); }

/// A box of 30 × 20 × 10 mm, turned, half a metre from the origin.
constexpr double kDensity = 1200.0, kMass = 1200.0 * 0.03 * 0.02 * 0.01;
const Vector3 kCenter(0.3, -0.4, 0.1);
TriangleMesh turned_box() {
  TriangleMesh box = make_box({-0.015, -0.01, -0.005}, {0.015, 0.01, 0.005});
  box.positions = (box.positions * some_rotation().transpose()).rowwise() + kCenter.transpose();
  return box;
}
/// Its second moment, in closed form.
Matrix3 box_second_moment() {
  const Matrix3 squares = Vector3(9e-4, 4e-4, 1e-4).asDiagonal();
  return some_rotation() * squares * some_rotation().transpose() / 12.0;
}
AffineBody turned_box_body() {
  const TriangleMesh box = turned_box();
  return make_affine_body(box.positions, box.triangles, kDensity);
}
ControlPoints mapped(const AffineBody& body, const Matrix3& A, const Vector3& shift) {
  return (body.rest_m * A.transpose()).rowwise() + shift.transpose();
}

TEST(AffineBody, FourParticlesHaveItsMassCenterAndSecondMoment) {
  const AffineBody body = turned_box_body();
  EXPECT_NEAR(body.mass_kg, kMass, 1e-14 * kMass);
  EXPECT_NEAR(body.volume_m3, 6e-6, 1e-14 * 6e-6);
  EXPECT_LT((center_of(body.rest_m) - kCenter).norm(), 1e-15);
  const ControlPoints arms = body.rest_m.rowwise() - kCenter.transpose();
  const Matrix3 S = box_second_moment();
  EXPECT_LT((arms.transpose() * arms / 4.0 - S).norm(), 1e-13 * S.norm());  // the points' places are rounded at 0.5 m
  const Matrix3 inertia = kMass * (S.trace() * Matrix3::Identity() - S);
  EXPECT_LT((body.rest_inertia_kg_m2 - inertia).norm(), 1e-13 * inertia.norm());
}

/// About the origin no rounding of places hides the last digits.
TEST(AffineBody, FourParticlesHaveItsKineticEnergyInEveryAffineMotion) {
  const TriangleMesh box = make_box({-0.015, -0.01, -0.005}, {0.015, 0.01, 0.005});
  const AffineBody body = make_affine_body(box.positions, box.triangles, kDensity);
  const Matrix3 S = Vector3(9e-4 / 12.0, 4e-4 / 12.0, 1e-4 / 12.0).asDiagonal();
  EXPECT_LT((body.rest_m.transpose() * body.rest_m / 4.0 - S).norm(), 1e-14 * S.norm());
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Matrix3 A_rate = 100.0 * random_matrix3(seed);
    const Vector3 c_rate = random_matrix<Eigen::Vector3d>(seed + 100, 3, 1);
    // ½ ∫ ρ |ċ + Ȧ X|² dV
    const double exact = 0.5 * kMass * (c_rate.squaredNorm() + (A_rate * S * A_rate.transpose()).trace());
    const double of_particles = 0.5 * 0.25 * body.mass_kg * mapped(body, A_rate, c_rate).squaredNorm();
    EXPECT_NEAR(of_particles, exact, 1e-14 * exact) << seed;
  }
}

/// The particles move with the centre: their second moment about it is the solid's about its own.
TEST(AffineBody, ItsCenterOfMassMayLieBesideThatOfTheSolid) {
  const TriangleMesh box = make_box({-0.015, -0.01, -0.005}, {0.015, 0.01, 0.005});
  const Vector3 shift(4e-3, -3e-3, 1e-3);
  const AffineBody solid = make_affine_body(box.positions, box.triangles, kDensity),
                   body = make_affine_body(box.positions, box.triangles, kDensity, shift);
  EXPECT_EQ(body.mass_kg, solid.mass_kg);
  EXPECT_EQ(body.rest_inertia_kg_m2, solid.rest_inertia_kg_m2);
  EXPECT_LT((center_of(body.rest_m) - center_of(solid.rest_m) - shift).norm(), 1e-15);
  EXPECT_LT((body.weights * body.rest_m - box.positions).cwiseAbs().maxCoeff(), 1e-15);
  // A turn about the new centre leaves it where it is.
  const Matrix3 turn = some_rotation();
  const ControlPoints turned = rigid_points(body, center_of(body.rest_m), turn);
  EXPECT_LT((pose_of(body, turned).topLeftCorner<3, 3>() - turn).norm(), 1e-12);
  EXPECT_LT((pose_of(body, turned).topRightCorner<3, 1>() - (shift - turn * shift)).norm(), 1e-12);
}

TEST(AffineBody, WeightsReproduceVerticesAndLinearFunctions) {
  TriangleMesh shape = make_l_shape();
  shape.positions = 0.01 * (shape.positions * some_rotation().transpose());
  const AffineBody body = make_affine_body(shape.positions, shape.triangles, kDensity);
  ASSERT_EQ(body.weights.rows(), shape.positions.rows());
  EXPECT_LT((body.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-15);
  EXPECT_LT((body.weights * body.rest_m - shape.positions).cwiseAbs().maxCoeff(), 1e-16);
  const Matrix3 A = random_matrix3(1);
  const Vector3 shift(0.01, -0.02, 0.03);
  const Positions expected = (shape.positions * A.transpose()).rowwise() + shift.transpose();
  EXPECT_LT((body.weights * mapped(body, A, shift) - expected).cwiseAbs().maxCoeff(), 2e-16);
}

/// Corners of a box: X = ½ sides, Λ = sides²/12, so β = ¼ (1 ± √3 (±1 ± 1 ± 1)), whatever the sides.
TEST(AffineBody, WeightsOfABoxByHand) {
  const AffineBody body = turned_box_body();
  EXPECT_NEAR(body.weights.maxCoeff(), 0.25 * (1.0 + 3.0 * std::sqrt(3.0)), 1e-12);
  EXPECT_NEAR(body.weights.minCoeff(), 0.25 * (1.0 - 3.0 * std::sqrt(3.0)), 1e-12);
}

TEST(AffineBody, WeightGradientsAreTheSlopesOfTheWeights) {
  const AffineBody body = turned_box_body();
  const Positions vertices = turned_box().positions;
  const ControlPoints g = weight_gradients(body);
  EXPECT_LT(g.colwise().sum().norm(), 1e-13 * g.norm());
  for (Eigen::Index v = 1; v < vertices.rows(); ++v) {
    const Eigen::RowVector4d rise = (vertices.row(v) - vertices.row(0)) * g.transpose();
    EXPECT_LT((rise - (body.weights.row(v) - body.weights.row(0))).norm(), 1e-12) << v;
  }
}

TEST(AffineBody, DeformationIsTheMapOfTheControlPoints) {
  const AffineBody body = turned_box_body();
  EXPECT_LT((deformation_of(body, body.rest_m) - Matrix3::Identity()).norm(), 1e-14);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Matrix3 A = random_matrix3(seed);
    EXPECT_LT((deformation_of(body, mapped(body, A, {1, 2, 3})) - A).norm(), 1e-12 * A.norm()) << seed;
  }
}

TEST(AffineBody, PoseIsTheRigidMotionFromRest) {
  const AffineBody body = turned_box_body();
  const Matrix3 R = Eigen::AngleAxisd(1.3, Vector3(0.2, 1, -1).normalized()).toRotationMatrix();
  const Vector3 shift(0.02, 0.5, -0.3);
  const Matrix4 pose = pose_of(body, mapped(body, R, shift));
  EXPECT_LT((pose.topLeftCorner<3, 3>() - R).norm(), 1e-13);
  EXPECT_LT((pose.topRightCorner<3, 1>() - shift).norm(), 1e-13);
  EXPECT_EQ(pose.row(3), Eigen::RowVector4d(0, 0, 0, 1));
  EXPECT_LT((rigid_points(body, R * kCenter + shift, R) - mapped(body, R, shift)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(AffineBody, RotationOfAStrainedBodyIsThePolarOne) {
  const AffineBody body = turned_box_body();
  const Matrix3 R = some_rotation(), B = random_matrix3(3);
  const Matrix3 U = Matrix3::Identity() + 0.1 * (B + B.transpose());  // symmetric and positive
  ASSERT_GT(U.determinant(), 0.1);
  EXPECT_LT((rotation_of(body, mapped(body, R * U, {0, 0, 1})) - R).norm(), 1e-12);
  const Matrix3 of_mirrored = rotation_of(body, mapped(body, R * Vector3(1.1, 0.9, -0.5).asDiagonal(), {0, 0, 1}));
  EXPECT_NEAR(of_mirrored.determinant(), 1.0, 1e-14);
  EXPECT_LT((of_mirrored - R).norm(), 1e-12);  // what is mirrored is the smallest stretch
}

TEST(AffineBody, StrainByHand) {
  const AffineBody body = turned_box_body();
  EXPECT_LT(strain_of(body, mapped(body, some_rotation(), {1, 0, 0})), 1e-12);
  Matrix3 A = Matrix3::Identity();
  A(0, 0) = 1.01;
  EXPECT_NEAR(strain_of(body, mapped(body, some_rotation() * A, {0, 0, 0})), 0.0201, 1e-13);
  A(0, 0) = 1.0;
  A(1, 2) = -0.03;  // AᵀA − I has −0.03 and 0.0009
  EXPECT_NEAR(strain_of(body, mapped(body, A, {0, 0, 0})), 0.03, 1e-13);
}

/// Forces on vertices of a deformed body have the wrench of the forces that they become on the control points.
TEST(AffineBody, WrenchIsThatOfTheForcesOnItsVertices) {
  const AffineBody body = turned_box_body();
  const ControlPoints control = mapped(body, random_matrix3(5), {0.1, 0.2, -0.3});
  const Positions x = body.weights * control;
  const Positions forces = random_matrix<Positions>(7, x.rows(), 3);
  const Wrench wrench = wrench_of(control, body.weights.transpose() * forces);
  const Vector3 center = control.colwise().mean().transpose();
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const Vector3 f = forces.row(v), arm = x.row(v).transpose() - center;
    force += f;
    torque += arm.cross(f);
  }
  EXPECT_LT((wrench.force_n - force).norm(), 1e-14 * forces.norm());
  EXPECT_LT((wrench.torque_n_m - torque).norm(), 1e-13 * torque.norm());
}

TEST(AffineBody, OfNoSolidIsRefused) {
  TriangleMesh box = make_box({0, 0, 0}, {1, 1, 1});
  for (const double density : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(make_affine_body(box.positions, box.triangles, density), DataError) << density;
  EXPECT_THROW(make_affine_body(make_box({0, 0, 0}, {1, 1, 1e-9}).positions, box.triangles, 1.0), DataError);
  box.triangles.col(0).swap(box.triangles.col(1));
  EXPECT_THROW(make_affine_body(box.positions, box.triangles, 1.0), DataError);
}

}  // namespace affine_body_test
}  // namespace tacipc
