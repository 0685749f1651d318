// Laws of contact: each pair of bodies has its own μ, d̂ and stiffness, or the usual ones.
#include "stages/gel/press/contact/contact_laws.h"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace tacipc {
namespace contact_laws_test {

constexpr ContactLaw kUsual{.friction = 0.7, .d_hat_m = 2e-5, .stiffness = 3.0};

TEST(ContactLaws, OneLawHoldsForAnyTwoBodies) {
  for (const ContactLaws& laws : {ContactLaws(kUsual), ContactLaws::resolved(kUsual, 4, {})}) {
    EXPECT_TRUE(laws.all_alike());
    EXPECT_EQ(laws.of(2, 3).friction, 0.7);
    EXPECT_EQ(laws.of(0, 0).d_hat_m, 2e-5);
    EXPECT_EQ(laws.of(3, 1).stiffness, 3.0);
    EXPECT_EQ(laws.reach_m(), 2e-5);
    EXPECT_EQ(laws.largest_friction(), 0.7);
  }
}

TEST(ContactLaws, APairHasItsOwnValuesInBothOrders) {
  const ContactLaws laws =
      ContactLaws::resolved(kUsual, 3, {{.between = {0, 2}, .friction = 0.9}, {.between = {1, 0}, .friction = 0.1}});
  EXPECT_FALSE(laws.all_alike());
  for (const auto& [a, b, friction] : std::vector<std::tuple<int, int, double>>{
           {0, 0, 0.7}, {0, 1, 0.1}, {1, 0, 0.1}, {0, 2, 0.9}, {2, 0, 0.9}, {1, 2, 0.7}, {2, 2, 0.7}}) {
    EXPECT_EQ(laws.of(a, b).friction, friction) << a << " and " << b;
    EXPECT_EQ(laws.of(a, b).d_hat_m, 2e-5);
    EXPECT_EQ(laws.of(a, b).stiffness, 3.0);
  }
  EXPECT_EQ(laws.largest_friction(), 0.9);
}

TEST(ContactLaws, TheLastOverrideOfAValueCounts) {
  const ContactLaws laws = ContactLaws::resolved(
      kUsual, 2, {{.between = {0, 1}, .friction = 0.2, .d_hat_m = 1e-5}, {.between = {1, 0}, .friction = 0.3}});
  EXPECT_EQ(laws.of(0, 1).friction, 0.3);
  EXPECT_EQ(laws.of(0, 1).d_hat_m, 1e-5);
}

TEST(ContactLaws, APairWithHalfTheReachIsEightTimesAsStiff) {
  const ContactLaws laws =
      ContactLaws::resolved(kUsual, 2, {{.between = {0, 1}, .d_hat_m = 1e-5}, {.between = {1, 1}, .force = 5.0}});
  EXPECT_EQ(laws.of(0, 1).stiffness, 24.0);
  EXPECT_EQ(laws.of(1, 1).stiffness, 15.0);
  EXPECT_EQ(laws.reach_m(), 2e-5);
}

TEST(ContactLaws, TheReachIsTheLargestOfAllPairs) {
  EXPECT_EQ(ContactLaws::resolved(kUsual, 2, {{.between = {0, 1}, .d_hat_m = 5e-5}}).reach_m(), 5e-5);
}

}  // namespace contact_laws_test
}  // namespace tacipc
