#include "common/rival/slope_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace slope_table_test {

TEST(SlopeTable, BinsAreThePublishedOnes) {
  const SlopeTable table(125);
  // 0.726° of inclination, 2.90° of direction.
  EXPECT_EQ(table.inclination_bin(0.0), 0);
  EXPECT_EQ(table.inclination_bin(std::tan(0.725 * std::numbers::pi / 180.0)), 0);
  EXPECT_EQ(table.inclination_bin(std::tan(0.727 * std::numbers::pi / 180.0)), 1);
  EXPECT_EQ(table.inclination_bin(1.0), 62);
  EXPECT_EQ(table.inclination_bin(1e300), 124);
  EXPECT_EQ(table.direction_bin(0.0, 0.0), 62);
  EXPECT_EQ(table.direction_bin(-1.0, -1e-9), 0);
  EXPECT_EQ(table.direction_bin(-1.0, 0.0), 124);
  EXPECT_EQ(table.direction_bin(0.0, 1.0), 93);  // downwards in the image
}

TEST(SlopeTable, AChangeIsTheBinsPolynomialAtThePixel) {
  SlopeTable table(5);
  const std::array<double, 6> weights{1, 2, 4, 8, 16, 32};
  double* bin = table.at(table.inclination_bin(1.0), table.direction_bin(0.0, 1.0));
  for (std::size_t k = 0; k < 6; ++k) bin[3 * k + 1] = weights[k];
  const auto terms = SlopeTable::terms(7, 0, 10, 4);  // (0.5, −0.75)
  EXPECT_EQ(table.change(0.0, 1.0, terms)[1], 0.25 + 2 * 0.5625 - 4 * 0.375 + 8 * 0.5 - 16 * 0.75 + 32);
  EXPECT_EQ(table.change(0.0, 1.0, terms)[0], 0.0);
  EXPECT_EQ(table.change(0.0, -1.0, terms)[1], 0.0) << "another direction is another bin";
}

TEST(SlopeTable, TheFileComesBackAndOthersAreRefused) {
  const ScratchFolder scratch;
  SlopeTable table(3);
  for (std::size_t i = 0; i < table.weights.size(); ++i) table.weights[i] = 0.5 * static_cast<double>(i);
  table.write(scratch / "table.npy");
  EXPECT_EQ(SlopeTable::read(scratch / "table.npy").weights, table.weights);
  write_npy(scratch / "flat.npy", {3}, table.weights.data());
  EXPECT_EQ(message_of<DataError>([&] { SlopeTable::read(scratch / "flat.npy"); }),
            (scratch / "flat.npy").string() + ": is no table of bins x bins x 6 x 3");
  table.weights[5] = std::nan("");
  table.write(scratch / "nan.npy");
  EXPECT_EQ(message_of<DataError>([&] { SlopeTable::read(scratch / "nan.npy"); }),
            (scratch / "nan.npy").string() + ": a weight is not finite");
}

}  // namespace slope_table_test
}  // namespace tacipc
