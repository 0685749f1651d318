#include "stages/image_table/method_rows.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/error.h"
#include "tests/image_table/small_table.h"

namespace tacipc {
namespace {

TEST(MeanAndDeviation, DividesByTheirNumberAndKeepsInfinity) {
  const auto cell = mean_and_deviation({1.0, 2.0, 3.0, 6.0});
  EXPECT_DOUBLE_EQ(cell.mean, 3.0);
  EXPECT_DOUBLE_EQ(cell.deviation, std::sqrt((4.0 + 1.0 + 0.0 + 9.0) / 4.0));
  EXPECT_EQ(mean_and_deviation({1.0, INFINITY}).mean, INFINITY);
  EXPECT_TRUE(std::isnan(mean_and_deviation({1.0, INFINITY}).deviation));
}

TEST(MethodRows, AreFoundByTheirFolderInTheOrderOfTheConfiguration) {
  const ScratchFolder scratch;
  const auto b = samples_in(scratch, "b", "40"), a = samples_in(scratch, "a");
  const auto rows = read_method_rows({b, a}, small_table());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].row.name, "first");
  EXPECT_DOUBLE_EQ(rows[0].cell("full", "ssim_s").mean, 0.625);
  EXPECT_DOUBLE_EQ(rows[0].cell("full", "ssim_s").deviation, 0.125);
  EXPECT_DOUBLE_EQ(rows[0].cell("box", "psnr_ln").mean, 25.0);
  EXPECT_DOUBLE_EQ(rows[1].cell("box", "psnr_ln").mean, 30.0);
}

TEST(MethodRows, RatiosHaveGeometricMeans) {
  const ScratchFolder scratch;
  auto config = small_table();
  config.columns[1].geometric = true;
  const auto rows = read_method_rows({samples_in(scratch, "a", "80"), samples_in(scratch, "b")}, config);
  EXPECT_NEAR(rows[0].cell("box", "psnr_ln").mean, 40.0, 1e-12);  // of 20 and 80
  EXPECT_NEAR(rows[0].cell("box", "psnr_ln").deviation, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(rows[0].cell("box", "ssim_s").mean, 0.25);
}

TEST(MethodRows, RefuseWhatDoesNotBelongTogether) {
  const ScratchFolder scratch;
  const auto a = samples_in(scratch, "a"), b = samples_in(scratch, "b"), c = samples_in(scratch, "c");
  const auto said = [](const std::vector<std::filesystem::path>& tables, const ImageTableConfig& config) {
    return message_of<DataError>([&] { read_method_rows(tables, config); });
  };
  EXPECT_EQ(said({a}, small_table()), "row 'second': none of the tables given lies in a folder named b");
  EXPECT_EQ(said({a, b, c}, small_table()), c.string() + ": no row of the configuration names its folder, c");
  EXPECT_EQ(said({a, a}, small_table()), a.string() + " and " + a.string() + ": lie in folders of the same name");

  auto lacking = small_table();
  lacking.columns[0].column = "depth";
  EXPECT_EQ(said({a, b}, lacking), a.string() + ": has no column 'depth'");
  lacking = small_table();
  lacking.regions[0].region = "crop";
  EXPECT_EQ(said({a, b}, lacking), a.string() + ": has no row of region crop");

  const std::string head = "name,region,psnr_ln,ssim_s\n";
  scratch.file("b/samples.csv", head + "x.png,full,1,1\nx.png,box,1,1\n");
  EXPECT_EQ(said({a, b}, small_table()),
            b.string() + ": was measured on other images than the first row; y.png is only in one of them");
  scratch.file("b/samples.csv", head + "x.png,full,1,1\ny.png,box,1,1\n");
  EXPECT_EQ(said({a, b}, small_table()), b.string() + ": region box has other images than region full");
  scratch.file("b/samples.csv", head + "x.png,full,1,1\nx.png,full,1,1\n");
  EXPECT_EQ(said({a, b}, small_table()), b.string() + ": x.png is there twice in region full");
  scratch.file("b/samples.csv", head + "x.png,full,many,1\n");
  EXPECT_EQ(said({a, b}, small_table()), b.string() + ":2: psnr_ln: 'many' is no number");
}

}  // namespace
}  // namespace tacipc
