#include "stages/dataset/report/motion.h"

#include <gmock/gmock.h>

#include "tests/scratch_folder.h"

namespace tacipc {

bool operator==(const PhaseReport& a, const PhaseReport& b) {
  return a.name == b.name && a.first == b.first && a.last == b.last;
}
void PrintTo(const PhaseReport& phase, std::ostream* out) {
  *out << phase.name << ' ' << phase.first << '-' << phase.last;
}

namespace motion_test {

using ::testing::ElementsAre;

class MotionTest : public ::testing::Test {
 protected:
  Record sample(const std::string& text) { return Record::from_file(scratch_.file("sample.yaml", text)); }
  ScratchFolder scratch_;
};

TEST_F(MotionTest, IsToldInWords) {
  EXPECT_EQ(motion_text(sample("motion: {kind: press, depth_mm: 0.5, steps: 5}\n")), "press 0.5 mm");
  EXPECT_EQ(motion_text(sample("motion:\n"
                               "  - {kind: press, force_n: 4, steps: 5}\n"
                               "  - {kind: shear, direction_deg: 90, distance_mm: 1.0, steps: 100}\n"
                               "  - {kind: twist, angle_deg: 14.3, steps: 200}\n"
                               "  - {kind: tilt, direction_deg: -30, angle_deg: 5, steps: 10}\n"
                               "  - {kind: hold, steps: 5}\n"
                               "  - {kind: load, force_n: [0.1, 0, -0.5], free: [x, y, z], steps: 10}\n"
                               "  - {kind: path, file: path.csv}\n"
                               "  - {kind: release, steps: 5}\n")),
            "press until 4 N, shear 1 mm towards 90°, twist 14.3°, tilt 5° towards -30°, hold, load (0.1, 0, -0.5) N, "
            "path along path.csv, release");
  EXPECT_EQ(motion_text(sample("motion:\n"
                               "  - {kind: press, depth_mm: [0.3, 0.7], steps: 5}\n"
                               "  - {kind: twist, angle_deg: [-10, 10], steps: 4}\n")),
            "press 0.3 to 0.7 mm, twist -10 to 10°");
  EXPECT_EQ(motion_text(sample("placement: {rotate_deg: 3}\n")), "");
}

TEST_F(MotionTest, TheDepthAskedForIsThatOfTheFirstPressThatNamesOne) {
  EXPECT_EQ(asked_depth_mm(sample("motion: {kind: press, depth_mm: 0.7, steps: 1}\n")), 0.7);
  EXPECT_EQ(asked_depth_mm(sample("motion: [{kind: press, force_n: 4}, {kind: press, depth_mm: 1}]\n")), 1.0);
  EXPECT_EQ(asked_depth_mm(sample("motion: [{kind: press, force_n: 4}]\n")), std::nullopt);
}

const std::vector<std::string> kNames{"reference", "approach", "press", "shear", "shear", "shear", "shear"};

TEST_F(MotionTest, PhasesAreRunsOfEqualNames) {
  EXPECT_THAT(phases_of(kNames, sample("a: 1\n")),
              ElementsAre(PhaseReport{"reference", 0, 0}, PhaseReport{"approach", 1, 1}, PhaseReport{"press", 2, 2},
                          PhaseReport{"shear", 3, 6}));
  EXPECT_THAT(phases_of({"", "press"}, sample("a: 1\n")), ::testing::IsEmpty());
}

TEST_F(MotionTest, TwoPhasesOfOneKindAreToldApartByTheirSteps) {
  const std::string there_and_back =
      "motion: [{kind: press, steps: 2}, {kind: shear, steps: 3}, {kind: shear, steps: 1}]\n";
  EXPECT_THAT(phases_of(kNames, sample(there_and_back)),
              ElementsAre(PhaseReport{"reference", 0, 0}, PhaseReport{"approach", 1, 1}, PhaseReport{"press", 2, 2},
                          PhaseReport{"shear", 3, 5}, PhaseReport{"shear", 6, 6}));
  // Steps that do not add up to the frames tell nothing.
  EXPECT_EQ(phases_of(kNames, sample("motion: [{kind: press, steps: 4}, {kind: shear, steps: 1}]\n")).size(), 4u);
}

TEST(ChosenFrames, AreTheEndsOfTheMotions) {
  const std::vector<PhaseReport> phases{
      {"reference", 0, 0}, {"approach", 1, 1}, {"press", 2, 5}, {"shear", 6, 20}, {"twist", 21, 40}};
  EXPECT_THAT(chosen_frames(phases, 41, 5), ElementsAre(5, 20, 40));
  EXPECT_THAT(chosen_frames({}, 41, 5), ElementsAre(40));
  EXPECT_THAT(chosen_frames({{"reference", 0, 0}}, 1, 5), ElementsAre(0));
}

TEST(ChosenFrames, OfManyTheLastIsAlwaysThere) {
  std::vector<PhaseReport> phases;
  for (int i = 1; i <= 17; ++i) phases.push_back({"hold", i, i});
  for (int max_count = 1; max_count <= 20; ++max_count) {
    const auto chosen = chosen_frames(phases, 18, max_count);
    EXPECT_EQ(static_cast<int>(chosen.size()), std::min(max_count, 17));
    EXPECT_EQ(chosen.back(), 17);
    EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
    EXPECT_EQ(std::adjacent_find(chosen.begin(), chosen.end()), chosen.end());
  }
}

}  // namespace motion_test
}  // namespace tacipc
