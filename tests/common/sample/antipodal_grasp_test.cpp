#include "common/sample/antipodal_grasp.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

#include "common/base/error.h"
#include "common/mesh/mass_properties.h"
#include "common/mesh/triangle_tree.h"
#include "tests/config_text.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace antipodal_grasp_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kFriction = 0.5;

GelShape front_of(double width_m, double height_m) {
  return {.outline = GelShape::Outline::rectangle, .width_m = width_m, .height_m = height_m, .thickness_m = 2e-3};
}
const GelShape kFront = front_of(0.012, 0.008);

/// A solid of revolution about z through points (radius, z) from below, whose ends lie on the axis.
TriangleMesh turned(const std::vector<Eigen::Vector2d>& profile, int sides) {
  std::vector<Vector3> vertices{{0, 0, profile.front().y()}};
  std::vector<std::array<int, 3>> faces;
  const int rings = static_cast<int>(profile.size()) - 2;
  for (int r = 1; r <= rings; ++r) {
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      vertices.emplace_back(profile[r].x() * std::cos(angle), profile[r].x() * std::sin(angle), profile[r].y());
    }
  }
  vertices.emplace_back(0, 0, profile.back().y());
  const int top = static_cast<int>(vertices.size()) - 1;
  for (int k = 0; k < sides; ++k) {
    const int a = 1 + k, b = 1 + (k + 1) % sides;
    faces.push_back({0, b, a});
    for (int r = 0; r + 1 < rings; ++r) {
      const int low = r * sides, high = low + sides;
      faces.push_back({low + a, low + b, high + b});
      faces.push_back({low + a, high + b, high + a});
    }
    faces.push_back({top, (rings - 1) * sides + a, (rings - 1) * sides + b});
  }
  return make_mesh(vertices, faces);
}

TriangleMesh ball(double radius_m) {
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k <= 32; ++k) {
    const double angle = std::numbers::pi * k / 32;
    profile.emplace_back(radius_m * std::sin(angle), -radius_m * std::cos(angle));
  }
  return turned(profile, 64);
}
TriangleMesh cylinder(double radius_m, double height_m) {
  return turned({{0, 0}, {radius_m, 0}, {radius_m, height_m}, {0, height_m}}, 64);
}
/// Its side slopes by 45°.
TriangleMesh steep_cone(double radius_m) { return turned({{0, 0}, {radius_m, 0}, {0, radius_m}}, 64); }

TriangleMesh l_shape() {
  TriangleMesh mesh = make_l_shape();
  mesh.positions *= 0.01;
  return mesh;
}

Vector3 center_of(const TriangleMesh& mesh) { return mass_properties(mesh.positions, mesh.triangles).center_m; }

/// Faces that hold a point, whose normals differ from a direction by at most an angle.
bool lies_on_facing(const TriangleMesh& mesh, const Vector3& point, const Vector3& direction, double angle_rad) {
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const Vector3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                  c = mesh.positions.row(mesh.triangles(f, 2));
    if (squared_distance_to_triangle(point, a, b, c) > 1e-18) continue;
    if (std::acos(std::min(1.0, (b - a).cross(c - a).normalized().dot(direction))) <= angle_rad + 1e-6) return true;
  }
  return false;
}

/// That a grasp is what it is said to be: antipodal in the cone, in the limits, and with nothing before the fronts, by
/// points all over the surface.
void expect_possible(const TriangleMesh& mesh, const GraspPose& pose, const GelShape& front, const GraspDraw& draw) {
  const Vector3 line = pose.world_from_object.row(0), grip = center_of(mesh) + pose.grip_m;
  const double half = 0.5 * pose.width_m.value();
  EXPECT_NEAR(pose.world_from_object.determinant(), 1.0, 1e-12);
  EXPECT_LT((pose.world_from_object * pose.world_from_object.transpose() - Matrix3::Identity()).norm(), 1e-12);
  EXPECT_GE(2.0 * half, draw.least_width_m);
  EXPECT_LE(2.0 * half, draw.most_width_m);
  EXPECT_TRUE(lies_on_facing(mesh, grip - half * line, -line, std::atan(kFriction)));
  EXPECT_TRUE(lies_on_facing(mesh, grip + half * line, line, std::atan(kFriction)));
  EXPECT_NEAR(pose.lever_m(), pose.grip_m.cross(line).norm(), 1e-12);
  constexpr int kGrid = 40;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    for (int i = 0; i <= kGrid; ++i) {
      for (int j = 0; i + j <= kGrid; ++j) {
        const Vector3 weights = Vector3(i, j, kGrid - i - j) / kGrid;
        Vector3 at = -grip;
        for (int k = 0; k < 3; ++k) at += weights[k] * mesh.positions.row(mesh.triangles(f, k)).transpose();
        at = pose.world_from_object * at;
        if (std::abs(at.y()) < 0.5 * front.width_m && std::abs(at.z()) < 0.5 * front.height_m) {
          ASSERT_LT(std::abs(at.x()), half + draw.depth_m + 1e-9);
        }
      }
    }
  }
}

