// Published collision queries with exact truth: none that collides may pass, and few that do not may be stopped.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "common/base/error.h"
#include "common/base/simd.h"
#include "stages/gel/press/contact/ccd.h"
#include "stages/gel/press/contact/plane_filter.h"
#include "stages/gel/press/solve/step_limit.h"
#include "tests/shared_data.h"
#include "tests/stages/gel/press/contact/exact_collision.h"
#include "tests/stages/gel/press/contact/precise_separation.h"

namespace tacipc {
namespace ccd_queries_test {

struct Counts {
  int queries = 0;
  int hits = 0;
  // Of the test with 113 bits, which resolves any gap, and of a step of the solver, the filter in front.
  int false_negatives = 0, step_false_negatives = 0;
  int false_positives = 0, step_false_positives = 0;
  int stopped_with_room = 0;    // of the latter: farther from touching than doubles resolve
  int inexact_coordinates = 0;  // not representable as a double
};

struct Row {
  std::array<mpq_class, 3> x;
  bool collides;
};

/// Nearer than this part of their size doubles do not tell pairs from those that touch.
constexpr double kResolved = 1e-13;

struct Query {
  bool edge_edge;
  FourPoints start = {}, end = {};
  bool collides = false;
};

Row parse_row(const std::string& line, const std::string& place) {
  std::istringstream in(line);
  std::array<std::string, 7> field;
  for (std::string& text : field) {
    if (!std::getline(in, text, ',')) throw std::runtime_error(place + ": seven fields expected");
    std::erase_if(text, [](char c) { return c == ' ' || c == '\r'; });
  }
  Row row;
  for (int c = 0; c < 3; ++c) {
    row.x[c] = mpq_class(mpz_class(field[2 * c]), mpz_class(field[2 * c + 1]));
    row.x[c].canonicalize();
  }
  if (field[6] != "0" && field[6] != "1") throw std::runtime_error(place + ": truth must be 0 or 1");
  row.collides = field[6] == "1";
  return row;
}

/// How far the solver may go with the query as one pair among `count` of its kind, the others far away from each other;
/// 0 if nowhere.
double step_limit(const Query& query, int lane, int count, const GapRule& rule) {
  Positions x(4 * count, 3), p(4 * count, 3);
  std::vector<ContactPair> pairs;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 4; ++k) {
      x.row(4 * i + k) = query.start[k].transpose();
      p.row(4 * i + k) = (query.end[k] - query.start[k]).transpose();
    }
    if (i != lane) {
      x.row(4 * i).array() += 100.0;
      if (query.edge_edge) x.row(4 * i + 1).array() += 100.0;
      p.middleRows(4 * i, 4).setConstant(0.1 * i);
    }
    pairs.push_back({query.edge_edge ? ContactPair::Kind::edge_edge : ContactPair::Kind::point_triangle,
                     {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}});
  }
  try {
    return contact_step_limit(pairs, x, p, rule);
  } catch (const SolverError&) {
    return 0.0;
  }
}

/// Whether the filter alone shows that the query stays apart, in any lane.
bool filter_passes(const Query& query) {
  Positions x(4, 3), p(4, 3);
  for (int k = 0; k < 4; ++k) {
    x.row(k) = query.start[k].transpose();
    p.row(k) = (query.end[k] - query.start[k]).transpose();
  }
  const ContactPair pair{query.edge_edge ? ContactPair::Kind::edge_edge : ContactPair::Kind::point_triangle,
                         {0, 1, 2, 3}};
  std::array<const ContactPair*, kLanes> lanes;
  lanes.fill(&pair);
  return stay_apart(x.data(), p.data(), 1.0, lanes.data(), pair.kind, 0.0, Pack{}, Pack{}) != 0U;
}

