#include "stages/gel/press/contact/body_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace tacipc {
namespace body_frame_test {

class BodyFrameTest : public ::testing::Test {
 protected:
  Positions random(Eigen::Index count, double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    Positions rows(count, 3);
    for (double& c : rows.reshaped()) c = uniform(random_);
    return rows;
  }
  Matrix3 random_rotation() {
    return Eigen::AngleAxisd(3.0 * random(1, 1.0)(0, 0), Vector3(random(1, 1.0).row(0)).normalized())
        .toRotationMatrix();
  }
  static double misfit(const BodyFrame& frame, const Positions& rest, const Positions& x) {
    return (frame.places(x) - rest).squaredNorm();
  }

  std::mt19937 random_{5};
};

TEST_F(BodyFrameTest, IsTheRigidMotionOfABodyThatKeepsItsShape) {
  for (int trial = 0; trial < 20; ++trial) {
    const Positions rest = random(30, 0.01).rowwise() + random(1, 0.1).row(0);
    const Matrix3 R = random_rotation();
    const Vector3 t = random(1, 1.0).row(0);
    const Positions x = (rest * R.transpose()).rowwise() + t.transpose();
    const BodyFrame frame = body_frame(rest, x);
    EXPECT_LT((frame.rotation - R).norm(), 1e-12);
    EXPECT_LT((frame.places(x) - rest).norm(), 1e-12);
    const Positions p = random(30, 1e-3).rowwise() + random(1, 1.0).row(0);
    EXPECT_LT((frame.places(x + p) - frame.places(x) - frame.displacements(p)).norm(), 1e-13);
    EXPECT_LT(frame.displacements(p).norm(), 0.02) << "the way of all is none of its own";
    // Distances are kept, with the body at x as on its way to x + p.
    const Positions way = frame.places(x) + 0.3 * frame.displacements(p), at = x + 0.3 * p;
    for (int v = 1; v < 30; ++v) EXPECT_NEAR((way.row(v) - way.row(0)).norm(), (at.row(v) - at.row(0)).norm(), 1e-13);
  }
}

/// No other turn fits better, whatever the deformation.
TEST_F(BodyFrameTest, FitsADeformedBodyBest) {
  for (int trial = 0; trial < 20; ++trial) {
    const Positions rest = random(30, 0.01);
    Positions x = rest;
    x.col(2) *= 0.5;
    x = (x + random(30, 1e-3)) * random_rotation();
    const BodyFrame frame = body_frame(rest, x);
    EXPECT_NEAR(frame.rotation.determinant(), 1.0, 1e-14);
    EXPECT_LT((frame.rotation * frame.rotation.transpose() - Matrix3::Identity()).norm(), 1e-14);
    const double best = misfit(frame, rest, x);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double by : {-1e-3, 1e-3}) {
        BodyFrame turned = frame;
        turned.rotation = Eigen::AngleAxisd(by, Vector3::Unit(axis)) * frame.rotation;
        EXPECT_GT(misfit(turned, rest, x), best);
      }
    }
  }
}

/// A flat body, and one that is pressed through itself, have a rotation too, never a mirror.
TEST_F(BodyFrameTest, IsNeverAMirror) {
  const Positions solid = random(30, 0.01);
  Positions flat = solid, mirrored = solid;
  flat.col(2).setZero();
  mirrored.col(2) = -mirrored.col(2);
  const Matrix3 R = random_rotation();
  EXPECT_LT((body_frame(flat, flat * R.transpose()).rotation - R).norm(), 1e-12);
  EXPECT_NEAR(body_frame(solid, mirrored * R.transpose()).rotation.determinant(), 1.0, 1e-14);
  EXPECT_EQ(body_frame(solid.topRows(1), solid.topRows(1)).rotation, Matrix3::Identity());
}

TEST_F(BodyFrameTest, SameRowsGiveTheSameBits) {
  const Positions rest = random(1000, 0.01), x = rest + random(1000, 1e-3);
  const BodyFrame one = body_frame(rest, x), other = body_frame(rest, x);
  EXPECT_EQ(one.rotation, other.rotation);
  EXPECT_EQ(one.places(x), other.places(x));
}

}  // namespace body_frame_test
}  // namespace tacipc