/// Directions (rounded to the axes of the object) along which an object is gripped, over many seeds.
std::set<int> axes_of_grasps(const TriangleMesh& mesh, const GelShape& front, int seeds) {
  std::set<int> axes;
  for (int seed = 0; seed < seeds; ++seed) {
    const GraspDraw draw{.seed = static_cast<std::uint64_t>(seed)};
    const GraspPose pose = draw_grasp(mesh, center_of(mesh), front, kFriction, draw);
    expect_possible(mesh, pose, front, draw);
    const Vector3 line = pose.world_from_object.row(0);
    Eigen::Index axis = 0;
    EXPECT_NEAR(line.cwiseAbs().maxCoeff(&axis), 1.0, 1e-9);
    axes.insert(line[axis] > 0 ? static_cast<int>(axis) + 1 : -static_cast<int>(axis) - 1);
  }
  return axes;
}

std::string refusal(const TriangleMesh& mesh, const GraspDraw& draw, double friction = kFriction) {
  try {
    draw_grasp(mesh, center_of(mesh), kFront, friction, draw);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(AntipodalGrasp, ABoxIsGrippedByAllItsFaces) {
  EXPECT_EQ(axes_of_grasps(make_box({0, 0, 0}, {0.02, 0.03, 0.04}), kFront, 60), (std::set{-3, -2, -1, 1, 2, 3}));
}

TEST(AntipodalGrasp, AnLIsGrippedByAllItsFacesWhereItsOtherLegIsNotInTheWay) {
  EXPECT_EQ(axes_of_grasps(l_shape(), kFront, 200), (std::set{-3, -2, -1, 1, 2, 3}));
  // A front wider than what is left beside the other leg grips the legs across their ends and flat sides alone.
  std::set<double> narrow, wide;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto width = [&](const GelShape& front) {
      const GraspPose pose = draw_grasp(l_shape(), center_of(l_shape()), front, kFriction, {.seed = seed});
      return std::abs(pose.world_from_object(0, 2)) > 0.5 ? 0.0 : std::round(1e3 * *pose.width_m);
    };
    narrow.insert(width(kFront)), wide.insert(width(front_of(0.05, 0.05)));
  }
  EXPECT_EQ(narrow, (std::set{0.0, 10.0, 20.0, 30.0}));
  EXPECT_EQ(wide, (std::set{0.0, 20.0, 30.0}));
}

TEST(AntipodalGrasp, ABallIsGrippedThroughItsMiddleWithinItsFacets) {
  const TriangleMesh mesh = ball(0.015);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const GraspDraw draw{.seed = seed};
    const GraspPose pose = draw_grasp(mesh, center_of(mesh), kFront, kFriction, draw);
    expect_possible(mesh, pose, kFront, draw);
    EXPECT_NEAR(*pose.width_m, 0.03, 2e-4);
    EXPECT_LT(pose.lever_m(), 1.6e-3);  // a facet is 1.5 mm long
  }
}

TEST(AntipodalGrasp, ACylinderIsGrippedAcrossItsSideAndItsEnds) {
  const TriangleMesh mesh = cylinder(0.012, 0.03);
  int across = 0, along = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const GraspDraw draw{.seed = seed};
    const GraspPose pose = draw_grasp(mesh, center_of(mesh), kFront, kFriction, draw);
    expect_possible(mesh, pose, kFront, draw);
    ++(std::abs(pose.world_from_object(0, 2)) > 0.5 ? along : across);
  }
  EXPECT_GT(across, 5);
  EXPECT_GT(along, 1);
}

TEST(AntipodalGrasp, TheBestOfManyHasTheSmallestLever) {
  const TriangleMesh mesh = make_box({0, 0, 0}, {0.08, 0.02, 0.02});
  double least = 1.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    least = std::min(least, draw_grasp(mesh, center_of(mesh), kFront, kFriction, {.seed = seed}).lever_m());
  const GraspPose best = draw_grasp(mesh, center_of(mesh), kFront, kFriction, {.seed = 1, .best_of = 200});
  EXPECT_LT(best.lever_m(), 2e-3);
  EXPECT_LT(best.lever_m(), least);
}

