#include "stages/gel/press/world/gel_frame.h"

#include <gtest/gtest.h>

#include "common/sample/placement.h"
#include "stages/gel/press/energy/tet_energy.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace gel_frame_test {

Matrix4 pose_of(const Vector3& axis, double angle_rad, const Vector3& at) {
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  pose.topRightCorner<3, 1>() = at;
  return pose;
}

TetMesh placed(TetMesh gel, const Matrix4& world_from_gel) {
  gel.positions = transformed(world_from_gel, gel.positions);
  return gel;
}

class GelFrame : public testing::Test {
 protected:
  const TetMesh first_ = block_gel(3, 0.01, 0.002), second_ = block_gel(4, 0.02, 0.003);
  const Matrix4 first_pose_ = pose_of({1, 2, 3}, 0.7, {0.1, 0.2, -0.3}),
                second_pose_ = pose_of({-1, 0, 2}, 2.1, {0.0, -0.1, 0.4});
  const TetMesh both_ = joined({placed(first_, first_pose_), placed(second_, second_pose_)});
  const FrontSurface front_ = make_front_surface(second_);
  const std::vector<RestTet> rest_ = make_rest_tets(second_.positions, second_.tets);
  const SolvedGel gel_{second_, front_, rest_, first_.num_vertices()};
};

TEST_F(GelFrame, JoinedGelsKeepTheirMeshesInTheWorld) {
  ASSERT_EQ(both_.num_vertices(), first_.num_vertices() + second_.num_vertices());
  EXPECT_EQ(both_.tets.rows(), first_.tets.rows() + second_.tets.rows());
  EXPECT_EQ(both_.tets.row(first_.tets.rows()).minCoeff(),
            second_.tets.row(0).minCoeff() + static_cast<int>(first_.num_vertices()));
  EXPECT_EQ(both_.vertices(BoundaryTag::glued).size(),
            first_.vertices(BoundaryTag::glued).size() + second_.vertices(BoundaryTag::glued).size());
  // Orientations hold: every tetrahedron has a positive volume.
  EXPECT_NO_THROW(make_rest_tets(both_.positions, both_.tets));
  EXPECT_LT((positions_in_gel(gel_, second_pose_, both_.positions) - second_.positions).cwiseAbs().maxCoeff(), 1e-15);
}

/// Its own frame tells what the world has, turned: forces of its own rows only, torque about the origin of S.
TEST_F(GelFrame, ForcesAreThoseOfItsOwnRowsInItsAxes) {
  const Eigen::Index n = both_.num_vertices();
  StepForces forces{.normal = Positions::Constant(n, 3, 7.0),
                    .friction = Positions::Zero(n, 3),
                    .mount = Positions::Zero(n, 3),
                    .body = Positions::Zero(n, 3),
                    .contact_state = std::vector<ContactState>(static_cast<std::size_t>(n), ContactState::none)};
  forces.normal.bottomRows(second_.num_vertices()).setZero();
  const int touched = front_.vertices[5];
  const Eigen::Index row = first_.num_vertices() + touched;
  const Matrix3 R = second_pose_.topLeftCorner<3, 3>();
  const Vector3 normal(0.1, -0.2, -2.0), friction(0.3, 0.1, 0.0);  // in S
  forces.normal.row(row) = (R * normal).transpose();
  forces.friction.row(row) = (R * friction).transpose();
  forces.mount.row(first_.num_vertices()) = -(R * (normal + friction)).transpose();
  forces.contact_state[static_cast<std::size_t>(row)] = ContactState::slip;
  EXPECT_LT((contact_force_on(gel_, forces) - R * (normal + friction)).norm(), 1e-15);

  Frame frame = gel_frame(gel_, second_pose_, positions_in_gel(gel_, second_pose_, both_.positions), forces);
  EXPECT_LT((frame.force_n - normal - friction).norm(), 1e-14);
  const Vector3 arm = second_.positions.row(touched);
  EXPECT_LT((frame.torque_n_m - arm.cross(normal + friction)).norm(), 1e-15);
  EXPECT_LT((Vector3(frame.normal_force_n.row(5)) - normal).norm(), 1e-14);
  EXPECT_LT((Vector3(frame.friction_force_n.row(5)) - friction).norm(), 1e-14);
  EXPECT_EQ(frame.normal_force_n.rows(), static_cast<Eigen::Index>(front_.vertices.size()));
  EXPECT_EQ(frame.contact_state[5], ContactState::slip);
  EXPECT_EQ(frame.contact_state[4], ContactState::none);
  EXPECT_LT(frame.balance.force_n, 1e-14);
  EXPECT_NEAR(frame.min_volume_ratio, 1.0, 1e-12);
  EXPECT_EQ(frame.inverted_tets, 0);

  const Matrix4 object = pose_of({0, 1, 1}, 0.3, {0.01, 0.02, 0.03});
  add_object(frame, second_pose_, object, R * Vector3(1, 2, 3), R * Vector3(4, 5, 6));
  EXPECT_LT((second_pose_ * frame.gel_from_object - object).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((frame.object_velocity_m_s - Vector3(1, 2, 3)).norm(), 1e-14);
  EXPECT_LT((frame.object_spin_rad_s - Vector3(4, 5, 6)).norm(), 1e-14);
}

}  // namespace gel_frame_test
}  // namespace tacipc
