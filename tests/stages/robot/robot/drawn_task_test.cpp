#include "stages/robot/robot/drawn_task.h"

#include <gmock/gmock.h>

#include "stages/robot/robot/task_spec.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace drawn_task_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kText = "variables: {grip_n: [1, 4], grip: 2.5, mass: [-3, -3]}\na: $grip_n\nb: [$grip, $mass]\n";

TEST(DrawnTask, SeedNoughtIsTheMiddleOfEachRange) {
  const ScratchFolder folder;
  const DrawnTask drawn = draw_task(folder.file("t.yaml", kText), 0);
  EXPECT_THAT(drawn.text, testing::EndsWith("\na: 2.5\nb: [2.5, -3]\n"));
  EXPECT_THAT(drawn.variables,
              ElementsAre(std::pair<std::string, double>("grip_n", 2.5), std::pair<std::string, double>("grip", 2.5),
                          std::pair<std::string, double>("mass", -3.0)));
}

TEST(DrawnTask, NumbersLieInTheirRangesAndFollowSeedAndNameAlone) {
  const ScratchFolder folder;
  const auto all = folder.file("t.yaml", kText);
  const auto other = folder.file("other.yaml", "variables: {first: [0, 1], grip_n: [1, 4]}\na: $grip_n\n");
  double low = 4.0, high = 1.0, sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const DrawnTask drawn = draw_task(all, seed);
    const double grip = drawn.variables[0].second;
    low = std::min(low, grip), high = std::max(high, grip), sum += grip;
    EXPECT_EQ(draw_task(other, seed).variables[1].second, grip);
    EXPECT_EQ(drawn.variables[1].second, 2.5);
    // The number of the text is the same one.
    ConfigReader in = ConfigReader::from_text(drawn.text, "t.yaml");
    EXPECT_EQ(in.number("a"), grip);
  }
  EXPECT_GT(low, 1.0);
  EXPECT_LT(low, 1.1);
  EXPECT_LT(high, 4.0);
  EXPECT_GT(high, 3.9);
  EXPECT_NEAR(sum / 200, 2.5, 0.2);  // three times √(3²/12/200)
}

TEST(DrawnTask, ATaskWithoutVariablesIsTakenAsItIs) {
  const ScratchFolder folder;
  EXPECT_EQ(draw_task(folder.file("t.yaml", "a: 1\n"), 3).text, "a: 1\n");
}

TEST(DrawnTask, WhatIsWrongIsSaidWithItsPlace) {
  const ScratchFolder folder;
  const auto file = folder.file("t.yaml", "variables:\n  up: [2, 1]\n  a-b: 1\n  word: one\n  three: [1, 2, 3]\n");
  const std::string name = file.string();
  EXPECT_THAT(faults_of([&] { draw_task(file, 1); }),
              ElementsAre(name + ":2:7: variables.up: the range ends before it begins",
                          name + ":3:8: variables.a-b: a name has letters, digits and _ alone",
                          name + ":4:9: variables.word: expected a number, found 'one'",
                          name + ":5:10: variables.three: expected a list of 2 numbers, found a list of 3"));
}

TEST(DrawnTask, ANameThatIsNoVariableIsNoNumber) {
  const ScratchFolder folder;
  const DrawnTask drawn = draw_task(folder.file("t.yaml", "variables: {a: 1}\nb: $c\n"), 1);
  EXPECT_THAT(faults_of([&] {
                ConfigReader in = ConfigReader::from_text(drawn.text, "t.yaml");
                in.number("b");
                in.ignore("variables");
                in.finish();
              }),
              ElementsAre("t.yaml:2:4: b: expected a number, found '$c'"));
}

}  // namespace drawn_task_test
}  // namespace tacipc
