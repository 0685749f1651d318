#include "stages/dataset/report/grasp_part.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sample_folder.h"

namespace tacipc {
namespace grasp_part_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kRecord = R"(stage: press
summary:
  outcome: slipped
  reason: acceleration
  friction_coefficient: 0.55
  center_of_mass_shift_m: [0.001, 0, -0.002]
  slip_left: {first_slip_s: 0.02, gross_slip_s: 0.03}
  judged_frame: 2
  object_mass_kg: 0.08
  grip_n: 4.5
  pose: {grip_m: [0, 0, 0.005], lever_m: 0.002, width_m: 0.03}
  slip_m: 0.0015
  turn_rad: 0.0174532925
  friction_margin: 1.5
  per_frame:
    - {time_s: 0, phase: reference, grip_left_n: 0, grip_right_n: 0, carried_n: 0, slip_m: 0, turn_rad: 0}
    - {time_s: 0.01, phase: close, grip_left_n: 4, grip_right_n: 5, carried_n: 0, slip_m: 0, turn_rad: 0}
    - {time_s: 0.03, phase: lift, grip_left_n: 4.5, grip_right_n: 4.5, carried_n: 0.785, slip_m: 0.0015, turn_rad: 0.0174532925}
)";

class GraspPartTest : public ::testing::Test {
 protected:
  GraspReport grasp(const std::string& record = kRecord) {
    scratch_.file("press.yaml", record);
    return read_grasp(scratch_ / "");
  }

  ScratchFolder scratch_;
};

TEST_F(GraspPartTest, ThePageTellsTheOutcomeAndLeadsToTheView) {
  GraspReport report = grasp();
  const std::string without = grasp_words(report).first;
  EXPECT_THAT(without, HasSubstr("<h2>Grasp: slipped (acceleration)</h2>"));
  EXPECT_THAT(without, AllOf(HasSubstr("80.0 g gripped with 4.50 N at (0, 0, 5.00) mm"),
                             HasSubstr("Friction of both fingers could carry 1.50 times")));
  EXPECT_THAT(without, HasSubstr("(frame 2), the object had slipped 1.50 mm and turned 1.00°"));
  EXPECT_THAT(without, Not(HasSubstr("view.html")));
  report.has_view = true;
  EXPECT_THAT(grasp_words(report).first, HasSubstr("<a href=\"view.html#grasp\">"));
}

TEST_F(GraspPartTest, PhasesAreStretchesOfTimeInItsCurves) {
  const std::string html = grasp_words(grasp()).first;
  const std::size_t close = html.find("<title>close</title>"), lift = html.find("<title>lift</title>");
  ASSERT_NE(close, std::string::npos);
  ASSERT_NE(lift, std::string::npos);
  EXPECT_EQ(html.find("<title>reference</title>"), std::string::npos);
  const auto width = [&](std::size_t at) {
    const std::size_t from = html.rfind("width=\"", at) + 7;
    return std::stod(html.substr(from, html.find('"', from) - from));
  };
  EXPECT_NEAR(width(lift) / width(close), 2.0, 0.01);  // 20 ms beside 10 ms
}

TEST_F(GraspPartTest, SlipIsDrawnUpToTheFrameThatIsJudged) {
  const auto points = [](const std::string& html, std::size_t curve) {
    std::size_t at = html.find("points=\"");
    for (; curve > 0; --curve) at = html.find("points=\"", at + 1);
    return std::count(html.begin() + static_cast<std::ptrdiff_t>(at),
                      html.begin() + static_cast<std::ptrdiff_t>(html.find("\"/>", at)), ',');
  };
  const std::string html = grasp_words(grasp(replaced(kRecord, "judged_frame: 2", "judged_frame: 1"))).first;
  EXPECT_EQ(points(html, 0), 3);  // the left grip
  EXPECT_EQ(points(html, 3), 2);  // slip
  EXPECT_EQ(points(html, 4), 2);  // turn
}

TEST_F(GraspPartTest, AFingersPageHasTheLabelsOfItsGrasp) {
  const std::string left = grasp_article(grasp(), 0, "strip.jpg"), right = grasp_article(grasp(), 1, "");
  EXPECT_THAT(left, AllOf(HasSubstr("<dd>slipped (acceleration)</dd>"), HasSubstr("src=\"strip.jpg\""),
                          HasSubstr("<dd>slips from 0.0200 s on, as a whole from 0.0300 s on</dd>"),
                          HasSubstr("<dd>0.550</dd>"), HasSubstr("<dd>(1.00, 0, -2.00) mm</dd>")));
  EXPECT_THAT(right, AllOf(HasSubstr("<dd>slips never, as a whole never</dd>"), Not(HasSubstr("<img"))));
}

TEST_F(GraspPartTest, TheStripHasWhatWasRendered) {
  std::vector<SceneGel> gels{{"left", scratch_ / "left", {}}};
  EXPECT_THROW(grasp_strip(gels, grasp().moments), DataError);
  for (const int frame : {0, 2})
    write_flat_png(scratch_ / fmt::format("left/render/frame_{:04}/tactile.png", frame), 320, 240,
                   static_cast<std::uint8_t>(50 + frame));
  const ByteImage strip = grasp_strip(gels, grasp().moments);
  EXPECT_EQ(strip.at(strip.width - 82, strip.height - 62, 0), 52);
  EXPECT_EQ(strip.at(strip.width - 82 - 164, strip.height - 62, 0), 50);
  EXPECT_LT(strip.width, 3 * 164);
}

TEST_F(GraspPartTest, AFramesWordsAreThoseOfItsMoment) {
  const SceneView view{.frames = {0, 2}, .gels = {}, .objects = {}};
  EXPECT_THAT(grasp_texts(grasp(), view),
              ElementsAre("frame 0 of 2 · reference · 0 s · grip left 0 N, right 0 N · carried 0 N",
                          "frame 2 of 2 · lift · 0.0300 s · grip left 4.50 N, right 4.50 N · carried 0.785 N"));
}

TEST_F(GraspPartTest, TheStripHasARowForEachGelAndAColumnForEachFrame) {
  std::vector<SceneGel> gels;
  for (const char* name : {"left", "right"}) {
    gels.push_back({name, scratch_ / name, {}});
    for (int frame = 0; frame < 3; ++frame)
      write_flat_png(scratch_ / fmt::format("{}/render/frame_{:04}/tactile.png", name, frame), 320, 240,
                     static_cast<std::uint8_t>(50 * frame + (gels.size() == 1 ? 0 : 100)));
  }
  const GraspReport report = grasp();
  const ByteImage strip = grasp_strip(gels, report.moments);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column)
      EXPECT_EQ(strip.at(strip.width - 82 - 164 * (2 - column), strip.height - 62 - 124 * (1 - row), 0),
                50 * column + 100 * row);
  }
  std::filesystem::remove(scratch_ / "right/render/frame_0002/tactile.png");
  EXPECT_THROW(grasp_strip(gels, report.moments), DataError);
}

TEST_F(GraspPartTest, ARecordThatIsNoGraspsIsRefused) {
  const std::string file = (scratch_ / "press.yaml").string();
  EXPECT_EQ(message_of<DataError>([&] { grasp("stage: press\nsummary: {frames: 3}\n"); }),
            file + ": is the record of a press, not of a grasp");
  EXPECT_EQ(message_of<DataError>([&] { grasp(replaced(kRecord, "judged_frame: 2", "judged_frame: 3")); }),
            file + ": has no frame that was judged");
}

}  // namespace grasp_part_test
}  // namespace tacipc
