#include "stages/study/tabulate/image_table_config.h"

#include <gmock/gmock.h>

#include "tests/stages/study/tabulate/small_table.h"

namespace tacipc {
namespace image_table_config_test {

using testing::ElementsAre;

TEST(ImageTableConfig, ReadsRowsPrintedNumbersAndSheets) {
  const auto config = small_table(
      "printed: {label: elsewhere, source: a paper, region: box, rows: [{name: p, values: {ssim_s: 0.90}}]}\n"
      "sheets: [{name: s, alt: pictures, picture_px: 20, crop_px: [1, 2, 3, 4], columns: [{heading: A, method: "
      "a}]}]\n");
  EXPECT_EQ(config.rows[1].group, "others");
  EXPECT_EQ(config.rows[0].group, "");
  EXPECT_EQ(config.printed->rows[0].value("ssim_s"), "0.90");
  EXPECT_EQ(config.printed->rows[0].value("psnr_ln"), std::nullopt);
  EXPECT_THAT(*config.sheets[0].crop_px, ElementsAre(1, 2, 3, 4));
}

TEST(ImageTableConfig, NamesEveryFault) {
  EXPECT_THAT(
      faults_in<ImageTableConfig>(
          kSmallTable + "printed: {label: l, source: s, region: crop, rows: [{name: p, values: {mae: 1}}]}\n"
                        "sheets: [{name: a/b, alt: x, picture_px: 4, crop_px: [0, 0, 0, 1.5], columns: [{heading: A, "
                        "method: a}, {heading: B, method: a}]}]\n",
          "t.yaml"),
      ElementsAre("t.yaml:5:40: printed.region: is not one of the regions",
                  "t.yaml:5:77: printed.rows[0].values.mae: is not one of the columns",
                  "t.yaml:6:17: sheets[0].name: must be a file's name, not a path",
                  "t.yaml:6:42: sheets[0].picture_px: 4 is outside [8, 4096]",
                  "t.yaml:6:54: sheets[0].crop_px: expected whole pixels, at least one wide and high",
                  "t.yaml:6:126: sheets[0].columns[1].method: is given twice"));
  EXPECT_THAT(
      faults_in<ImageTableConfig>(
          kSmallTable +
              "findings: [{region: crop, column: mae, row: c, against: a, variants: [a, d], below: l, above: a}]\n",
          "t.yaml"),
      ElementsAre("t.yaml:5:21: findings[0].region: is not one of the regions",
                  "t.yaml:5:35: findings[0].column: is not one of the columns",
                  "t.yaml:5:45: findings[0].row: is not one of the rows' methods",
                  "t.yaml:5:70: findings[0].variants: is not one of the rows' methods"));
  EXPECT_THAT(faults_in<ImageTableConfig>(kSmallTable.substr(0, kSmallTable.find("rows:")) +
                                              "rows: [{name: m, method: a}, {name: n, method: a}]\n",
                                          "t.yaml"),
              ElementsAre("t.yaml:4:48: rows[1].method: is given twice"));
}

}  // namespace image_table_config_test
}  // namespace tacipc