void run(const Query& query, Counts& counts) {
  ++counts.queries;
  counts.hits += query.collides;
  const ContactPair::Kind kind = query.edge_edge ? ContactPair::Kind::edge_edge : ContactPair::Kind::point_triangle;
  const bool reported = may_collide(kind, query.start, query.end);
  counts.false_negatives += query.collides && !reported;
  counts.false_positives += !query.collides && reported;

  // In each lane of packs of each size.
  const int lane = counts.queries % kLanes, count = lane + 1 + counts.queries / kLanes % (kLanes - lane);
  FourPoints displacement;
  for (int k = 0; k < 4; ++k) displacement[k] = query.end[k] - query.start[k];
  bool stopped = true, room = false;
  const auto distance = [&](const FourPoints& x) {
    return std::sqrt((query.edge_edge ? closest_edge_edge(x) : closest_point_triangle(x)).squared_distance);
  };
  // A pair that touches at the start has no distance for slack to be a part of, but the filter sees it all the same.
  EXPECT_FALSE(query.collides && filter_passes(query));
  if (distance(query.start) > 0.0) {
    const double limit = step_limit(query, lane, count, {.slack = 0.0});
    stopped = limit < 1.0;
    FourPoints there;
    double size = 0.0;
    for (int k = 0; k < 4; ++k) {
      there[k] = query.start[k] + limit * displacement[k];
      size = std::max({size, query.start[k].norm(), query.end[k].norm()});
    }
    room = distance(there) > kResolved * size;
    EXPECT_NE(exact_collision(kind, query.start, displacement, limit), Collision::hit);
    // And with the slack of the solver, which leaves less room.
    EXPECT_FALSE(query.collides && step_limit(query, lane, count, {}) == 1.0);
  }
  counts.step_false_negatives += query.collides && !stopped;
  counts.step_false_positives += !query.collides && stopped;
  counts.stopped_with_room += !query.collides && stopped && room;
}

Counts run_file(const std::filesystem::path& file, bool edge_edge) {
  Counts counts;
  std::ifstream in(file);
  Query query{.edge_edge = edge_edge};
  std::string line;
  for (int number = 0; std::getline(in, line); ++number) {
    const Row row = parse_row(line, file.string() + ":" + std::to_string(number + 1));
    for (int c = 0; c < 3; ++c) {
      const double value = row.x[c].get_d();
      counts.inexact_coordinates += mpq_class(value) != row.x[c];
      (number / 4 % 2 == 0 ? query.start : query.end)[number % 4][c] = value;
    }
    if (number % 8 != 7) continue;
    query.collides = row.collides;
    run(query, counts);
  }
  return counts;
}

void print(const std::string& name, const Counts& c) {
  std::printf(
      "  %-36s %5d queries %4d hits, false negatives %d (step: %d), false positives %d (step: %d, always-hit: %d)\n",
      name.c_str(), c.queries, c.hits, c.false_negatives, c.step_false_negatives, c.false_positives,
      c.step_false_positives, c.queries - c.hits);
}

TEST(CcdQueries, NoCollisionPassesAndFewFreeQueriesAreStopped) {
  TACIPC_SHARED_DATA(folder, "data/ccd_queries");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::sort(files.begin(), files.end());

  std::map<std::string, Counts> groups;
  Counts all;
  for (const std::filesystem::path& file : files) {
    const std::string kind = file.parent_path().filename().string();
    ASSERT_TRUE(kind == "edge-edge" || kind == "vertex-face") << file;
    const Counts c = run_file(file, kind == "edge-edge");
    for (Counts* sum : {&groups[file.parent_path().lexically_relative(folder).string()], &all}) {
      sum->queries += c.queries;
      sum->hits += c.hits;
      sum->false_negatives += c.false_negatives;
      sum->false_positives += c.false_positives;
      sum->step_false_negatives += c.step_false_negatives;
      sum->step_false_positives += c.step_false_positives;
      sum->stopped_with_room += c.stopped_with_room;
      sum->inexact_coordinates += c.inexact_coordinates;
    }
  }
  for (const auto& [name, counts] : groups) print(name, counts);
  print("all", all);
  ASSERT_GT(all.queries, 0);
  EXPECT_EQ(all.inexact_coordinates, 0) << "the truth is about numbers that no double holds";
  EXPECT_EQ(all.false_negatives, 0);
  EXPECT_LT(all.false_positives, 0.1 * (all.queries - all.hits));
  EXPECT_EQ(all.step_false_negatives, 0);
  EXPECT_LT(all.step_false_positives, 0.15 * (all.queries - all.hits));
  EXPECT_EQ(all.stopped_with_room, 0);
}

}  // namespace ccd_queries_test
}  // namespace tacipc
