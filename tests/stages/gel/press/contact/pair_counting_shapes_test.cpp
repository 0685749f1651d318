// Rigid bodies touch as their shapes do: flat faces push straight, and the same wherever their triangles meet.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "common/sample/placement.h"
#include "stages/gel/press/contact/pair_counting.h"
#include "stages/gel/press/contact/surface_pairs.h"
#include "stages/gel/press/energy/barrier.h"
#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/solve/assembly.h"
#include "tests/stages/gel/press/cut_box.h"

namespace tacipc {
namespace pair_counting_shapes_test {

constexpr double kDHat = 8e-6, kGap = 4e-6;
constexpr std::array kCuts{Cut::diagonal, Cut::other_diagonal, Cut::fan, Cut::grid};

/// Energy of contact, and what the lower of two bodies does to the upper one, about the middle of its lower face.
struct Contact {
  double energy = 0.0;
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
};

/// The upper body with its lower face kGap above the upper face of the other one.
Contact contact(const TriangleMesh& lower, const TriangleMesh& upper, const Eigen::Vector2d& shift_m,
                double turn_rad = 0.0) {
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(turn_rad, Vector3::UnitZ()).toRotationMatrix();
  const double top_m = lower.positions.col(2).maxCoeff(), bottom_m = upper.positions.col(2).minCoeff();
  pose.topRightCorner<3, 1>() << shift_m, top_m - bottom_m + kGap;
  const TriangleMesh placed{transformed(pose, upper.positions), upper.triangles};
  const ContactMesh mesh = make_contact_mesh(Positions(0, 3), Triangles(0, 3), {lower, placed});
  const ContactLaws laws({.d_hat_m = kDHat});
  const Positions& x = mesh.rest_positions;
  std::vector<ContactPair> pairs;
  pairs_between(mesh.objects[0].surface, mesh.objects[1].surface, x, Positions::Zero(x.rows(), 3), kDHat, pairs);
  const ContactBarrier term(mesh, weighted(pairs, mesh, laws, {.once = true}), laws);
  const Positions push = -gradient_of(term, x);
  Contact found{.energy = term.value(x)};
  const Vector3 middle(shift_m.x(), shift_m.y(), top_m + kGap);
  for (Eigen::Index v = mesh.objects[1].first_vertex; v < x.rows(); ++v) {
    const Vector3 force = push.row(v), arm = Vector3(x.row(v)) - middle;
    found.force += force;
    found.torque += arm.cross(force);
  }
  return found;
}

/// Of the upper body's vertices as one: the stiffness along x, y and z in a Newton step. \param blend as
/// ContactBarrier::evaluate_blended has it
Matrix3 stiffness(const TriangleMesh& lower, const TriangleMesh& upper, double aside_m, double blend) {
  const double up_m = lower.positions.col(2).maxCoeff() - upper.positions.col(2).minCoeff() + kGap;
  const TriangleMesh placed{upper.positions.rowwise() + Eigen::RowVector3d(aside_m, 0.0, up_m), upper.triangles};
  const ContactMesh mesh = make_contact_mesh(Positions(0, 3), Triangles(0, 3), {lower, placed});
  const ContactLaws laws({.d_hat_m = kDHat});
  const Positions& x = mesh.rest_positions;
  std::vector<ContactPair> pairs;
  pairs_between(mesh.objects[0].surface, mesh.objects[1].surface, x, Positions::Zero(x.rows(), 3), kDHat, pairs);
  const ContactBarrier term(mesh, weighted(pairs, mesh, laws, {.once = true}), laws);
  Matrix3 sum = Matrix3::Zero();
  for (int i = 0; i < term.num_stencils(); ++i) {
    const ContactPair& pair = term.pairs()[static_cast<std::size_t>(i)];
    PairLocal local;
    if (!term.evaluate_blended(i, gather(x, pair), blend, kAllPairVertices, local)) continue;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        if (mesh.objects[1].has(pair.vertices[a]) && mesh.objects[1].has(pair.vertices[b]))
          sum += local.hessian.block<3, 3>(3 * a, 3 * b);
      }
    }
  }
  return sum;
}

double one_place() { return barrier(kGap * kGap, kDHat * kDHat); }
double one_push() { return -2.0 * kGap * barrier_d1(kGap * kGap, kDHat * kDHat); }

