#include <fmt/core.h>
#include <gmock/gmock.h>

#include <optional>

#include "tests/program_test.h"
#include "tests/stages/dataset/report/sample_folder.h"

namespace tacipc {
namespace report_program_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ReportStageTest : public ProgramTest {
 protected:
  /// Runs the program in the scratch folder or another; what it says is in said_.
  int run(const std::vector<std::string>& samples, const std::string& out, const std::string& more = "",
          const std::optional<fs::path>& working_folder = std::nullopt) {
    const std::string root = working_folder.value_or(scratch_ / "").string();
    std::string command = "cd " + root + " && " + std::string(TACIPC_BIN_DIR) + "/report";
    for (const std::string& sample : samples) command += fmt::format(" --sample {}", sample);
    return run_command(command + fmt::format(" --out {} {}", out, more));
  }

  fs::path star_ = write_sample(scratch_ / "", "star");
  fs::path gear_ = write_sample(scratch_ / "", "gear");
};

TEST_F(ReportStageTest, WritesPageSheetAndRecordAndCountsTheFailed) {
  fs::remove(gear_ / "press/press.yaml");
  ASSERT_EQ(run({"out/demo/star", "out/demo/gear"}, "out/demo/report", "--title 'A & B'"), 0) << said_;
  EXPECT_EQ(said_, "report: warning: gear: failed: press ended before it was done, without an error message\n");
  EXPECT_THAT(read_file(scratch_ / "out/demo/report/index.html"), HasSubstr("<h1>A &amp; B</h1>"));
  EXPECT_EQ(read_png(scratch_ / "out/demo/report/contact_sheet.png", 3).width, 2332);
  const std::string record = read_file(scratch_ / "out/demo/report/report.yaml");
  EXPECT_THAT(record, HasSubstr("summary:\n  samples: 2\n  passed: 1\n  failed: 1\n"));
  EXPECT_THAT(record, HasSubstr("- path: ../star\n"));
}

/// Where all frames were rendered the page shows them in turn; of fewer, or of another press, it does not.
TEST_F(ReportStageTest, AMotionOfWhichAllFramesAreRenderedMoves) {
  const auto write_frames = [&](const fs::path& render, const std::string& hash) {
    for (int f = 0; f < 3; ++f)
      write_flat_png(render / fmt::format("frame_{:04}/tactile.png", f), 16, 12,
                     static_cast<std::uint8_t>(50 + 60 * f));
    write_file(render / "render.yaml",
               fmt::format("stage: render\ninputs: {{press: {{path: ../press, hash: {}}}}}\n", hash));
  };
  const std::vector<double> times{0.0, 0.01, 0.02};
  write_npy(star_ / "press/time.npy", {3}, times.data());
  ASSERT_EQ(run({"out/demo/star"}, "out/demo/report"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/demo/report/index.html"), ::testing::Not(HasSubstr("class=\"film\"")));
  write_frames(star_ / "frames", content_hash(star_ / "press"));
  ASSERT_EQ(run({"out/demo/star", "out/demo/gear"}, "out/demo/report"), 0) << said_;
  const std::string page = read_file(scratch_ / "out/demo/report/index.html");
  const std::size_t film = page.find("class=\"film\"");
  ASSERT_NE(film, std::string::npos);
  EXPECT_EQ(page.find("class=\"film\"", film + 1), std::string::npos) << "the gear has none";
  EXPECT_THAT(page, HasSubstr("background-image: url(films/sample-1.jpg); background-size: 100% 300%; "
                              "animation-duration: 0.300s; animation-timing-function: steps(3, jump-none)"));
  EXPECT_THAT(page, HasSubstr("<b>The motion</b>: tactile; 10 times slower than the motion, 3 of 3 frames"));
  const ByteImage strip = read_png(scratch_ / "out/demo/report/films/sample-1.jpg", 3);
  ASSERT_EQ(strip.height, 36);
  for (int f = 0; f < 3; ++f) EXPECT_NEAR(strip.at(8, 12 * f + 6, 0), 50 + 60 * f, 4);
  write_frames(star_ / "frames", "another");
  ASSERT_EQ(run({"out/demo/star"}, "out/demo/report"), 0);
  EXPECT_THAT(said_, HasSubstr("star-007: no moving picture: out/demo/star/frames: its images are of another press"));
  EXPECT_THAT(read_file(scratch_ / "out/demo/report/index.html"), ::testing::Not(HasSubstr("class=\"film\"")));
  EXPECT_FALSE(fs::exists(scratch_ / "out/demo/report/films"));
}

