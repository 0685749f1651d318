// The first gate of every collision pair, alone and with what follows it in a step, against impacts known by
// construction and exact integer truth.
#include "stages/gel/press/contact/plane_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/base/error.h"
#include "stages/gel/press/solve/step_limit.h"
#include "tests/stages/gel/press/contact/impacts.h"

namespace tacipc {
namespace plane_filter_test {

/// Moving pairs that share no vertex, as the search hands them over.
struct MovingPairs {
  Positions x, p;
  std::vector<ContactPair> pairs;

  void add(ContactPair::Kind kind, const FourPoints& start, const FourPoints& displacement) {
    const int first = static_cast<int>(x.rows());
    x.conservativeResize(first + 4, 3);
    p.conservativeResize(first + 4, 3);
    for (int k = 0; k < 4; ++k) {
      x.row(first + k) = start[k].transpose();
      p.row(first + k) = displacement[k].transpose();
    }
    pairs.push_back({kind, {first, first + 1, first + 2, first + 3}});
  }
  /// Bits of those of the eight pairs `lanes` that the filter shows to stay apart.
  unsigned apart(const std::array<int, kLanes>& lanes, double until, double slack, const Pack& floor_m,
                 const Pack& near_m = Pack{} + std::numeric_limits<double>::infinity()) const {
    std::array<const ContactPair*, kLanes> chosen;
    for (int l = 0; l < kLanes; ++l) chosen[l] = &pairs[lanes[l]];
    return stay_apart(x.data(), p.data(), until, chosen.data(), chosen[0]->kind, slack, floor_m, near_m);
  }
  /// How far a step may go; 0 where a pair touches, so that its distance has no part for slack, or where the solver
  /// refuses any step.
  double limit(const GapRule& rule) const {
    for (const ContactPair& pair : pairs)
      if (closest_feature(pair, gather(x, pair)).squared_distance == 0.0) return 0.0;
    try {
      return contact_step_limit(pairs, x, p, rule);
    } catch (const SolverError&) {
      return 0.0;
    }
  }
};

constexpr std::array<int, kLanes> kAllLanes{0, 1, 2, 3, 4, 5, 6, 7};

/// Where, how fast and how large: metres, micrometres, far from the origin, carried along with great speed.
struct Frame {
  double scale;
  Vector3 offset, velocity;
  const char* name;
};
const Vector3 kNowhere = Vector3::Zero(), kFar(0x1p30, -0x1p29, 0x1p28), kFast(-3000.0, 12345.0, 777.0);
const Frame kFrames[] = {{1.0, kNowhere, kNowhere, "as made"},
                         {0x1p-20, kNowhere, kNowhere, "small"},
                         {1.0, kFar, kNowhere, "far away"},
                         {0x1p20, Vector3(-0x1p12, 1000.0, 0x1p13), kFast, "large and fast"}};

class PlaneFilter : public testing::TestWithParam<ContactPair::Kind> {};
INSTANTIATE_TEST_SUITE_P(Pairs, PlaneFilter,
                         testing::Values(ContactPair::Kind::point_triangle, ContactPair::Kind::edge_edge),
                         [](const auto& test) {
                           return test.param == ContactPair::Kind::point_triangle ? "point_triangle" : "edge_edge";
                         });

TEST_P(PlaneFilter, ClaimsNoImpactInAnyLaneApart) {
  std::mt19937 random(21);
  int impacts = 0, before = 0, apart_before = 0;
  for (const Frame& frame : kFrames) {
    for (const Meeting meeting : kMeetings) {
      for (int pack = 0; pack < 300; ++pack) {
        MovingPairs moving;
        std::array<Impact, kLanes> eight;
        for (Impact& impact : eight) {
          impact = transformed(random_impact(GetParam(), meeting, random), frame.scale, frame.offset, frame.velocity);
          moving.add(GetParam(), impact.start, impact.displacement);
        }
        // Up to the last sixteenth before each impact, and up to each impact itself.
        const double until = random_int(random, 1, 16) / 16.0;
        const unsigned apart = moving.apart(kAllLanes, until, 0.0, Pack{});
        for (int l = 0; l < kLanes; ++l) {
          const bool claimed = apart >> l & 1U;
          const bool hit = eight[l].time <= until;
          impacts += hit;
          before += !hit;
          apart_before += !hit && claimed;
          EXPECT_FALSE(claimed && hit) << frame.name << ", meeting " << static_cast<int>(meeting) << ", lane " << l
                                       << ": " << to_string(eight[l].start) << " by "
                                       << to_string(eight[l].displacement) << " touch at " << eight[l].time;
          if (claimed && !hit) {
            EXPECT_NE(exact_collision(GetParam(), eight[l].start, eight[l].displacement, until), Collision::hit);
          }
        }
      }
    }
  }
  std::printf("  %d impacts, none claimed apart; %d of %d apart until before\n", impacts, apart_before, before);
  EXPECT_GT(impacts, 10000);
}

/// As a step meets it: among pairs that are far apart, in each lane of full and partial packs.
TEST_P(PlaneFilter, NoStepGoesAsFarAsAnImpact) {
  std::mt19937 random(22);
  const ContactPair::Kind other = GetParam() == ContactPair::Kind::point_triangle ? ContactPair::Kind::edge_edge
                                                                                  : ContactPair::Kind::point_triangle;
  int impacts = 0, short_of_half = 0;
  for (const Frame& frame : kFrames) {
    for (const Meeting meeting : kMeetings) {
      for (int i = 0; i < 300; ++i) {
        const Impact impact = random_impact(GetParam(), meeting, random);
        if (impact.time == 0.0) continue;
        MovingPairs moving;
        const auto add = [&](ContactPair::Kind kind, const Impact& what) {
          const Impact seen = transformed(what, frame.scale, frame.offset, frame.velocity);
          moving.add(kind, seen.start, seen.displacement);
        };
        const auto add_bystander = [&](ContactPair::Kind kind) {
          FourPoints apart = lattice_points(random, 64);
          for (int k = 0; k < (kind == ContactPair::Kind::point_triangle ? 1 : 2); ++k) apart[k].z() += 500.0;
          add(kind, {apart, lattice_points(random, 64), 0.0});
        };
        const int lane = i % kLanes, count = lane + 1 + random_int(random, 0, kLanes - 1 - lane);
        for (int k = random_int(random, 0, 3); k > 0; --k) add_bystander(other);
        for (int l = 0; l < count; ++l) {
          if (l == lane) {
            add(GetParam(), impact);
          } else {
            add_bystander(GetParam());
          }
        }
        for (int k = random_int(random, 0, 3); k > 0; --k) add_bystander(other);
        ++impacts;
        const double limit = moving.limit({.slack = 0.0});
        EXPECT_LT(limit, impact.time) << frame.name << ", meeting " << static_cast<int>(meeting) << ", lane " << lane
                                      << " of " << count << ": " << to_string(impact.start) << " by "
                                      << to_string(impact.displacement);
        EXPECT_LT(moving.limit({}), impact.time);
        if (meeting == Meeting::plain) {
          const Impact seen = transformed(impact, frame.scale, frame.offset, frame.velocity);
          EXPECT_NE(exact_collision(GetParam(), seen.start, seen.displacement, limit), Collision::hit)
              << "touches before " << limit;
          // Nor do the places that doubles hold, which far from the origin are some way off the path.
          const FourPoints reached = seen.start + limit * seen.displacement;
          EXPECT_NE(exact_collision(GetParam(), seen.start, reached - seen.start), Collision::hit) << frame.name;
        }
        // Most do not touch before; a step that goes nearly nowhere would be safe, too, and useless.
        short_of_half += limit < 0.5 * impact.time;
      }
    }
  }
  std::printf("  %d impacts, %d of them stopped at less than half their time\n", impacts, short_of_half);
  EXPECT_GT(impacts, 4000);
  EXPECT_LT(short_of_half, impacts / 4);
}

/// A pair that touches at the end of the step, or slides in one plane, with its first side moved off by a part of the
/// normal: half of them then touch, the others miss by that much.
TEST_P(PlaneFilter, NearMissesMayPassAndNearHitsMayNot) {
  std::mt19937 random(23);
  int hits = 0, free = 0, undecided = 0, missed = 0, stopped = 0, left_by_filter = 0;
  for (const double part : {0x1p-4, 0x1p-10, 0x1p-20}) {
    for (int i = 0; i < 600; ++i) {
      Impact impact = random_impact(GetParam(), i % 2 == 0 ? Meeting::plain : Meeting::one_plane, random);
      FourPoints y = impact.start + impact.time * impact.displacement;
      const bool point_triangle = GetParam() == ContactPair::Kind::point_triangle;
      const Vector3 normal = point_triangle ? (y[2] - y[1]).cross(y[3] - y[1]) : (y[1] - y[0]).cross(y[3] - y[2]);
      for (int k = 0; k < (point_triangle ? 1 : 2); ++k) y[k] += (i % 4 < 2 ? part : -part) * normal;
      const double time = i % 2 == 0 ? 1.0 : impact.time;
      const FourPoints start = y - time * impact.displacement;
      MovingPairs moving;
      moving.add(GetParam(), start, impact.displacement);
      const double limit = moving.limit({.slack = 0.0});
      const Collision truth = exact_collision(GetParam(), start, impact.displacement);
      hits += truth == Collision::hit;
      free += truth == Collision::free;
      undecided += truth == Collision::undecided;
      missed += truth == Collision::hit && limit == 1.0;
      stopped += truth == Collision::free && limit < 1.0;
      left_by_filter += truth == Collision::free && !moving.apart({}, 1.0, 0.0, Pack{});
      EXPECT_FALSE(truth == Collision::hit && moving.apart({}, 1.0, 0.0, Pack{}));
      EXPECT_NE(exact_collision(GetParam(), start, impact.displacement, limit), Collision::hit);
    }
  }
  std::printf("  %d hits, %d free, %d undecided; %d missed, %d stopped in vain; the filter leaves %d of the free\n",
              hits, free, undecided, missed, stopped, left_by_filter);
  EXPECT_GT(hits, 150);
  EXPECT_GT(free, 1000);
  EXPECT_EQ(missed, 0);
  EXPECT_LE(stopped, free / 100);
}

/// What it says of a pair does not depend on its lane nor on its neighbours, and it keeps to what it says: sampled, for
/// slack and floor together, on slivers, too.
TEST_P(PlaneFilter, JudgesEachLaneByItselfAndKeepsItsDistance) {
  std::mt19937 random(24);
  int claimed = 0;
  for (int pack = 0; pack < 2000; ++pack) {
    MovingPairs moving;
    Pack floor = {}, near = {};
    const double slack = pack % 3 == 0 ? 0.0 : 0.3, until = pack % 2 == 0 ? 1.0 : 0.5;
    for (int l = 0; l < kLanes; ++l) {
      FourPoints x = random_points(random);
      // The last corner or end all but in line with others.
      if (pack % 5 == 0) {
        const Vector3 edge = GetParam() == ContactPair::Kind::point_triangle ? x[2] - x[1] : x[1] - x[0];
        const Vector3 corner = GetParam() == ContactPair::Kind::point_triangle ? x[1] : x[2];
        x[3] = corner + random_unit(random) * edge + std::ldexp(1.0, -random_int(random, 10, 60)) * x[3];
      }
      moving.add(GetParam(), x, random_points(random));
      floor[l] = 0.2 * std::abs(random_unit(random));
      near[l] = pack % 2 == 0 ? 0.5 * std::abs(random_unit(random)) : std::numeric_limits<double>::infinity();
    }
    const unsigned apart = moving.apart(kAllLanes, until, slack, floor, near);
    for (int l = 0; l < kLanes; ++l) {
      const bool here = apart >> l & 1U;
      claimed += here;
      std::array<int, kLanes> same;
      same.fill(l);
      EXPECT_EQ(moving.apart(same, until, slack, Pack{} + floor[l], Pack{} + near[l]), here ? 0xFFU : 0U)
          << "lane " << l;
      if (!here) continue;
      const FourPoints x = gather(moving.x, moving.pairs[l]), d = gather(moving.p, moving.pairs[l]);
      const auto distance = [&](double t) {
        return std::sqrt(closest_feature(moving.pairs[l], x + t * d).squared_distance);
      };
      const double wanted = slack * std::min(distance(0.0), near[l]) + (1.0 - slack) * floor[l];
      for (int k = 0; k <= 10; ++k)
        ASSERT_GT(distance(until * k / 10), wanted) << to_string(x) << " by " << to_string(d) << " at " << k;
    }
  }
  std::printf("  %d of 16000 apart\n", claimed);
  EXPECT_GT(claimed, 4000);
  EXPECT_LT(claimed, 12000);
}

/// The first side sinks from 1 to 1/4 above the second while it slides: what may be claimed of the end is known to the
/// last digit, wherever that is.
TEST_P(PlaneFilter, ClaimsWhatSlackAndFloorLeaveToTheLastDigit) {
  const FourPoints over = GetParam() == ContactPair::Kind::point_triangle
                              ? FourPoints{Vector3(0.25, 0.25, 1), Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}
                              : FourPoints{Vector3(-2, 0, 1), Vector3(2, 0, 1), Vector3(0, -2, 0), Vector3(0, 2, 0)};
  const Vector3 sinks(0.5, 0.25, -0.75);
  FourPoints d{sinks, Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  if (GetParam() == ContactPair::Kind::edge_edge) d[1] = sinks;
  for (const Frame& frame : kFrames) {
    const Impact seen = transformed({over, d, 0.0}, frame.scale, frame.offset, frame.velocity);
    MovingPairs moving;
    moving.add(GetParam(), seen.start, seen.displacement);
    // What rounding may take where coordinates are this large.
    double size = 0.0;
    for (int k = 0; k < 4; ++k) size += seen.start[k].cwiseAbs().sum() + seen.displacement[k].cwiseAbs().sum();
    const double little = std::max(1e-8 * frame.scale, 1e-14 * size);
    const auto claims = [&](double until, double slack, double floor,
                            double near = std::numeric_limits<double>::infinity()) {
      return moving.apart({}, until, slack, Pack{} + floor, Pack{} + near) == 0xFFU;
    };
    for (const double until : {1.0, 0.5}) {
      const double end = (1.0 - 0.75 * until) * frame.scale;
      EXPECT_FALSE(claims(until, 0.0, end)) << frame.name;
      EXPECT_TRUE(claims(until, 0.0, end - little)) << frame.name;
      EXPECT_FALSE(claims(until, end / frame.scale, 0.0)) << frame.name;
      EXPECT_TRUE(claims(until, (end - little) / frame.scale, 0.0)) << frame.name;
      // Nine tenths of what counts as near.
      EXPECT_FALSE(claims(until, 0.9, 0.0, end / 0.9)) << frame.name;
      EXPECT_TRUE(claims(until, 0.9, 0.0, (end - little) / 0.9)) << frame.name;
      // Half of the distance and half of the floor.
      EXPECT_FALSE(claims(until, 0.125, (end - 0.125 * frame.scale) / 0.875)) << frame.name;
      EXPECT_TRUE(claims(until, 0.125, (end - 0.125 * frame.scale - little) / 0.875)) << frame.name;
    }
  }
}

}  // namespace plane_filter_test
}  // namespace tacipc
