#include "stages/dataset/plan/choices.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <chrono>

#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace choices_test {

namespace fs = std::filesystem;
using std::chrono::hours;

class Choices : public ::testing::Test {
 protected:
  void choose(const fs::path& file, const std::string& role = "press") {
    write_choices({{"motion-a", {{role, file}}}}, scratch_ / "choices");
  }
  /// As if everything so far had been hours ago.
  void age(int count) { fs::last_write_time(choice_, fs::last_write_time(choice_) - hours(count)); }

  ScratchFolder scratch_;
  const fs::path choice_ = scratch_ / "choices/motion-a";
};

TEST_F(Choices, OtherContentsOfAFileCountFromTheirChange) {
  const fs::path file = scratch_.file("a.yaml", "x: 1");
  choose(file);
  age(2);
  const auto old = fs::last_write_time(choice_);
  choose(file);
  EXPECT_EQ(fs::last_write_time(choice_), old);
  scratch_.file("a.yaml", "x: 2");
  const auto changed = fs::last_write_time(file);
  fs::last_write_time(file, changed - hours(9));  // as cp -p leaves it
  choose(file);
  EXPECT_GE(fs::last_write_time(choice_), changed);
  EXPECT_LT(fs::last_write_time(choice_), changed + std::chrono::minutes(1));
}

TEST_F(Choices, AnotherFileCountsFromNowHoweverOldItIs) {
  const fs::path a = scratch_.file("a.yaml", "x: 1"), b = scratch_.file("b.yaml", "x: 2");
  choose(a);
  age(2);
  const auto before = fs::last_write_time(a);
  choose(b);
  EXPECT_GE(fs::last_write_time(choice_), before);
  age(2);
  choose(a);
  EXPECT_GE(fs::last_write_time(choice_), before);
  age(2);
  choose(a, "pattern");
  EXPECT_GE(fs::last_write_time(choice_), before);
}

TEST_F(Choices, TheSameContentsElsewhereAreTheSame) {
  choose(scratch_.file("a.yaml", "x: 1"));
  age(2);
  const auto old = fs::last_write_time(choice_);
  choose(scratch_.file("moved.yaml", "x: 1"));
  EXPECT_EQ(fs::last_write_time(choice_), old);
  EXPECT_THAT(read_file(choice_), testing::EndsWith("/moved.yaml\n"));
}

TEST_F(Choices, SensorsAndPhotographsOfVariantsBelongToRender) {
  DatasetConfig config;
  config.sensors = {{.name = "mctac", .mesh = "tiny", .sensor = "s.yaml", .mesh_config = "t.yaml"}};
  const std::string sensor = TACIPC_SOURCE_DIR "/configs/sensors/mctac.yaml";
  config.render = scratch_.file(
      "render.yaml",
      fmt::format("variants:\n  - {{name: a, sensor: {}}}\n  - {{name: b, reference_image: b.png}}\n", sensor));
  std::vector<fs::path> files;
  for (const Choice& choice : choices_of(config, {Sensor{}}))
    if (choice.name == "render-mctac-tiny")
      for (const ChosenFile& chosen : choice.files) files.push_back(chosen.file);
  EXPECT_THAT(files, testing::IsSupersetOf({config.render, fs::path(sensor), scratch_ / "b.png"}));
}

}  // namespace choices_test
}  // namespace tacipc
