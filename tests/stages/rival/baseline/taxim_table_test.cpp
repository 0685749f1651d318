#include "stages/rival/baseline/taxim_table.h"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <string>
#include <string_view>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "tests/common/zip_file.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace taxim_table_test {

constexpr std::size_t kBins = 3;
constexpr int kWidth = 64, kHeight = 48;

/// Another one for each channel, bin and term.
double weight(double channel, std::size_t inclination, std::size_t direction, std::size_t term) {
  constexpr std::array<double, 6> kSizes{1e-3, 2e-3, -1e-3, 0.1, -0.2, 10.0};
  return kSizes[term] * (1.0 + 0.3 * channel + 0.05 * static_cast<double>(inclination * kBins + direction));
}

std::string grad(double channel, std::size_t terms = 6) {
  std::vector<double> values;
  for (std::size_t i = 0; i < kBins; ++i)
    for (std::size_t d = 0; d < kBins; ++d)
      for (std::size_t k = 0; k < terms; ++k) values.push_back(weight(channel, i, d, k));
  return npy_bytes({kBins, kBins, terms}, "<f8",
                   {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
}

class TaximTable : public testing::Test {
 protected:
  SlopeTable read(const NamedFiles& files) {
    return read_taxim_table(scratch_.file("polycalib.npz", zip_of(files, ZipMethod::store)), kWidth, kHeight);
  }
  std::string why(const NamedFiles& files) {
    try {
      read(files);
    } catch (const DataError& error) {
      return error.what();
    }
    return "nothing";
  }
  ScratchFolder scratch_;
};

// Of OpenCV's channels the first, Taxim's "r", is blue.
TEST_F(TaximTable, IsThePolynomialOfWholePixels) {
  const SlopeTable table =
      read({{"bins.npy", "anything"}, {"grad_r.npy", grad(0)}, {"grad_g.npy", grad(1)}, {"grad_b.npy", grad(2)}});
  ASSERT_EQ(table.bins, static_cast<int>(kBins));
  for (const auto& [x, y] : {std::pair{0, 0}, {63, 0}, {17, 40}}) {
    const auto terms = SlopeTable::terms(x, y, kWidth, kHeight);
    // Steeply uphill towards +x: inclination 1 of 3 up to 90 degrees, direction 1.
    const std::array<double, 3> codes = table.change(5.0, 0.0, terms);
    for (std::size_t c = 0; c < 3; ++c) {
      const double channel = 2.0 - static_cast<double>(c);
      const std::array<double, 6> pixel{double(x) * x, double(y) * y, double(x) * y, double(x), double(y), 1.0};
      double expected = 0.0;
      for (std::size_t k = 0; k < 6; ++k) expected += weight(channel, 1, 1, k) * pixel[k];
      EXPECT_NEAR(codes[c], expected, 1e-9) << x << ' ' << y << ' ' << c;
    }
  }
}

TEST_F(TaximTable, WhatIsNoneIsRefused) {
  const std::string good = grad(0);
  EXPECT_THAT(why({{"grad_r.npy", good}, {"grad_g.npy", good}}), testing::HasSubstr("grad_b"));
  EXPECT_THAT(why({{"grad_r.npy", good}, {"grad_g.npy", good}, {"grad_b.npy", grad(0, 5)}}),
              testing::HasSubstr("no table of bins x bins x 6"));
  EXPECT_THAT(why({{"grad_r.npy", grad(0, 5)}, {"grad_g.npy", good}, {"grad_b.npy", good}}),
              testing::HasSubstr("another shape"));
  EXPECT_THAT(
      why({{"grad_r.npy", grad(std::numeric_limits<double>::infinity())}, {"grad_g.npy", good}, {"grad_b.npy", good}}),
      testing::HasSubstr("not finite"));
  EXPECT_THAT(why({{"grad_r.npy", good.substr(0, 100)}, {"grad_g.npy", good}, {"grad_b.npy", good}}),
              testing::HasSubstr("grad_r"));
}

}  // namespace taxim_table_test
}  // namespace tacipc
