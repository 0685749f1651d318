// Comma-separated tables: quoting, columns by name, faults with their place.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/base/error.h"
#include "common/format/csv.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace csv_test {

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

TEST(Csv, ReadsNumbersWhole) {
  const ScratchFolder scratch;
  const auto path = scratch.file("t.csv", "a,b,c\n 1.5e-3,inf,2x\n");
  CsvReader in(path);
  ASSERT_TRUE(in.next());
  EXPECT_EQ(in.number("a"), 1.5e-3);
  EXPECT_EQ(in.number("b"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(message_of<DataError>([&] { in.number("c"); }), path.string() + ":2: c: '2x' is not a number");
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
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ":2: unterminated quote");
  scratch.file("t.csv", "b\n1\n");
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ": has no column 'a'");
  scratch.file("t.csv", "");
  EXPECT_EQ(message_of<DataError>(read_all), path.string() + ": has no line of column names");
}

}  // namespace csv_test
}  // namespace tacipc