TEST_F(ReportStageTest, TheSameSamplesGiveTheSameBytesWhereverTheyLie) {
  ASSERT_EQ(run({"out/demo/star", "out/demo/gear"}, "out/demo/report", "--threads 1"), 0);
  fs::copy(scratch_ / "out", scratch_ / "copied", fs::copy_options::recursive);
  fs::remove_all(scratch_ / "copied/demo/report");
  ASSERT_EQ(run({"copied/demo/star/", "copied/demo/gear/"}, "copied/demo/report", "--threads 4"), 0);
  for (const char* name : {"index.html", "contact_sheet.png"})
    EXPECT_EQ(read_file(scratch_ / "out/demo/report" / name), read_file(scratch_ / "copied/demo/report" / name))
        << name;
}

TEST_F(ReportStageTest, TheCurrentFolderMayBeTheSample) {
  write_file(star_ / "press/press.yaml", replaced(kPressRecord, "name: star-007\n", ""));
  fs::remove(star_ / "render/frame_0002/normal.png");
  ASSERT_EQ(run({"."}, "report", "", star_), 0) << said_;
  EXPECT_EQ(said_, "report: warning: star: failed: render/frame_0002/normal.png: is missing\n");
  EXPECT_THAT(read_file(star_ / "report/index.html"), HasSubstr("href=\"../press/press.yaml\""));
}

TEST_F(ReportStageTest, DamagedPicturesAndRecordsAreFailedSamples) {
  const std::string picture = read_file(star_ / "render/frame_0002/tactile.png");
  write_file(star_ / "render/frame_0002/tactile.png", picture.substr(0, picture.size() / 2));
  write_file(gear_ / "press/press.yaml", "stage: press\n\x1f");
  ASSERT_EQ(run({"out/demo/star", "out/demo/gear"}, "out/demo/report"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("star-007: failed: render/frame_0002/tactile.png: the file ends"));
  EXPECT_THAT(said_, HasSubstr("gear: failed: press/press.yaml:2:1: not valid YAML"));
  EXPECT_THAT(read_file(scratch_ / "out/demo/report/report.yaml"), HasSubstr("passed: 0\n  failed: 2\n"));
}

TEST_F(ReportStageTest, AReportInsideItsSampleIsNotPartOfWhatItReports) {
  ASSERT_EQ(run({"out/demo/star"}, "out/demo/star/report"), 0);
  const std::string first = read_file(star_ / "report/report.yaml");
  ASSERT_EQ(run({"out/demo/star"}, "out/demo/star/report"), 0);
  EXPECT_EQ(read_file(star_ / "report/report.yaml"), first);
}

TEST_F(ReportStageTest, TheRecordChangesWhenASampleDoes) {
  ASSERT_EQ(run({"out/demo/star"}, "out/demo/report"), 0);
  const std::string first = read_file(scratch_ / "out/demo/report/report.yaml");
  write_file(star_ / "press/positions.npy", "other");
  ASSERT_EQ(run({"out/demo/star"}, "out/demo/report"), 0);
  EXPECT_NE(read_file(scratch_ / "out/demo/report/report.yaml"), first);
}

TEST_F(ReportStageTest, AFolderThatIsMissingOrNoSampleIsRefused) {
  EXPECT_EQ(run({"out/demo/none"}, "out/demo/report"), 2);
  EXPECT_EQ(said_, "report: error: --sample: Path does not exist: out/demo/none (see tacipc report --help)\n");
  EXPECT_EQ(run({"out/gels"}, "out/demo/report"), 1);
  EXPECT_EQ(said_,
            "report: error: out/gels: has neither a press folder nor a sample.yaml, so it is not a sample's folder\n");
  EXPECT_FALSE(fs::exists(scratch_ / "out/demo/report/index.html"));
  EXPECT_EQ(run({}, "out/demo/report"), 2);
  EXPECT_EQ(said_,
            "report: error: give either --sample, once per sample, or --grasp, or --scene, or --plan, --dataset and "
            "--config of a "
            "dataset\n");
}

}  // namespace report_program_test
}  // namespace tacipc
