#include "stages/dataset/report/view/scene_pictures.h"

#include <gmock/gmock.h>

#include "stages/dataset/report/scene_part.h"
#include "stages/dataset/report/view/scene_view.h"
#include "tests/stages/dataset/report/robot_scene.h"

namespace tacipc {
namespace scene_pictures_test {

using ::testing::ElementsAre;

std::vector<std::string> words_of(const SceneView& view, std::optional<int> contact) {
  std::vector<std::string> words;
  for (const PicturedInstant& instant : pictured_instants(view, contact))
    words.push_back(std::to_string(view.frames[instant.shown]) + instant.what);
  return words;
}

TEST(ScenePictures, StartFirstContactAndEndAreAmongTheInstants) {
  SceneView view;
  for (int frame = 0; frame <= 100; ++frame) view.frames.push_back(frame);
  EXPECT_THAT(words_of(view, 40), ElementsAre("0start", "40first contact", "60", "80", "100end"));
  EXPECT_THAT(words_of(view, std::nullopt), ElementsAre("0start", "25", "50", "75", "100end"));
  EXPECT_THAT(words_of(view, 0), ElementsAre("0start", "25", "50", "75", "100end"));
  view.frames = {0, 50, 100};  // some of many
  EXPECT_THAT(words_of(view, 40), ElementsAre("0start", "50first contact", "100end"));
  view.frames = {0};
  EXPECT_THAT(words_of(view, std::nullopt), ElementsAre("0start"));
}

class RobotPicturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_robot_scene(scratch_);
    const SceneFolder scene = read_scene_folder(scratch_ / "bodies");
    view_ = *read_scene_view(scene, scratch_ / "bodies");
    view_.objects.clear();  // a metre large beside a gel of 10 mm
    add_robot(view_, read_robot_folder(scratch_ / "bodies/robot"), scratch_ / "bodies/robot", scene);
  }
  ScratchFolder scratch_;
  SceneView view_;
};

TEST_F(RobotPicturesTest, EveryInstantIsAPictureWithTheGelInIt) {
  const std::vector<Instant> frames{{0.0, "1 grip"}, {0.01, "2 move"}};
  const ByteImage strip = scene_pictures(view_, pictured_instants(view_, 1), frames, 120, 100);
  EXPECT_EQ(strip.width, 2 * 120 + 8);
  EXPECT_EQ(strip.height, 54 + 100);
  for (const int left : {0, 128}) {
    int blue = 0;
    for (int y = 54; y < strip.height; ++y) {
      for (int x = left; x < left + 120; ++x) blue += strip.at(x, y, 2) > strip.at(x, y, 0) + 40 ? 1 : 0;
    }
    EXPECT_GT(blue, 20) << left;
  }
}

TEST_F(RobotPicturesTest, OneLooksAcrossAGelFromAbove) {
  const Viewpoint down = scene_viewpoint(view_, 1.0);
  EXPECT_LT(down.back.y(), -0.8);
  EXPECT_GT(down.back.z(), 0.1);
  for (ViewedFront& front : view_.gels[0].frames)
    front.world_from_gel.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // looks along y
  const Viewpoint sideways = scene_viewpoint(view_, 1.0);
  EXPECT_GT(std::abs(sideways.back.x()), 0.8);
}

TEST_F(RobotPicturesTest, LargePartsOfTheRobotDoNotTakeTheRoom) {
  const double distance = scene_viewpoint(view_, 1.0).distance_m;
  ViewedObject& bridge = view_.objects.emplace_back(view_.objects.back());
  bridge.mesh.positions *= 1000.0;
  EXPECT_EQ(scene_viewpoint(view_, 1.0).distance_m, distance);
}

}  // namespace scene_pictures_test
}  // namespace tacipc
