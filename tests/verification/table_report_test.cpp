// The page that results become.
#include "verification/table_report.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc::verify {
namespace table_report_test {

TEST(TableReport, ReadsAResultAndShowsWhatMissed) {
  const ScratchFolder folder;
  const auto file = folder.file("hertz/result.yaml", R"(title: a sphere
source: a book
state: missed
gel_vertices: 12
rows:
  - label: press_force_n
    unit: N
    measured: 1.1
    expected: 1.0
    limit: within 3 %
    deviation: 10.0
    pass: false
)");
  const ResultFile result = read_result(file);
  EXPECT_EQ(result.name, "hertz");
  const std::string page = to_markdown({result}, {}, "verification");
  EXPECT_NE(
      page.find(
          "| [a sphere](../configs/studies/verification/hertz.yaml) | 12 | press_force_n | 1.1 N | 1 N | +10.00 % | "
          "within 3 % | **missed** |"),
      std::string::npos)
      << page;
  EXPECT_NE(page.find("![a sphere](verification/hertz.svg)"), std::string::npos);
}

TEST(TableReport, ASkippedCaseSaysWhy) {
  const ScratchFolder folder;
  const auto file = folder.file("x/result.yaml", "title: t\nsource: s\nstate: skipped\nreason: no data\n");
  EXPECT_NE(to_markdown({read_result(file)}, {}, "p").find("**skipped**: no data"), std::string::npos);
}

TEST(TableReport, AnythingElseIsRefused) {
  const ScratchFolder folder;
  const auto file = folder.file("x/result.yaml", "title: t\nsource: s\nstate: fine\n");
  EXPECT_THROW(read_result(file), ConfigError);
}

}  // namespace table_report_test
}  // namespace tacipc::verify
