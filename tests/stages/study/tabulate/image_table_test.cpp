#include "stages/study/tabulate/image_table.h"

#include <gtest/gtest.h>

#include <array>

#include "common/base/error.h"
#include "tests/stages/study/tabulate/small_table.h"

namespace tacipc {
namespace image_table_test {

constexpr const char* kPrinted =
    "printed: {label: elsewhere, source: a paper, region: full, rows: [{name: p|q, values: {psnr_ln: 55.92}}]}\n";

TEST(ImageTable, HasATablePerRegionAndPrintedRowsInTheirsAlone) {
  const ScratchFolder scratch;
  const auto config =
      small_table(std::string(kPrinted) +
                  "caption: What it means.\nlink_folder: figures\n"
                  "sheets: [{name: s, alt: pictures, picture_px: 20, columns: [{heading: A, method: a}]}]\n");
  const auto rows = read_methods({samples_of(scratch, "a"), samples_of(scratch, "b", "inf")}, config);
  EXPECT_EQ(to_markdown(rows, config),
            "| Whole image | SSIM-S | PSNR ln |\n"
            "|---|---|---|\n"
            "| first | 0.625 ± 0.125 | 12.0 ± 2.0 |\n"
            "| **others** |  |  |\n"
            "| second | 0.625 ± 0.125 | 12.0 ± 2.0 |\n"
            "| **elsewhere** |  |  |\n"
            "| p\\|q | – | 55.92 |\n"
            "\n"
            "| Contact box | SSIM-S | PSNR ln |\n"
            "|---|---|---|\n"
            "| first | 0.250 ± 0.000 | 25.0 ± 5.0 |\n"
            "| **others** |  |  |\n"
            "| second | 0.250 ± 0.000 | ∞ ± – |\n"
            "\n"
            "balls: mean ± standard deviation over 2 images. Printed numbers: a paper.\n"
            "\n"
            "What it means.\n"
            "\n"
            "![pictures](figures/s.png)\n");
}

TEST(ImageTable, SpeedsAreLastColumnsOfTheRowsThatWereTimed) {
  const ScratchFolder scratch;
  const auto config = small_table(kPrinted);
  const auto rows = read_methods({samples_of(scratch, "a"), samples_of(scratch, "b")}, config);
  const std::vector<ImageSpeed> speeds{
      {.method = "a", .width_px = 32, .height_px = 24, .simulation_ms = 527.4, .membrane_ms = 14.6, .light_ms = 24},
      {.method = "c", .width_px = 32, .height_px = 24, .light_ms = 1},
      {.method = "a", .width_px = 64, .height_px = 48, .object_ms = 1, .membrane_ms = 2, .light_ms = 3}};
  const std::string text = to_markdown(rows, config, speeds);
  EXPECT_NE(text.find("| Whole image | SSIM-S | PSNR ln | CPU ms, 32 × 24 | CPU ms, 64 × 48 |\n"
                      "|---|---|---|---|---|\n"
                      "| first | 0.625 ± 0.125 | 12.0 ± 2.0 | 39 + press 527 | 6 |\n"
                      "| **others** |  |  |  |  |\n"
                      "| second | 0.625 ± 0.125 | 12.0 ± 2.0 | | |\n"
                      "| **elsewhere** |  |  |  |  |\n"
                      "| p\\|q | – | 55.92 | | |\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| Contact box | SSIM-S | PSNR ln |\n"), std::string::npos) << text;
  auto renamed = rows;
  renamed[1].row.timed_as = "a";
  EXPECT_NE(to_markdown(renamed, config, speeds).find("| second | 0.625 ± 0.125 | 12.0 ± 2.0 | 39 + press 527 | 6 |\n"),
            std::string::npos);
  renamed[1].row.timed_as = "d";
  EXPECT_THROW(to_markdown(renamed, config, speeds), DataError);
  EXPECT_NO_THROW(to_markdown(renamed, config));
}

TEST(ImageTable, GeometricMeansHaveAFactor) {
  const ScratchFolder scratch;
  auto config = small_table();
  config.columns[1].geometric = true;
  const std::string text =
      to_markdown(read_methods({samples_of(scratch, "a", "80"), samples_of(scratch, "b")}, config), config);
  EXPECT_NE(text.find("| first | 0.250 ± 0.000 | 40.0 ×÷ 2.0 |\n"), std::string::npos) << text;
}

TEST(ImageTable, RowsOfSeveralRunsSaySoAndFindingsCountTheirDeviation) {
  const ScratchFolder scratch;
  auto config = small_table(
      "findings:\n"
      "  - {region: box, column: psnr_ln, row: a, against: b, below: less., above: more.}\n"
      "  - {region: full, column: psnr_ln, row: a, against: b, below: less., above: more.}\n");
  const auto table = [&](const std::string& method, const std::string& last) {
    return NamedPath{.name = method, .path = samples_of(scratch, method + last, last).path};
  };
  // Means of the runs 20 and 26; 40 and 48.
  std::vector<NamedPath> tables{table("a", "20"), table("a", "32"), table("b", "60"), table("b", "76")};
  const auto text_of = [&] { return to_markdown(read_methods(tables, config), config); };
  EXPECT_NE(text_of().find("| first | 0.250 ± 0.000 | 23.0 ± 3.0 |\n"), std::string::npos) << text_of();
  EXPECT_NE(text_of().find("over 2 images; in rows of several runs, over the runs' means (first 2, second 2).\n"),
            std::string::npos)
      << text_of();
  EXPECT_NE(text_of().find("PSNR ln: first has 0.52 times that of second (others), a difference of 3.0 deviations "
                           "between single runs: less.\n"),  // 21 / √(18 + 32)
            std::string::npos)
      << text_of();
  // In the whole image all runs agree.
  EXPECT_NE(text_of().find("PSNR ln: first has 1.00 times that of second (others): more.\n"), std::string::npos);
  EXPECT_NE(to_csv(read_methods(tables, config), config).find("first,,box,psnr_ln,2,2,23,3,\n"), std::string::npos);

  config.columns[1].geometric = true;  // 20 and √640; √1200 and √1520
  EXPECT_NE(text_of().find("a difference of 2.6 deviations between single runs: less.\n"), std::string::npos)
      << text_of();
  tables[3] = table("b", "20");  // √1200 and 20
  EXPECT_NE(text_of().find("a difference of 0.4 deviations between single runs: not clear.\n"), std::string::npos)
      << text_of();
  tables.pop_back();
  EXPECT_EQ(text_of().find("between single runs"), std::string::npos) << text_of();
}

TEST(ImageTable, FindingsCompareTwoRows) {
  const ScratchFolder scratch;
  const auto config = small_table(
      "findings:\n"
      "  - {region: box, column: psnr_ln, row: a, against: b, below: less., above: as much.}\n"
      "  - {region: box, column: psnr_ln, row: b, against: a, below: less., above: as much.}\n");
  const auto rows = read_methods({samples_of(scratch, "a", "10"), samples_of(scratch, "b", "40")}, config);
  const std::string text = to_markdown(rows, config);
  EXPECT_NE(text.find("\n\n- Contact box, PSNR ln: first has 0.50 times that of second (others): less.\n"
                      "- Contact box, PSNR ln: second (others) has 2.00 times that of first: as much.\n"),
            std::string::npos)
      << text;
}

TEST(ImageTable, FindingsSmallerThanTheSpreadOfSettingsAreNone) {
  const auto text_of = [](const std::string& row, const std::string& variant, const std::string& mean,
                          const std::array<std::string, 3>& last) {
    const ScratchFolder scratch;
    std::string text = kSmallTable.substr(0, kSmallTable.find("rows:")) +
                       "rows: [{name: one, method: a}, {name: two, method: b}, {name: other, method: c}]\n"
                       "findings: [{region: box, column: psnr_ln, row: " +
                       row + ", against: c, variants: [" + variant + "], below: less., above: more.}]\n";
    text.replace(text.find("digits: 1"), 9, "digits: 1, mean: " + mean);
    const auto config = config_from_text<ImageTableConfig>(text, "t.yaml");
    return to_markdown(read_methods({samples_of(scratch, "a", last[0]), samples_of(scratch, "b", last[1]),
                                     samples_of(scratch, "c", last[2])},
                                    config),
                       config);
  };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  };
  // Means of 25 and 55 with two settings, 80 of the other: a difference of 55 is more than their 30, one of 25 is not.
  const std::array<std::string, 3> apart{"30", "90", "140"};
  says(text_of("a", "b", "arithmetic", apart),
       "one has 0.31 times that of other (0.31 to 0.69 times with other settings): less.\n");
  says(text_of("b", "a", "arithmetic", apart),
       "two has 0.69 times that of other (0.31 to 0.69 times with other settings): less than the settings change, "
       "though with all of them on the same side.\n");
  says(text_of("a", "b", "arithmetic", {"30", "90", "60"}),
       "one has 0.62 times that of other (0.62 to 1.38 times with other settings): less than the settings change.\n");
  // Geometric means of 40, 20 and 70: 1.75 times is less than twice.
  says(text_of("a", "b", "geometric", {"80", "20", "245"}),
       "one has 0.57 times that of other (0.29 to 0.57 times with other settings): less than the settings change, "
       "though with all of them on the same side.\n");
}

TEST(ImageTable, CsvHasOneLinePerNumberAndSaysWhatWasPrinted) {
  const ScratchFolder scratch;
  auto config = small_table(kPrinted);
  config.columns.pop_back();
  config.printed->rows[0].values = {{"ssim_s", "0.90"}};
  const auto rows = read_methods({samples_of(scratch, "a"), samples_of(scratch, "b")}, config);
  EXPECT_EQ(to_csv(rows, config),
            "row,group,region,column,images,runs,mean,std,source\n"
            "first,,full,ssim_s,2,1,0.625,0.125,\n"
            "second,others,full,ssim_s,2,1,0.625,0.125,\n"
            "first,,box,ssim_s,2,1,0.25,0,\n"
            "second,others,box,ssim_s,2,1,0.25,0,\n"
            "p|q,elsewhere,full,ssim_s,,,0.90,,a paper\n");
}

}  // namespace image_table_test
}  // namespace tacipc