TEST(AntipodalGrasp, AnUprightObjectLooksUpAsFarAsTheGraspLetsIt) {
  const TriangleMesh mesh = make_box({0, 0, 0}, {0.02, 0.02, 0.02});
  std::set<bool> turned_about;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const GraspPose stands = draw_grasp(mesh, center_of(mesh), kFront, kFriction, {.seed = seed, .upright = true});
    const GraspPose turned = draw_grasp(mesh, center_of(mesh), kFront, kFriction, {.seed = seed});
    if (std::abs(stands.world_from_object(0, 2)) > 0.5) continue;
    EXPECT_NEAR(stands.world_from_object(2, 2), 1.0, 1e-9);
    turned_about.insert(turned.world_from_object(2, 2) < 0.0);
  }
  EXPECT_EQ(turned_about, (std::set{false, true}));
}

TEST(AntipodalGrasp, ASeedIsAGrasp) {
  const auto draw = [](std::uint64_t seed) {
    return draw_grasp(l_shape(), center_of(l_shape()), kFront, kFriction, {.seed = seed}).grip_m;
  };
  EXPECT_EQ(draw(3), draw(3));
  EXPECT_NE(draw(3), draw(4));
}

TEST(AntipodalGrasp, ADomeOrDiscIsAsWideAsItsOutline) {
  const GelShape disc{.outline = GelShape::Outline::disc, .radius_m = 0.004, .thickness_m = 2e-3};
  EXPECT_EQ(axes_of_grasps(l_shape(), disc, 200), (std::set{-3, -2, -1, 1, 2, 3}));
}

TEST(AntipodalGrasp, WhatCannotBeGrippedSaysWhy) {
  EXPECT_THAT(refusal(make_box({0, 0, 0}, {0.09, 0.1, 0.11}), {}), HasSubstr("4000 wider than 80 mm"));
  EXPECT_THAT(refusal(make_box({0, 0, 0}, {0.09, 0.1, 0.001}), {.least_width_m = 2e-3}),
              AllOf(HasSubstr("wider than 80 mm"), HasSubstr("narrower than 2 mm")));
  const GraspDraw yielding{.patch_m = 0.0, .depth_m = 0.02};
  EXPECT_THAT(refusal(steep_cone(0.02), yielding),
              HasSubstr("with the other side's normal outside the friction cone of 26.6°"));
  EXPECT_EQ(refusal(steep_cone(0.02), yielding, 1.2), "");
}

TEST(AntipodalGrasp, TakesANarrowerPatchWhereNoPlaceHasTheOneAskedFor) {
  const auto patch_of = [](const TriangleMesh& object) {
    return draw_grasp(object, Vector3::Zero(), kFront, kFriction, {}).patch_m.value();
  };
  EXPECT_EQ(patch_of(make_box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01})), 5e-3);
  EXPECT_EQ(patch_of(ball(0.004)), 2.5e-3);  // 0.5 mm below its top it is 4 mm wide
  EXPECT_EQ(patch_of(ball(0.0005)), 0.625e-3);
}

TEST(AntipodalGrasp, LimitsOfTheHandAreRead) {
  const auto draw = config_from_text<GraspDraw>(
      "seed: 7\nbest_of: 20\nupright: true\nwidth_mm: [5, 60]\npatch_mm: 3\ndepth_mm: 0.2\n", "draw.yaml");
  EXPECT_EQ(draw.seed, 7u);
  EXPECT_EQ(draw.best_of, 20);
  EXPECT_TRUE(draw.upright);
  EXPECT_DOUBLE_EQ(draw.least_width_m, 5e-3);
  EXPECT_DOUBLE_EQ(draw.most_width_m, 60e-3);
  EXPECT_DOUBLE_EQ(draw.patch_m, 3e-3);
  EXPECT_DOUBLE_EQ(draw.depth_m, 0.2e-3);
  EXPECT_THAT(faults_in<GraspDraw>("width_mm: [60, 5]\n", "draw.yaml"),
              Contains(HasSubstr("draw.yaml:1:11: width_mm: a hand opens from the lower to the higher number")));
}

}  // namespace antipodal_grasp_test
}  // namespace tacipc
