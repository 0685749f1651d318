#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/image/background/median_background.h"
#include "tests/program_test.h"

namespace tacipc {
namespace background_test {

/// A slanted plane of codes; within `radius` of the contact everything is 250.
ByteImage photograph(const BallLabel& label, int brighter) {
  ByteImage image(40, 30, 3);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c) {
        const bool touched = (x - label.x_px) * (x - label.x_px) + (y - label.y_px) * (y - label.y_px) <=
                             2.25 * label.radius_px * label.radius_px;
        image.at(x, y, c) = static_cast<std::uint8_t>(touched ? 250 : 40 + x + 2 * y + 10 * c + brighter);
      }
  return image;
}

const std::vector<BallLabel> kLabels{
    {"a.png", 8, 8, 4}, {"b.png", 30, 8, 4}, {"c.png", 8, 22, 4}, {"d.png", 30, 22, 4}};

TEST(MedianBackground, IsWhatIsBelowTheContacts) {
  std::vector<ByteImage> photographs;
  for (int i = 0; i < 4; ++i) photographs.push_back(photograph(kLabels[static_cast<std::size_t>(i)], 2 * i));
  const MedianBackground found =
      median_background(photographs, kLabels, {.contact_radii = 1.6, .least_photographs = 3});
  EXPECT_EQ(found.fewest, 3);
  EXPECT_GT(found.mean, 3.5);
  EXPECT_EQ(found.image.at(20, 15, 1), 40 + 20 + 30 + 10 + 3);  // mean of +2 and +4
  EXPECT_EQ(found.image.at(8, 8, 0), 40 + 8 + 16 + 4);          // of +2, +4, +6: the first has its contact there
  EXPECT_EQ(found.image.at(30, 22, 2), 40 + 30 + 44 + 20 + 2);  // of 0, +2, +4
}

TEST(MedianBackground, TooFewPhotographsAreSaid) {
  const std::vector<ByteImage> photographs(4, ByteImage(40, 30, 3, 9));
  EXPECT_EQ(message_of<DataError>(
                [&] { median_background(photographs, kLabels, {.contact_radii = 1.6, .least_photographs = 4}); }),
            "pixel (6, 2): only 3 of 4 photographs show no contact within 1.6 radii there, 4 are needed");
}

class BackgroundProgram : public ProgramTest {};

TEST_F(BackgroundProgram, PhotographsOfOneSizeMakeTheBackground) {
  scratch_.file("c.yaml", "contact_radii: 1.6\n");
  std::string labels;
  std::filesystem::create_directories(scratch_ / "p");
  for (const BallLabel& label : kLabels) {
    write_png(scratch_ / ("p/" + label.image), photograph(label, 0));
    labels += fmt::format("{} ({}, {}) {}\n", label.image, label.x_px, label.y_px, label.radius_px);
  }
  scratch_.file("l.txt", labels);
  const std::string command =
      fmt::format("cd '{}' && {}/background --config c.yaml --photographs p --labels l.txt --log-level error --out ",
                  (scratch_ / "").string(), TACIPC_BIN_DIR);
  ASSERT_EQ(run_command(command + "a"), 0) << said_;
  const ByteImage made = read_png(scratch_ / "a/background.png", 3);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) ASSERT_EQ(made.at(x, y, 0), 40 + x + 2 * y) << x << " " << y;
  write_png(scratch_ / "p/c.png", ByteImage(40, 31, 3, 1));
  EXPECT_EQ(run_command(command + "b"), 1);
  EXPECT_EQ(said_, "background: error: p/c.png: is 40 x 31 pixels, the first photograph has 40 x 30\n");
}

}  // namespace background_test
}  // namespace tacipc
