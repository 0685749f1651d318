#include "common/base/rounding.h"

#include <gtest/gtest.h>

#include <limits>

namespace tacipc {
namespace rounding_test {

TEST(Rounding, MovesByHalfAStepAtMost) {
  constexpr int kExponent = -25;
  const float step = std::ldexp(1.0f, kExponent);
  std::vector<float> values;
  for (int i = 0; i < 20000; ++i) values.push_back(12e-3f * std::sin(0.37f * static_cast<float>(i)));
  std::vector<float> rounded = values;
  round_to(rounded, kExponent);
  float most = 0.0f;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float steps = rounded[i] / step;
    ASSERT_EQ(steps, std::round(steps)) << i;
    most = std::max(most, std::abs(rounded[i] - values[i]));
  }
  EXPECT_LE(most, 0.5f * step);
  EXPECT_GT(most, 0.45f * step);
}

TEST(Rounding, TiesGoToEvenAndWhatIsNoNumberStays) {
  std::vector<double> values{0.5, 1.5, -2.5, 3.25, 1e300, -std::numeric_limits<double>::infinity(), std::nan("")};
  round_to(values, 0);
  EXPECT_EQ(std::vector<double>(values.begin(), values.begin() + 6),
            (std::vector<double>{0.0, 2.0, -2.0, 3.0, 1e300, -std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(std::isnan(values[6]));
}

}  // namespace rounding_test
}  // namespace tacipc
