#include "stages/dataset/report/dataset/sample_row.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <numbers>

#include "stages/dataset/report/dataset/tally.h"
#include "tests/stages/dataset/report/dataset/dataset_folder.h"

namespace tacipc {
namespace sample_row_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class SampleRowTest : public ::testing::Test {
 protected:
  SampleRow row(int i) const {
    std::optional<SampleRow> found;
    for_each_planned(data_.plan(), std::nullopt, [&](const PlannedRow& planned) {
      if (planned.id == data_.id(i)) found = read_row(planned, data_.dataset(), status_of(data_.sample(i)));
    });
    return found.value();
  }

  ScratchFolder scratch_;
  DatasetFolder data_{scratch_ / "", 4};
};

TEST_F(SampleRowTest, StandsWhereItsFilesSay) {
  EXPECT_EQ(status_of(data_.sample(0)), SampleStatus::unmade);
  data_.fail(0);
  EXPECT_EQ(status_of(data_.sample(0)), SampleStatus::failed);
  data_.make(1);
  EXPECT_EQ(status_of(data_.sample(1)), SampleStatus::made);
  fs::remove(data_.sample(1) / "render/render.yaml");
  EXPECT_EQ(status_of(data_.sample(1)), SampleStatus::unmade);  // interrupted
  write_file(data_.sample(1) / "render/.making", "");
  EXPECT_EQ(status_of(data_.sample(1)), SampleStatus::unmade);
  const int lock = ::open((data_.sample(1) / "render/.making").c_str(), O_RDWR);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  EXPECT_EQ(status_of(data_.sample(1)), SampleStatus::running);
  ::close(lock);
  EXPECT_EQ(status_of(data_.sample(1)), SampleStatus::unmade);
}

TEST_F(SampleRowTest, NumbersAreTheLargestOfTheFrames) {
  data_.make(0);
  const SampleRow made = row(0);
  ASSERT_EQ(made.status, SampleStatus::made) << made.failure->reason;
  EXPECT_DOUBLE_EQ(*made.numbers.depth_mm, 0.5);
  EXPECT_DOUBLE_EQ(*made.numbers.press_force_n, 1.25);
  EXPECT_DOUBLE_EQ(*made.numbers.tangential_force_n, 0.84);
  EXPECT_DOUBLE_EQ(*made.numbers.shear_ratio, 0.84 / 1.2);
  EXPECT_DOUBLE_EQ(*made.numbers.area_mm2, 5);
  EXPECT_DOUBLE_EQ(*made.numbers.twist_deg, 0);
  EXPECT_DOUBLE_EQ(*made.numbers.balance_relative, 2e-4);
  EXPECT_DOUBLE_EQ(made.press->processor_s, 3);
  EXPECT_DOUBLE_EQ(made.render->peak_memory_mb, 80);
  EXPECT_FALSE(made.dropped);
}

TEST_F(SampleRowTest, TheTurnComesFromThePosesOrWhereTheyWereDroppedFromTheMotion) {
  data_.make(0);
  std::vector<double> poses;
  for (const double deg : {0.0, 5.0, -12.0, 3.0, 2.0}) {
    const double c = std::cos(deg * std::numbers::pi / 180), s = std::sin(deg * std::numbers::pi / 180);
    poses.insert(poses.end(), {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  }
  write_npy(data_.sample(0) / "press/object_pose.npy", {5, 4, 4}, poses.data());
  EXPECT_NEAR(*row(0).numbers.twist_deg, -12, 1e-12);
  fs::remove(data_.sample(0) / "press/object_pose.npy");
  write_file(data_.sample(0) / "press/.dropped", "");
  write_file(data_.sample(0) / "press/press.yaml",
             replaced(sheared_record(), "{kind: shear, direction_deg: 90, distance_mm: 0.4, steps: 2}",
                      "{kind: twist, angle_deg: -7.5, steps: 2}"));
  const SampleRow dropped = row(0);
  EXPECT_EQ(dropped.status, SampleStatus::made);
  EXPECT_TRUE(dropped.dropped);
  EXPECT_DOUBLE_EQ(*dropped.numbers.twist_deg, -7.5);
}

TEST(TurnAboutZ, DoesNotSeeATilt) {
  const double t = 0.1, c = std::cos(t), s = std::sin(t);
  const Matrix4 rest = Matrix4::Identity();
  const Matrix4 tilted{{1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0}, {0, 0, 0, 1}};
  const Matrix4 turned{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  EXPECT_EQ(turn_about_z_deg(rest, tilted), 0);
  EXPECT_DOUBLE_EQ(turn_about_z_deg(rest, turned), 90);
  EXPECT_DOUBLE_EQ(turn_about_z_deg(turned, rest), -90);
  Matrix4 rounded = rest;
  rounded(1, 0) = 1e-16;
  EXPECT_EQ(turn_about_z_deg(rest, rounded), 0);
}

TEST_F(SampleRowTest, AMadeSampleThatMissesACheckIsNotTakenAtItsWord) {
  data_.make(0);
  write_file(data_.sample(0) / "press/press.yaml",
             replaced(sheared_record(), "balance_relative: 2.0e-04,", "balance_relative: 2.0e-02,"));
  const SampleRow bad = row(0);
  EXPECT_EQ(bad.status, SampleStatus::failed);
  EXPECT_THAT(bad.failure->reason, HasSubstr("force imbalance is 2.00 % of the contact force in frame 2"));
  EXPECT_FALSE(bad.numbers.depth_mm);
  write_file(data_.sample(0) / "press/press.yaml", "stage: [");
  EXPECT_EQ(row(0).status, SampleStatus::failed);
}

TEST_F(SampleRowTest, TheTallyCountsAndGathersWhatIsMade) {
  data_.make(0);
  data_.make(3);
  data_.fail(1);
  DatasetTally tally(0);
  for (int i = 0; i < 4; ++i) tally.add(row(i));
  EXPECT_EQ(tally.all.total(), 4u);
  EXPECT_EQ(tally.all[SampleStatus::made], 2u);
  EXPECT_EQ(tally.all[SampleStatus::failed], 1u);
  EXPECT_EQ(tally.counts.at("object").at("star")[SampleStatus::failed], 1u);
  EXPECT_EQ(tally.counts.at("object").at("gear")[SampleStatus::unmade], 1u);
  EXPECT_THAT(tally.values(kDepth, "split"),
              ElementsAre(Pair("test", ElementsAre(0.5)), Pair("train", ElementsAre(0.5))));
  EXPECT_EQ(tally.pairs(kDepth, kArea).first.size(), 2u);
  EXPECT_TRUE(tally.failures.empty());  // none were to be kept
  EXPECT_THAT(tally.failures_by_kind, ElementsAre(Pair("press: force balance", 1u)));
  EXPECT_THAT(tally.press.processor_s, ElementsAre(3, 3));
}

}  // namespace sample_row_test
}  // namespace tacipc
