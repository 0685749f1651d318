#include "stages/study/tabulate/method_scores.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "tests/stages/study/tabulate/small_table.h"

namespace tacipc {
namespace method_scores_test {

TEST(MethodScores, StandInTheOrderOfTheConfigurationUnderTheirMethods) {
  const ScratchFolder scratch;
  const auto b = samples_of(scratch, "b", "40"), a = samples_of(scratch, "a");
  const auto rows = read_methods({b, a}, small_table());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].row.name, "first");
  EXPECT_DOUBLE_EQ(rows[0].cell("full", "ssim_s").mean, 0.625);
  EXPECT_DOUBLE_EQ(rows[0].cell("full", "ssim_s").deviation, 0.125);
  EXPECT_DOUBLE_EQ(rows[0].cell("box", "psnr_ln").mean, 25.0);
  EXPECT_DOUBLE_EQ(rows[1].cell("box", "psnr_ln").mean, 30.0);
}

TEST(MethodScores, RatiosHaveGeometricMeans) {
  const ScratchFolder scratch;
  auto config = small_table();
  config.columns[1].geometric = true;
  const auto rows = read_methods({samples_of(scratch, "a", "80"), samples_of(scratch, "b")}, config);
  EXPECT_NEAR(rows[0].cell("box", "psnr_ln").mean, 40.0, 1e-12);  // of 20 and 80
  EXPECT_NEAR(rows[0].cell("box", "psnr_ln").deviation, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(rows[0].cell("box", "ssim_s").mean, 0.25);
}

TEST(MethodScores, OfSeveralRunsAreMeansOverTheirMeans) {
  const ScratchFolder scratch;
  auto second = samples_of(scratch, "a_second", "50");
  second.name = "a";
  const auto rows = read_methods({samples_of(scratch, "a", "30"), samples_of(scratch, "b"), second}, small_table());
  EXPECT_EQ(rows[0].runs, 2u);
  EXPECT_EQ(rows[1].runs, 1u);
  const auto& box = rows[0].cell("box", "psnr_ln");  // images 20 and 30, then 20 and 50
  EXPECT_DOUBLE_EQ(box.mean, 30.0);
  EXPECT_DOUBLE_EQ(box.deviation, 5.0);
  EXPECT_EQ(box.values, (std::vector<double>{20.0, 40.0}));
  EXPECT_DOUBLE_EQ(rows[0].cell("full", "ssim_s").deviation, 0.0);  // though its images differ
}

TEST(MethodScores, RefuseWhatDoesNotBelongTogether) {
  const ScratchFolder scratch;
  const auto a = samples_of(scratch, "a"), b = samples_of(scratch, "b"), c = samples_of(scratch, "c");
  const auto said = [](const std::vector<NamedPath>& tables, const ImageTableConfig& config) {
    return message_of<DataError>([&] { read_methods(tables, config); });
  };
  EXPECT_EQ(said({a}, small_table()), "row 'second': no table was given for b");
  EXPECT_EQ(said({a, b, c}, small_table()), c.path.string() + ": no row of the configuration has the method c");
  NamedPath again = a;
  again.path = a.path.parent_path() / "." / "samples.csv";
  EXPECT_EQ(said({a, again}, small_table()), again.path.string() + ": is given twice for a");

  auto lacking = small_table();
  lacking.columns[0].column = "depth";
  EXPECT_EQ(said({a, b}, lacking), a.path.string() + ": has no column 'depth'");
  lacking = small_table();
  lacking.regions[0].region = "crop";
  EXPECT_EQ(said({a, b}, lacking), a.path.string() + ": has no row of region crop");

  const std::string head = "name,region,psnr_ln,ssim_s\n";
  scratch.file("b/samples.csv", head + "x.png,full,1,1\nx.png,box,1,1\n");
  EXPECT_EQ(said({a, b}, small_table()),
            b.path.string() + ": was measured on other images than the first row; y.png is only in one of them");
  scratch.file("b/samples.csv", head + "x.png,full,1,1\ny.png,box,1,1\n");
  EXPECT_EQ(said({a, b}, small_table()), b.path.string() + ": region box has other images than region full");
  scratch.file("b/samples.csv", head + "x.png,full,1,1\nx.png,full,1,1\n");
  EXPECT_EQ(said({a, b}, small_table()), b.path.string() + ": x.png is there twice in region full");
  auto other = samples_of(scratch, "other");
  scratch.file("other/samples.csv", head + "y.png,full,1,1\ny.png,box,1,1\nx.png,full,1,1\nx.png,box,1,1\n");
  other.name = "a";
  EXPECT_EQ(said({a, other, c}, small_table()),
            other.path.string() + ": has other images, or another order of them, than " + a.path.string());
  scratch.file("b/samples.csv", head + "x.png,full,many,1\n");
  EXPECT_EQ(said({a, b}, small_table()), b.path.string() + ":2: psnr_ln: 'many' is not a number");
}

}  // namespace method_scores_test
}  // namespace tacipc
