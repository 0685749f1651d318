// How far numbers are from those of a training.
#include "common/benchmark/look_spread.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"
#include "tests/config_text.h"

namespace tacipc {
namespace look_spread_test {

constexpr Eigen::Index kSize = 6;

/// Groups of numbers that vary along one direction with this deviation, and with 0.05 in all.
std::vector<Eigen::MatrixXd> groups_of(std::size_t count, double deviation, const Eigen::VectorXd& along) {
  std::vector<Eigen::MatrixXd> groups;
  for (std::size_t g = 0; g < count; ++g) {
    Eigen::MatrixXd rows(3, kSize);
    for (Eigen::Index r = 0; r < 3; ++r)
      for (Eigen::Index k = 0; k < kSize; ++k)
        rows(r, k) = 7.0 + deviation * along[k] * random_normal(1, g, 0) +
                     0.05 * random_normal(2, g, static_cast<std::uint64_t>(r * kSize + k));
    groups.push_back(rows);
  }
  return groups;
}

Eigen::VectorXd diagonal() { return Eigen::VectorXd::Ones(kSize) / std::sqrt(static_cast<double>(kSize)); }
Eigen::VectorXd across() {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(kSize);
  out[0] = std::sqrt(0.5);
  out[1] = -std::sqrt(0.5);
  return out;
}
Eigen::VectorXd at(const Eigen::VectorXd& off) { return Eigen::VectorXd::Constant(kSize, 7.0) + off; }

TEST(LookSpread, LetsNumbersGoAsFarAsTheTrainingWent) {
  double previous = 1e9;
  for (const double deviation : {0.5, 2.0, 8.0}) {
    const LookSpread spread = LookSpread::of(groups_of(60, deviation, diagonal()), {1.5, 4.0});
    EXPECT_LT(spread.distance(at(deviation * diagonal())), 0.5);
    EXPECT_LT(spread.distance(at(2.0 * deviation * diagonal())), 1.0);
    EXPECT_GT(spread.distance(at(10.0 * std::hypot(1.0, deviation) * diagonal())), 1.0) << deviation;
    // Beside that direction the least limit holds, however far the training went along it.
    EXPECT_NEAR(spread.distance(at(8.0 * across())), 2.0, 0.05);
    const double twenty = spread.distance(at(20.0 * diagonal()));
    EXPECT_LT(twenty, previous);
    previous = twenty;
  }
}

TEST(LookSpread, LearnsItsLimitFromGroupsLeftOut) {
  // One group goes a way of its own, which those that are left know nothing of.
  std::vector<Eigen::MatrixXd> groups = groups_of(20, 1.0, diagonal());
  const LookSpread alike = LookSpread::of(groups, {1.5, 1.0});
  for (Eigen::Index r = 0; r < 3; ++r) groups[7].row(r) += 9.0 * across().transpose();
  const LookSpread different = LookSpread::of(groups, {1.5, 1.0});
  EXPECT_GT(alike.distance(at(9.0 * across())), 5.0);
  EXPECT_LT(different.distance(at(9.0 * across())), 1.0);
}

TEST(LookSpread, OfOneGroupIsItsOwn) {
  const LookSpread spread = LookSpread::of(groups_of(1, 1.0, diagonal()), {1.5, 2.0});
  EXPECT_LT(spread.distance(groups_of(1, 1.0, diagonal())[0].row(1).transpose()), 0.3);
  EXPECT_GT(spread.distance(at(50.0 * across())), 10.0);
}

struct ReadSpread {
  LookSpread spread;
  static ReadSpread read(ConfigReader& in) { return {LookSpread::read(in, kSize)}; }
};

TEST(LookSpread, IsReadAsItWasWritten) {
  const LookSpread spread = LookSpread::of(groups_of(9, 3.0, diagonal()), {1.5, 4.0});
  const std::string text = to_yaml(spread.to_value());
  const LookSpread again = config_from_text<ReadSpread>(text, "spread").spread;
  for (const Eigen::VectorXd& numbers : {at(2.0 * diagonal()), at(5.0 * across()), at(0.0 * across())})
    EXPECT_NEAR(again.distance(numbers), spread.distance(numbers), 1e-4);
  const auto faults = [&](const std::string& change, const std::string& by) {
    std::string damaged = text;
    return faults_in<ReadSpread>(damaged.replace(damaged.find(change), change.size(), by), "spread").size();
  };
  EXPECT_EQ(faults("mean: [", "mean: [1, "), 1U);
  EXPECT_EQ(faults("mean: [", "mean: [.nan, 1, 2, 3, 4, 5]\nof: ["), 2U);
  EXPECT_EQ(faults("deviations: [", "deviations: [-"), 1U);
  EXPECT_EQ(faults("deviations: [", "deviations: [1, 1, 1, 1, 1, 1, 1, "), 2U);
  EXPECT_EQ(faults("beside_limit: ", "beside_limit: -"), 1U);
}

}  // namespace look_spread_test
}  // namespace tacipc
