// Long rows: what their records say, and what stands in the page where there is none.
#include "verification/table_report.h"

#include <gtest/gtest.h>

#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc::verify {
namespace table_report_long_rows_test {

const LongRow kRow{.title = "Stress campaign",
                   .shows = "random cases",
                   .goal = "stress",
                   .stage = "stress_table",
                   .page = "stress.md",
                   .needs = {}};

std::string line_of(const LongRowResult& result) {
  const std::string section = long_rows_section({result});
  const std::string head = "## Long rows\n\n| Row | Shows | Found | |\n|---|---|---|---|\n";
  EXPECT_EQ(section.substr(0, head.size()), head);
  return section.substr(head.size());
}

TEST(LongRows, HoldOrMissAsTheirRecordSays) {
  const ScratchFolder folder;
  for (const bool holds : {true, false}) {
    const auto record =
        folder.file("stress_table.yaml", std::string("stage: stress_table\nsummary:\n  cases: 2\n  holds: ") +
                                             (holds ? "true" : "false") + "\n  found: 2 of 2\n");
    const LongRowResult result = read_long_row(kRow, {folder / "marker_curve.yaml", record}, "");
    EXPECT_EQ(result.state, holds ? "pass" : "missed");
    EXPECT_EQ(line_of(result), std::string("| [Stress campaign](stress.md) | random cases | 2 of 2 | ") +
                                   (holds ? "holds" : "**missed**") + " |\n\n");
  }
}

TEST(LongRows, ARowWithoutARecordSaysWhy) {
  const ScratchFolder folder;
  EXPECT_EQ(line_of(read_long_row(kRow, {}, "")),
            "| Stress campaign | random cases | | **not run**: `make -f Makefile.data stress` |\n\n");
  const auto failure = folder.file("stress_table.failed.yaml", "message: out of memory\n");
  EXPECT_EQ(line_of(read_long_row(kRow, {failure}, "")),
            "| Stress campaign | random cases | | **failed**: out of memory |\n\n");
  LongRow needy = kRow;
  needy.needs = "shared:data/board3.obj";
  EXPECT_EQ(line_of(read_long_row(needy, {}, "/nonexistent")),
            "| Stress campaign | random cases | | **skipped**: needs data/board3.obj; there is no folder /nonexistent "
            "(set TACIPC_SHARED) |\n\n");
  EXPECT_EQ(read_long_row(needy, {}, folder / ".").state, "not run");
  EXPECT_EQ(read_long_row(needy, {failure}, "/nonexistent").state, "failed") << "what was tried is shown";
}

TEST(LongRows, OtherRecordsAreRefused) {
  const ScratchFolder folder;
  const auto record = folder.file("stress_table.yaml", "stage: stress_table\nsummary:\n  cases: 2\n  found: 2 of 2\n");
  EXPECT_EQ(faults_of([&] { read_long_row(kRow, {record}, ""); }),
            std::vector<std::string>{record.string() + ":3:3: summary.holds: missing"});
}

TEST(LongRows, StandBetweenCasesAndSources) {
  const ScratchFolder folder;
  const auto result = folder.file("x/result.yaml", "title: t\nsource: s\nstate: skipped\nreason: no data\n");
  const std::string page = to_markdown({read_result(result)}, {{kRow, "missed", "1 of 2"}}, "p");
  EXPECT_NE(page.find("**skipped**: no data |\n\n## Long rows\n\n"), std::string::npos) << page;
  EXPECT_NE(page.find("| 1 of 2 | **missed** |\n\n## Sources of the expected values\n\n"), std::string::npos) << page;
  EXPECT_EQ(to_markdown({read_result(result)}, {}, "p").find("Long rows"), std::string::npos);
}

TEST(LongRows, TheListReads) {
  const auto list = read_config<LongRows>(std::filesystem::path(TACIPC_SOURCE_DIR) /
                                          "configs/studies/verification/table/long_rows.yaml");
  ASSERT_EQ(list.rows.size(), 5u);
  EXPECT_EQ(list.rows.back().goal, "board3");
  EXPECT_EQ(*list.rows.back().needs, "shared:data/tacipc_release/objects/board3.obj");
  EXPECT_EQ(faults_in<LongRows>("rows:\n  - {title: t, shows: s, stage: x, page: p, gaol: x}\n", "rows.yaml").size(),
            2u);
}

}  // namespace table_report_long_rows_test
}  // namespace tacipc::verify
