// Text that readers outside take: CSV and JSON.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/csv.h"
#include "common/error.h"
#include "common/json.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace {

TEST(Csv, WhatIsWrittenReadsBack) {
  const ScratchFolder scratch;
  const std::vector<std::string> odd{"plain", "a, b", "she said \"no\"", "two\nlines", "", "\"", "tail,"};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < odd.size(); ++i) names.push_back(fmt::format("c{}", i));
  CsvReader in(scratch.file("t.csv", csv_line(names) + csv_line(odd) + csv_line(odd)));
  EXPECT_EQ(in.columns(), names);
  ASSERT_TRUE(in.next());
  EXPECT_EQ(in.row(), odd);
  EXPECT_EQ(in["c1"], "a, b");
  EXPECT_EQ(in.line(), 3);
  ASSERT_TRUE(in.next());
  EXPECT_EQ(in.row(), odd);
  EXPECT_FALSE(in.next());
}

TEST(Csv, QuotesOnlyWhereItMust) { EXPECT_EQ(csv_line({"a b", "c,d", "e\"f"}), "a b,\"c,d\",\"e\"\"f\"\n"); }

TEST(Csv, TakesLinesOfWindows) {
  const ScratchFolder scratch;
  CsvReader in(scratch.file("t.csv", "a,b\r\n1,2\r\n"));
  ASSERT_TRUE(in.next());
  EXPECT_EQ(in["b"], "2");
}

TEST(Csv, FaultsSayWhere) {
  const ScratchFolder scratch;
  const auto path = scratch.file("t.csv", "a,b\n1,2\n3\n");
  const auto read_all = [&] {
    CsvReader in(path);
    while (in.next()) in["a"];
  };
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ":3: 1 fields, but there are 2 columns");
  scratch.file("t.csv", "a,b\n1,\"2\n");
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ":2: a quote does not end");
  scratch.file("t.csv", "b\n1\n");
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ": has no column 'a'");
  scratch.file("t.csv", "");
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ": has no line of column names");
}

TEST(Json, ListsOfNumbersStandOnALineAndMapsDoNot) {
  const Value value = Value::Map{{"n", 1},
                                 {"x", 0.1},
                                 {"ok", true},
                                 {"rows", Value::List{Value::List{1, 2}, Value::List{3, 4}}},
                                 {"items", Value::List{Value::Map{{"a", "b"}}}},
                                 {"none", Value::Map{}}};
  EXPECT_EQ(to_json(value),
            "{\n  \"n\": 1,\n  \"x\": 0.1,\n  \"ok\": true,\n  \"rows\": [[1, 2], [3, 4]],\n  \"items\": [\n    {\n"
            "      \"a\": \"b\"\n    }\n  ],\n  \"none\": {}\n}\n");
}

TEST(Json, EscapesAndHasNoInfinity) {
  EXPECT_EQ(to_json(Value("a\"b\\c\nd\x01")), "\"a\\\"b\\\\c\\u000ad\\u0001\"\n");
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(to_json(Value(Value::List{inf, nan, 1e-9})), "[null, null, 1e-09]\n");
}

}  // namespace
}  // namespace tacipc
