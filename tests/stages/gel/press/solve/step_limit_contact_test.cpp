// The largest step over many pairs against that of each pair alone.
#include "stages/gel/press/solve/step_limit.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "stages/gel/press/contact/ccd.h"
#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {
namespace step_limit_contact_test {

/// Far more pairs than one round of chunks takes, of both kinds, with displacements as long as the pairs are large.
struct MovingPairs {
  Positions x, p;
  std::vector<ContactPair> pairs;

  explicit MovingPairs(int count, double speed) : x(4 * count, 3), p(4 * count, 3) {
    std::mt19937 random(7);
    for (int i = 0; i < count; ++i) {
      const FourPoints points = random_points(random), displacements = random_points(random);
      for (int k = 0; k < 4; ++k) {
        x.row(4 * i + k) = points[k].transpose();
        p.row(4 * i + k) = speed * displacements[k].transpose();
      }
      pairs.push_back({i % 2 == 0 ? ContactPair::Kind::point_triangle : ContactPair::Kind::edge_edge,
                       {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}});
    }
  }
  /// How far one pair alone lets it go.
  double limit_of(const ContactPair& pair, double slack) const {
    return time_of_impact(pair.kind, gather(x, pair), gather(p, pair), slack);
  }
};

double distance(const ContactPair& pair, const Positions& x) {
  return std::sqrt(closest_feature(pair, gather(x, pair)).squared_distance);
}

TEST(ContactStepLimit, IsThatOfTheNearestOfManyPairsWhereverItStands) {
  MovingPairs many(30000, 0.03);
  const GapRule rule{.slack = 0.1};
  std::vector<double> alone;
  for (const ContactPair& pair : many.pairs) alone.push_back(many.limit_of(pair, rule.slack));
  const auto nearest = std::min_element(alone.begin(), alone.end()) - alone.begin();
  ASSERT_LT(alone[nearest], 0.5);
  ASSERT_GT(std::count_if(alone.begin(), alone.end(), [](double t) { return t < 1.0; }), 100);
  for (const std::size_t at : {std::size_t{0}, many.pairs.size() / 2, many.pairs.size() - 1}) {
    std::vector<ContactPair> pairs = many.pairs;
    std::swap(pairs[static_cast<std::size_t>(nearest)], pairs[at]);
    const double limit = contact_step_limit(pairs, many.x, many.p, rule);
    EXPECT_NEAR(limit, alone[nearest], 0.02 * alone[nearest]) << at;
    const Positions after = many.x + limit * many.p;
    for (const ContactPair& pair : pairs) ASSERT_GT(distance(pair, after), rule.slack * distance(pair, many.x));
  }
}

TEST(LimitingPairs, AreThoseThatAllowLessThanAllInOrder) {
  const MovingPairs many(3000, 0.03);
  for (const double slack : {0.1, 0.3}) {
    std::vector<std::array<int, 4>> expected;
    for (const ContactPair& pair : many.pairs) {
      if (many.limit_of(pair, slack) < 1.0) expected.push_back(pair.vertices);
    }
    ASSERT_GT(expected.size(), 10u);
    std::vector<std::array<int, 4>> found;
    for (const ContactPair& pair : limiting_pairs(many.pairs, many.x, many.p, {.slack = slack}))
      found.push_back(pair.vertices);
    EXPECT_EQ(found, expected);
  }
}

TEST(ContactStepLimit, DoesNotDependOnThreads) {
  const MovingPairs many(30000, 0.03);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return contact_step_limit(many.pairs, many.x, many.p, {.slack = 0.1});
  };
  EXPECT_EQ(with(1), with(2));
}

TEST(ContactStepLimit, IsOneWhereNothingComesNear) {
  const MovingPairs many(30000, 0.0);
  EXPECT_EQ(contact_step_limit(many.pairs, many.x, many.p, {}), 1.0);
}

TEST(ContactStepLimit, LeavesTheFloor) {
  const Positions x{{0.2, 0.2, 1.0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Positions p = Positions::Zero(4, 3);
  p(0, 2) = -2.0;
  const std::vector<ContactPair> pairs{{ContactPair::Kind::point_triangle, {0, 1, 2, 3}}};
  // Down to floor + slack (1 − floor) = 0.28 from 1 at a speed of 2.
  const double limit = contact_step_limit(pairs, x, p, {.slack = 0.1, .floor_m = 0.2});
  EXPECT_LE(limit, 0.36);
  EXPECT_GT(limit, 0.9 * 0.36);
}

TEST(ContactStepLimit, AWideGapMayBecomeAsNarrowAsANearOne) {
  const ContactPair pair{ContactPair::Kind::point_triangle, {0, 1, 2, 3}};
  for (const double distance : {0.05, 0.1, 1.0, 50.0}) {
    const Positions x{{0.2, 0.2, distance}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    Positions p = Positions::Zero(4, 3);
    p(0, 2) = -2.0 * distance;
    const GapRule rule{.slack = 0.3, .floor_m = 0.01, .near_m = 0.1};
    const double left = 0.01 + 0.3 * (std::min(distance, 0.1) - 0.01), expected = (distance - left) / (2.0 * distance);
    const double limit = contact_step_limit({pair}, x, p, rule);
    EXPECT_LE(limit, expected);
    EXPECT_GT(limit, 0.9 * expected) << distance;
    EXPECT_EQ(contact_step_limit({pair}, x, 0.98 * expected * p, rule), 1.0);
    EXPECT_LT(contact_step_limit({pair}, x, 1.02 * expected * p, rule), 1.0);
  }
}

}  // namespace step_limit_contact_test
}  // namespace tacipc
