#include "stages/dataset/report/verdict.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/dataset/report/sample.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace verdict_test {

const std::string kLimits =
    "limits: {smallest_distance_m: 0, intersections: 0, inverted_tets: 0, volume_ratio: 0, balance_relative: 0.001, "
    "smallest_contact_n: 0.01, pose_error_m: 1.0e-09}\n";

class VerdictTest : public ::testing::Test {
 protected:
  Record record(const std::string& text) { return Record::from_file(scratch_.file("record.yaml", text)); }
  RecordLines<PressSummary> summary_lines(const std::string& text) { return RecordLines<PressSummary>(record(text)); }
  /// The check of this name for one frame and a summary with one line replaced or added.
  CheckReport check(const std::string& name, const std::string& line, const FrameReport& frame = {.min_gap_m = 1e-6},
                    const std::string& limits = kLimits) {
    std::string text =
        "converged: true\nintersections: 0\ninverted_tets: 0\nmin_distance_m: 1.0e-06\nmin_volume_ratio: 0.5\n";
    const std::string key = line.substr(0, line.find(':') + 1);
    if (const auto at = text.find(key); at != std::string::npos) text.erase(at, text.find('\n', at) + 1 - at);
    for (const CheckReport& c : checks_of(summary_lines(text + line + "\n" + limits), {frame})) {
      if (c.name == name) return c;
    }
    ADD_FAILURE() << "no check is called " << name;
    return {};
  }

  ScratchFolder scratch_;
};

TEST_F(VerdictTest, EveryLimitHasACaseThatMissesItAndOneThatHoldsIt) {
  EXPECT_TRUE(check("Newton's method", "converged: true").held);
  EXPECT_FALSE(check("Newton's method", "converged: false").held);
  EXPECT_TRUE(check("triangle pairs that intersect", "intersections: 0").held);
  EXPECT_FALSE(check("triangle pairs that intersect", "intersections: 1").held);
  EXPECT_TRUE(check("tetrahedra that are inverted", "inverted_tets: 0").held);
  EXPECT_FALSE(check("tetrahedra that are inverted", "inverted_tets: 3").held);
  EXPECT_TRUE(check("smallest distance", "min_distance_m: 1.0e-12").held);
  EXPECT_FALSE(check("smallest distance", "min_distance_m: 0").held);
  EXPECT_TRUE(check("smallest volume ratio", "min_volume_ratio: 1.0e-06").held);
  EXPECT_FALSE(check("smallest volume ratio", "min_volume_ratio: 0").held);
  EXPECT_TRUE(check("force imbalance", "max_balance_relative: 1.0e-03").held);
  EXPECT_FALSE(check("force imbalance", "max_balance_relative: 1.001e-03").held);
  EXPECT_TRUE(check("distance from the asked pose", "max_pose_error_m: 1.0e-09").held);
  EXPECT_FALSE(check("distance from the asked pose", "max_pose_error_m: 1.1e-09").held);
}

TEST_F(VerdictTest, AGapThatWasNotMeasuredIsNotJudged) {
  const auto lines = summary_lines("converged: true\nintersections: 0\ninverted_tets: 0\nmin_volume_ratio: 0.5\n");
  for (const CheckReport& check : checks_of(lines, {FrameReport{}})) EXPECT_NE(check.name, "smallest distance");
}

