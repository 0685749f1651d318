// Collision detection against closed forms, impacts built to be exact, and exact integer truth.
#include "stages/gel/press/contact/ccd.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "tests/stages/gel/press/contact/impacts.h"
#include "tests/stages/gel/press/contact/precise_separation.h"

namespace tacipc {
namespace ccd_test {

struct Kind {
  ContactPair::Kind kind;
  ClosestFeature (*closest)(const FourPoints&);

  double time_of_impact(const FourPoints& x, const FourPoints& displacement, double slack = 0.1) const {
    return tacipc::time_of_impact(kind, x, displacement, slack);
  }
  const char* name() const { return kind == ContactPair::Kind::point_triangle ? "point_triangle" : "edge_edge"; }
  friend void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name(); }
};
const Kind kPointTriangle{ContactPair::Kind::point_triangle, closest_point_triangle};
const Kind kEdgeEdge{ContactPair::Kind::edge_edge, closest_edge_edge};

class Ccd : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Pairs, Ccd, testing::Values(kPointTriangle, kEdgeEdge),
                         [](const auto& test) { return test.param.name(); });

const Vector3 kDown(0, 0, -1);

TEST(CcdClosedForm, FallingPointStopsAtTheSlack) {
  const FourPoints x{Vector3(0.2, 0.3, 1), Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  FourPoints d{2 * kDown, Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  // Height 1 − 2t reaches slack × 1 at t = (1 − slack) / 2.
  for (const double slack : {0.0, 0.1, 0.5, 0.9}) {
    const double t = kPointTriangle.time_of_impact(x, d, slack);
    EXPECT_LE(t, (1 - slack) / 2);
    EXPECT_GE(t, (1 - slack) / 2 - 0.01 * slack / 2 - 1e-14) << slack;
  }
  d[0] = 0.89 * kDown;
  EXPECT_EQ(kPointTriangle.time_of_impact(x, d), 1);
}

TEST(CcdClosedForm, CrossingEdgesStopAtTheSlack) {
  const FourPoints x{Vector3(-1, 0, 1), Vector3(1, 0, 1), Vector3(0, -1, 0), Vector3(0, 1, 0)};
  const FourPoints d{kDown, kDown, -kDown, -kDown};
  const double t = kEdgeEdge.time_of_impact(x, d);
  EXPECT_LE(t, 0.45);
  EXPECT_GE(t, 0.449);
}

TEST(CcdClosedForm, ParallelEdgesMayTouchAllAlong) {
  const FourPoints x{Vector3(-1, 0, 1), Vector3(1, 0, 1), Vector3(-1, 0, 0), Vector3(1, 0, 0)};
  const FourPoints d{2 * kDown, 2 * kDown, Vector3::Zero(), Vector3::Zero()};
  EXPECT_NEAR(kEdgeEdge.time_of_impact(x, d), 0.45, 1e-3);
}

TEST(CcdClosedForm, SlidingAtATinyGapIsFree) {
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Vector3 slide(5, -3, 0);
    const FourPoints parallel{Vector3(-1, 0, gap), Vector3(1, 0, gap), Vector3(-1, 0, 0), Vector3(1, 0, 0)};
    EXPECT_EQ(kEdgeEdge.time_of_impact(parallel, {slide, slide, -slide, Vector3::Zero()}), 1) << gap;
    const FourPoints over{Vector3(0.1, 0.1, gap), Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
    EXPECT_EQ(kPointTriangle.time_of_impact(over, {slide, Vector3::Zero(), -slide, slide}), 1) << gap;
  }
}

TEST(CcdClosedForm, RollingTogetherAtATinyGapIsFree) {
  // Nothing but the gap keeps them apart, and each vertex moves by about 1.
  const Matrix3 turn = Eigen::AngleAxisd(0.8, Vector3(1, 2, 0.5).normalized()).toRotationMatrix();
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    const FourPoints over{Vector3(0.3, 0.3, gap), Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
    const FourPoints across{Vector3(-1, 0, gap), Vector3(1, 0, gap), Vector3(0.2, -1, 0), Vector3(0.1, 1, 0)};
    FourPoints over_end, across_end;
    for (int i = 0; i < 4; ++i) {
      over_end[i] = turn * over[i];
      across_end[i] = turn * across[i];
    }
    EXPECT_EQ(kPointTriangle.time_of_impact(over, over_end - over), 1) << gap;
    EXPECT_EQ(kEdgeEdge.time_of_impact(across, across_end - across), 1) << gap;
  }
}

TEST_P(Ccd, StartInContactCannotMove) {
  std::mt19937 random(11);
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const FourPoints x = lattice_points(random, 1);
    if (GetParam().closest(x).squared_distance > 1e-28) continue;
    ++touching;
    EXPECT_EQ(GetParam().time_of_impact(x, lattice_points(random, 3)), 0) << to_string(x);
  }
  EXPECT_GT(touching, 50);
}

TEST_P(Ccd, CommonMotionAndNoMotionAreFree) {
  std::mt19937 random(12);
  for (int i = 0; i < 500; ++i) {
    const FourPoints x = random_points(random);
    const Vector3 v = 1e3 * random_vector(random);
    EXPECT_EQ(GetParam().time_of_impact(x, {v, v, v, v}), 1) << to_string(x);
  }
}

TEST_P(Ccd, NumbersThatAreNotFiniteCannotMove) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308}) {
    const FourPoints x{Vector3(bad, 0, 1), Vector3(1, 1, 1), Vector3(2, 0, 0), Vector3(0, 3, 0)};
    const FourPoints d{Vector3(1, 1, 1), Vector3(-bad, 0, 0), Vector3(0, 0, 0), Vector3(1, 0, 0)};
    EXPECT_EQ(GetParam().time_of_impact(x, d), 0) << bad;
  }
}

