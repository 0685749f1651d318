#include "stages/dataset/report/scene_index.h"

#include <gmock/gmock.h>

#include "tests/program_test.h"
#include "tests/stages/dataset/report/robot_scene.h"

namespace tacipc {
namespace scene_index_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SceneIndexTest : public ProgramTest {
 protected:
  int run(const std::string& flags) {
    return run_command("cd '" + (scratch_ / "").string() + "' && " + TACIPC_BIN_DIR + "/report " + flags);
  }
};

TEST_F(SceneIndexTest, EverySceneHasPicturesNumbersAndALinkToItsPage) {
  write_robot_scene(scratch_);
  std::filesystem::copy(scratch_ / "bodies", scratch_ / "plain", std::filesystem::copy_options::recursive);
  std::filesystem::remove_all(scratch_ / "plain/robot");
  scratch_.file("bodies/report/index.html", "");
  ASSERT_EQ(run("--scene bodies --scene plain --title 'Two & more' --out report"), 0) << said_;
  const std::string html = read_file(scratch_ / "report/index.html");
  EXPECT_THAT(html, HasSubstr("<h1>Two &amp; more</h1>"));
  EXPECT_THAT(html, HasSubstr("<h3><a href=\"../bodies/report/index.html\">bodies</a></h3>"));
  EXPECT_THAT(html, HasSubstr("<h3>plain</h3>"));  // has no page yet
  EXPECT_THAT(html, AllOf(HasSubstr("mass_g = 50.0"), HasSubstr("<b>2.00 N</b>largest force into a gel"),
                          HasSubstr("<b>3</b>windows, all converged")));
  EXPECT_THAT(html.substr(html.find("<h3>plain")), Not(HasSubstr("converged")));
  for (const char* picture : {"scene-1.png", "scene-2.png"}) {
    EXPECT_THAT(html, HasSubstr(std::string("<img src=\"") + picture));
    EXPECT_TRUE(std::filesystem::exists(scratch_ / "report" / picture));
  }
  EXPECT_THAT(read_file(scratch_ / "report/report.yaml"), HasSubstr("summary:\n  scenes: 2\n  samples: 2\n"));
}

TEST_F(SceneIndexTest, ASceneWithoutItsMeshesIsListedWithoutPictures) {
  write_robot_scene(scratch_);
  scratch_.file("object.ply", "another");
  ASSERT_EQ(run("--scene bodies --scene bodies --out report"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "report/index.html"), Not(HasSubstr("scene-1.png")));
}

TEST_F(SceneIndexTest, AFolderThatIsNoSceneIsRefused) {
  write_robot_scene(scratch_);
  std::filesystem::create_directories(scratch_ / "empty");
  EXPECT_EQ(run("--scene bodies --scene empty --out report"), 1);
  EXPECT_THAT(said_, HasSubstr("has no press.yaml"));
  EXPECT_EQ(run("--scene bodies --grasp bodies --out report"), 2);
}

}  // namespace scene_index_test
}  // namespace tacipc
