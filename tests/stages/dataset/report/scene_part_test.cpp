#include "stages/dataset/report/scene_part.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/stages/gel/export/pressed_cube.h"

namespace tacipc {
namespace scene_part_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class ScenePartTest : public ::testing::Test {
 protected:
  void SetUp() override { write_pressed_bodies(scratch_); }
  ScratchFolder scratch_;
};

TEST_F(ScenePartTest, ThePageNamesBodiesAndThePairsThatPush) {
  SceneReport scene = read_scene(scratch_ / "bodies");
  const std::string html = scene_words(scene).first;
  EXPECT_THAT(html, HasSubstr("<b>pad</b> (gel), <b>ball</b> (soft), <b>peg</b> (rigid), <b>wall</b> (fixed)"));
  EXPECT_THAT(html, HasSubstr(curve_key(1) + "pad and peg, " + curve_key(2) + "peg and wall</figcaption>"));
  EXPECT_THAT(html, Not(HasSubstr("pad and ball")));
  EXPECT_THAT(html, HasSubstr("height of " + curve_key(1) + "peg; turn of " + curve_key(2) + "peg"));
  EXPECT_THAT(html, HasSubstr("<b>Along the front</b> since they touch: " + curve_key(1) + "peg on pad."));
  EXPECT_THAT(html, HasSubstr("<title>phase 1</title>"));
  EXPECT_THAT(html, Not(HasSubstr("view.html")));
  scene.has_view = true;
  EXPECT_THAT(scene_words(scene).first, HasSubstr("<a href=\"view.html#scene\">"));
}

TEST_F(ScenePartTest, EachFrameSaysWhoPushesWhom) {
  SceneView view;
  view.frames = {0, 1};
  EXPECT_THAT(scene_texts(read_scene(scratch_ / "bodies"), view),
              ElementsAre("frame 0 of 1 · reference · 0 s · pad and peg 0 N · peg and wall 0 N",
                          "frame 1 of 1 · phase 1 · 0.0100 s · pad and peg 2.00 N · peg and wall 1.00 N"));
}

TEST_F(ScenePartTest, AnotherRecordIsRefused) {
  scratch_.file("bodies/press.yaml", "stage: press\nsummary: {outcome: lifted}\n");
  EXPECT_THAT(message_of<DataError>([&] { read_scene(scratch_ / "bodies"); }),
              HasSubstr("is not the record of a scene"));
  EXPECT_THAT(message_of<DataError>([&] { read_scene(scratch_ / ""); }), HasSubstr("has no press.yaml"));
}

}  // namespace scene_part_test
}  // namespace tacipc