TEST_F(VerdictTest, TheLimitsAreTheRecords) {
  const auto with = [&](const std::string& name, const std::string& line, const std::string& limit) {
    return check(name, line, {.min_gap_m = 1e-6}, "limits: {" + limit + "}\n");
  };
  const CheckReport balance =
      with("force imbalance", "max_balance_relative: 5.0e-03", "balance_relative: 0.01, smallest_contact_n: 0.02");
  EXPECT_TRUE(balance.held);
  EXPECT_EQ(balance.limit, "1.00 %, or 200 µN");
  EXPECT_EQ(with("force imbalance", "max_balance_relative: 5.0e-03", "balance_relative: 0.004").limit, "0.400 %");
  EXPECT_FALSE(with("force imbalance", "max_balance_relative: 5.0e-03", "balance_relative: 0.004").held);
  const CheckReport pose = with("distance from the asked pose", "max_pose_error_m: 1.0e-10", "pose_error_m: 1.0e-11");
  EXPECT_FALSE(pose.held);
  EXPECT_EQ(pose.limit, "0.0100 nm");
  EXPECT_TRUE(with("triangle pairs that intersect", "intersections: 2", "intersections: 2").held);
  EXPECT_EQ(with("triangle pairs that intersect", "intersections: 2", "intersections: 1").limit, "1");
  EXPECT_TRUE(with("tetrahedra that are inverted", "inverted_tets: 1", "inverted_tets: 1").held);
  const CheckReport gap = with("smallest distance", "min_distance_m: 1.0e-06", "smallest_distance_m: 1.0e-06");
  EXPECT_FALSE(gap.held) << "must be above";
  EXPECT_EQ(gap.limit, "above 1.00 µm");
  EXPECT_FALSE(with("smallest volume ratio", "min_volume_ratio: 0.2", "volume_ratio: 0.25").held);
}

TEST_F(VerdictTest, WithoutLimitsWhatMustBeZeroIsCheckedAndTheRestIsNot) {
  EXPECT_EQ(check("smallest distance", "min_distance_m: 0", {.min_gap_m = 1.0}, "").limit, "above 0");
  EXPECT_FALSE(check("triangle pairs that intersect", "intersections: 1", {.min_gap_m = 1.0}, "").held);
  const std::string summary =
      "converged: true\nintersections: 0\ninverted_tets: 0\nmin_distance_m: 1\nmin_volume_ratio: 1\n";
  EXPECT_EQ(checks_of(summary_lines(summary + "max_balance_relative: 1\nmax_pose_error_m: 1\n"), {}).size(), 5u);
}

TEST_F(VerdictTest, AFrameThatIsWorseThanTheSummaryCounts) {
  const CheckReport balance =
      check("force imbalance", "max_balance_relative: 1.0e-06", {.min_gap_m = 1e-6, .balance_relative = 2e-3});
  EXPECT_FALSE(balance.held);
  EXPECT_EQ(balance.frame, 0);
  EXPECT_EQ(balance.value, "0.200 % of the contact force");
  EXPECT_EQ(balance.limit, "0.100 %, or 10.0 µN");
  EXPECT_FALSE(check("smallest distance", "min_distance_m: 1", {.min_gap_m = 0.0}).held);
  EXPECT_FALSE(
      check("smallest volume ratio", "min_volume_ratio: 1", {.min_gap_m = 1e-6, .min_volume_ratio = -0.1}).held);
  EXPECT_FALSE(
      check("distance from the asked pose", "max_pose_error_m: 0", {.min_gap_m = 1e-6, .pose_error_m = 1e-6}).held);
}

TEST_F(VerdictTest, WhatARecordDoesNotTellIsNotChecked) {
  const auto checks = checks_of(
      summary_lines("converged: true\nintersections: 0\ninverted_tets: 0\nmin_distance_m: 1\nmin_volume_ratio: 1\n"),
      {FrameReport{.min_gap_m = 1}});
  EXPECT_EQ(checks.size(), 5u);
  EXPECT_EQ(message_of<DataError>([&] { checks_of(summary_lines("converged: true\nintersections: 0\n"), {}); }),
            (scratch_ / "record.yaml").string() + ": inverted_tets: missing");
}

TEST_F(VerdictTest, TheCheckThatEndedAPress) {
  const FailedCheck failed = read_failed_check(record(
      "stage: press\nmessage: \"frame 3: balance\"\nframe: 3\ncheck: balance_relative\nvalue: 0.002\nlimit: 0.001\n"));
  EXPECT_EQ(failed.message, "frame 3: balance");
  ASSERT_TRUE(failed.check);
  EXPECT_EQ(failed.check->name, "balance_relative");
  EXPECT_EQ(failed.check->value, "0.002");
  EXPECT_EQ(failed.check->limit, "0.001");
  EXPECT_EQ(failed.check->frame, 3);
  EXPECT_FALSE(failed.check->held);
  EXPECT_FALSE(read_failed_check(record("message: out of memory\n")).check);
}

}  // namespace verdict_test
}  // namespace tacipc
