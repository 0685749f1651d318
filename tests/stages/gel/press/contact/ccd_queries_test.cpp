// Published collision queries with exact truth: none that collides may pass, and few that do not may be stopped.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "stages/gel/press/contact/ccd.h"
#include "tests/shared_data.h"

namespace tacipc {
namespace {

struct Counts {
  int queries = 0;
  int hits = 0;
  int false_negatives = 0;
  int false_positives = 0;
  int inexact_coordinates = 0;  // not representable as a double
};

struct Row {
  std::array<mpq_class, 3> x;
  bool collides;
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

Counts run_file(const std::filesystem::path& file, bool edge_edge) {
  Counts counts;
  std::ifstream in(file);
  std::array<FourPoints, 2> x;  // at both ends
  std::string line;
  for (int number = 0; std::getline(in, line); ++number) {
    const Row row = parse_row(line, file.string() + ":" + std::to_string(number + 1));
    for (int c = 0; c < 3; ++c) {
      const double value = row.x[c].get_d();
      counts.inexact_coordinates += mpq_class(value) != row.x[c];
      x[number / 4 % 2][number % 4][c] = value;
    }
    if (number % 8 != 7) continue;
    const bool reported = edge_edge ? may_collide_edge_edge(x[0], x[1]) : may_collide_point_triangle(x[0], x[1]);
    ++counts.queries;
    counts.hits += row.collides;
    counts.false_negatives += row.collides && !reported;
    counts.false_positives += !row.collides && reported;
  }
  return counts;
}

void print(const std::string& name, const Counts& c) {
  std::printf("  %-36s %7d queries %6d hits %3d false negatives %4d false positives (always-hit: %d)\n", name.c_str(),
              c.queries, c.hits, c.false_negatives, c.false_positives, c.queries - c.hits);
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
      sum->inexact_coordinates += c.inexact_coordinates;
    }
  }
  for (const auto& [name, counts] : groups) print(name, counts);
  print("all", all);
  ASSERT_GT(all.queries, 0);
  EXPECT_EQ(all.inexact_coordinates, 0) << "the truth is about numbers that no double holds";
  EXPECT_EQ(all.false_negatives, 0);
  EXPECT_LT(all.false_positives, 0.1 * (all.queries - all.hits));
}

}  // namespace
}  // namespace tacipc