TEST_P(Ccd, KeepsTheSeparationAndUsesTheRoom) {
  std::mt19937 random(13);
  int stopped = 0, wasteful = 0;
  for (int i = 0; i < 5000; ++i) {
    const double size = i % 2 == 0 ? 1.0 : 1e-3;
    FourPoints x = random_points(random);
    FourPoints d = random_points(random);
    for (int j = 0; j < 4; ++j) {
      x[j] *= size;
      d[j] *= 2 * size;
    }
    const double slack = 0.2;
    const double t = GetParam().time_of_impact(x, d, slack);
    const double separation = slack * std::sqrt(GetParam().closest(x).squared_distance);
    for (int j = 0; j <= 40; ++j) {
      const double distance = std::sqrt(GetParam().closest(x + t * j / 40 * d).squared_distance);
      ASSERT_GE(distance, separation * (1 - 1e-12)) << to_string(x) << " moving by " << to_string(d);
    }
    if (t == 1) continue;
    ++stopped;
    wasteful += std::sqrt(GetParam().closest(x + t * d).squared_distance) > 1.02 * separation;
  }
  std::printf("  %d of 5000 stopped, %d of them with room left\n", stopped, wasteful);
  EXPECT_GT(stopped, 200);
  EXPECT_EQ(wasteful, 0);
}

TEST_P(Ccd, FindsImpactsThatAreKnownByConstruction) {
  std::mt19937 random(14);
  constexpr int kImpacts = 2000;
  int missed = 0;
  for (int i = 0; i < kImpacts; ++i) {
    const Impact impact = random_impact(GetParam().kind, kMeetings[i % 4], random);
    const double t = GetParam().time_of_impact(impact.start, impact.displacement, 0);
    EXPECT_TRUE(t == 0 || t < impact.time)
        << "impact at " << impact.time << ": " << to_string(impact.start) << " by " << to_string(impact.displacement);
    missed += !may_collide(GetParam().kind, impact.start, impact.start + impact.displacement);
  }
  std::printf("  %d impacts, %d missed\n", kImpacts, missed);
  EXPECT_EQ(missed, 0);
}

TEST_P(Ccd, AgreesWithExactTruthOnTenThousandRandomQueries) {
  std::mt19937 random(15);
  int hits = 0, undecided = 0, false_negatives = 0, false_positives = 0;
  for (int i = 0; i < 10000; ++i) {
    const int size = i % 2 == 0 ? 1000 : 6;  // the small lattice is full of touching and coplanar pairs
    const FourPoints start = lattice_points(random, size);
    const FourPoints end = lattice_points(random, size);
    const Collision truth = exact_collision(GetParam().kind, start, end - start);
    const bool reported = may_collide(GetParam().kind, start, end);
    hits += truth == Collision::hit;
    undecided += truth == Collision::undecided;
    false_negatives += truth == Collision::hit && !reported;
    false_positives += truth == Collision::free && reported;
  }
  const int free = 10000 - hits - undecided;
  std::printf(
      "  10000 queries: %d hits, %d free, %d undecided; false negatives %d, false positives %d (always-hit: %d)\n",
      hits, free, undecided, false_negatives, false_positives, free);
  EXPECT_GT(hits, 500);
  EXPECT_GT(free, 2000);
  EXPECT_EQ(false_negatives, 0);
  EXPECT_LT(false_positives, free / 100);
}

}  // namespace ccd_test
}  // namespace tacipc