TEST(PairCountingShapes, ATablePushesPlatesAndBoxesStraightUpWhereverTheyStand) {
  const Vector3 table(30e-3, 30e-3, 5e-3);
  // Corners on the table's diagonals, and beside them by less and more than d̂; rims over vertices of its grid.
  for (const double beside : {0.0, 1e-12, 1e-9, -1e-6, 3e-6, 7e-6, 3e-4}) {
    for (const Cut of_table : kCuts) {
      for (const Cut of_plate : kCuts) {
        for (const Vector3& half : {Vector3(10e-3, 10e-3, 1e-3), Vector3(7.5e-3, 7.5e-3, 5e-3)}) {
          for (const double turn_rad : {0.0, 0.25 * M_PI, 0.3}) {
            const Contact found =
                contact(cut_box(table, of_table), cut_box(half, of_plate), {beside, 0.5 * beside}, turn_rad);
            EXPECT_NEAR(found.energy, 4.0 * one_place(), 1e-9 * one_place());
            EXPECT_NEAR(found.force.z(), 4.0 * one_push(), 1e-9 * one_push());
            EXPECT_LT(found.force.head<2>().norm(), 1e-9 * one_push())
                << beside << " " << static_cast<int>(of_table) << static_cast<int>(of_plate) << " " << turn_rad;
            EXPECT_LT(found.torque.norm(), 1e-9 * one_push() * half.x());
          }
        }
      }
    }
  }
}

/// Nor does a face resist where its triangles meet, whatever share of an approximated Hessian a Newton step takes: else
/// rounding errors grow from iteration to iteration.
TEST(PairCountingShapes, NothingIsStiffAlongAFlatFace) {
  const Vector3 table(30e-3, 30e-3, 5e-3), plate(10e-3, 10e-3, 1e-3);
  for (const Cut of_table : kCuts) {
    for (const double aside : {0.0, 1e-17, 1e-13, 1e-9, 1e-6}) {
      for (const double blend : {0.0, 0.25, 1.0}) {
        const Matrix3 found = stiffness(cut_box(table, of_table), cut_box(plate, Cut::fan), aside, blend);
        EXPECT_GT(found(2, 2), 0.0);
        Matrix3 along = found;
        along(2, 2) = 0.0;
        EXPECT_LT(along.norm(), 1e-9 * found(2, 2)) << static_cast<int>(of_table) << " " << aside << " " << blend;
      }
    }
  }
}

TEST(PairCountingShapes, RimsThatCrossPushStraightWhereverTheirTrianglesMeet) {
  // Half of the upper box sticks out: two of its corners and two crossings carry it.
  const Vector3 half(5e-3, 4e-3, 3e-3), narrow(3e-3, 2e-3, 1e-3);
  for (const double aside : {0.0, 1e-12, -1e-6, 3e-6, 2e-4}) {
    for (const Cut of_lower : kCuts) {
      for (const Cut of_upper : kCuts) {
        const Contact found = contact(cut_box(half, of_lower), cut_box(narrow, of_upper), {half.x() + aside, aside});
        EXPECT_NEAR(found.energy, 4.0 * one_place(), 1e-9 * one_place()) << aside;
        EXPECT_LT(found.force.head<2>().norm(), 1e-9 * one_push()) << aside;
        EXPECT_NEAR(found.force.z(), 4.0 * one_push(), 1e-9 * one_push()) << aside;
      }
    }
  }
}

TEST(PairCountingShapes, SharpBodiesStillKeepEachOtherApart) {
  // Crossed ridges and a tip on a face: each alone carries what one place does.
  const TriangleMesh roof =
      make_mesh({{0, -5e-3, 0},
                 {0, 5e-3, 0},
                 {3e-3, -5e-3, -3e-3},
                 {3e-3, 5e-3, -3e-3},
                 {-3e-3, -5e-3, -3e-3},
                 {-3e-3, 5e-3, -3e-3}},
                {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}});
  TriangleMesh across = roof;
  across.positions.col(0) = roof.positions.col(1);
  across.positions.col(1) = roof.positions.col(0);
  across.positions.col(2) = -roof.positions.col(2);
  const TriangleMesh tip = make_mesh({{0, 0, 0}, {1e-3, 0, 2e-3}, {-1e-3, 1e-3, 2e-3}, {-1e-3, -1e-3, 2e-3}},
                                     {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
  ASSERT_GT(signed_volume(roof), 0.0);
  ASSERT_GT(signed_volume(across), 0.0);
  ASSERT_GT(signed_volume(tip), 0.0);
  const Contact ridges = contact(roof, across, {0.4e-3, 0.7e-3}),
                face = contact(cut_box({5e-3, 5e-3, 1e-3}, Cut::grid), tip, {0.1e-3, 0.2e-3}),
                ridge = contact(roof, tip, {0.0, 0.7e-3});
  EXPECT_GE(ridge.energy, one_place());  // the tip, and its creases where they end
  for (const Contact& found : {ridges, face}) {
    EXPECT_NEAR(found.energy, one_place(), 1e-9 * one_place());
    EXPECT_NEAR(found.force.z(), one_push(), 1e-9 * one_push());
  }
}

}  // namespace pair_counting_shapes_test
}  // namespace tacipc
