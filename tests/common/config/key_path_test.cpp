#include "common/config/key_path.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace key_path_test {

TEST(KeyPath, FindsKeysThatHoldPoints) {
  const Value root = Value::Map{{"outputs", Value::Map{{"frame_0001", "a"}, {"frame_0001/x.png", "b"}, {"x.y", "c"}}}};
  const auto at = [&](const std::string& path) { return std::get<std::string>(follow(root, path).at->data()); };
  EXPECT_EQ(at("outputs.frame_0001"), "a");
  EXPECT_EQ(at("outputs.frame_0001/x.png"), "b");
  EXPECT_EQ(at("outputs.x.y"), "c");
  EXPECT_EQ(follow(root, "outputs.x.z").rest, "x.z");
  EXPECT_EQ(to_text(follow(root, "outputs.x.y").steps), "outputs.x.y");
}

}  // namespace key_path_test
}  // namespace tacipc
