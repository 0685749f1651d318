#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/base/files.h"
#include "common/image/image.h"
#include "tests/program_test.h"

namespace tacipc {
namespace {

// What it reads is tested with the network's training, in tests/stages/image/depthnet.
class Predict : public ProgramTest {
 protected:
  void SetUp() override {
    write_file(scratch_ / "model.onnx", "not a network");
    for (const char* name : {"a.png", "background.png"}) write_png(scratch_ / name, ByteImage(8, 6, 3));
  }
  int predict(const std::string& flags) {
    return run_command(fmt::format("cd '{}' && '{}/predict' --out out --model model.onnx {}", (scratch_ / "").string(),
                                   TACIPC_BIN_DIR, flags));
  }
};

TEST_F(Predict, RefusesWhatIsNoNetwork) {
  EXPECT_EQ(predict("--images a.png --background background.png"), 1);
  EXPECT_THAT(said_, testing::HasSubstr("model.onnx: is not a network that depthnet wrote"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/predict.yaml"));
}

TEST_F(Predict, RefusesFlagsThatDoNotGoTogether) {
  EXPECT_EQ(predict("--images a.png"), 2);
  EXPECT_THAT(said_, testing::HasSubstr("--background"));
  EXPECT_EQ(predict("--images a.png a.png --background background.png"), 2);
  EXPECT_THAT(said_, testing::HasSubstr("two are called a"));
  write_exr(scratch_ / "map.exr", FloatImage(8, 6, 1), {"Y"});
  EXPECT_EQ(predict("--images a.png --background background.png --truth map.exr"), 2);
  EXPECT_THAT(said_, testing::HasSubstr("--truth: needs --rest"));
}

}  // namespace
}  // namespace tacipc
