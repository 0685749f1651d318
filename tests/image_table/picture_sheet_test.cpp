#include "stages/image_table/picture_sheet.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

fs::path grey(const ScratchFolder& scratch, const std::string& name, std::uint8_t code) {
  fs::create_directories((scratch / name).parent_path());
  write_png(scratch / name, ByteImage(40, 30, 3, code));
  return scratch / name;
}

SheetConfig two_columns() {
  return {.name = "s", .alt = "", .crop_px = {}, .picture_px = 20, .columns = {{"A", "real"}, {"B", "ours"}}};
}

TEST(PictureSheet, ColumnsAreFoldersRowsTheOrderGiven) {
  const ScratchFolder scratch;
  const auto r1 = grey(scratch, "real/x.png", 200), r2 = grey(scratch, "real/y.png", 150),
             o1 = grey(scratch, "ours/ball/x.png", 100), o2 = grey(scratch, "ours/ball/y.png", 50),
             other = grey(scratch, "other/x.png", 0);
  const auto columns = pictures_of_columns({o1, r1, o2, r2, other}, two_columns());
  EXPECT_THAT(columns[0], testing::ElementsAre(r1, r2));
  EXPECT_THAT(columns[1], testing::ElementsAre(o1, o2));
  // 4 between, 18 of a heading, then twice 18 of a name and 15 of a picture at half size.
  const ByteImage out = picture_sheet(columns, two_columns());
  EXPECT_EQ(out.width, 4 + 2 * 24);
  EXPECT_EQ(out.height, 4 + 18 + 2 * (18 + 15 + 4));
  EXPECT_EQ(out.at(14, 47, 0), 200);
  EXPECT_EQ(out.at(38, 47, 1), 100);
  EXPECT_EQ(out.at(14, 84, 2), 150);
  EXPECT_EQ(out.at(38, 84, 0), 50);
  EXPECT_EQ(out.at(25, 47, 0), 255);
  int ink = 0;
  for (int y = 4; y < 22; ++y)
    for (int x = 4; x < 24; ++x) ink += out.at(x, y, 0) < 128;
  EXPECT_GT(ink, 5) << "no heading";
}

TEST(PictureSheet, CropsBeforeItScales) {
  const ScratchFolder scratch;
  const auto path = grey(scratch, "real/x.png", 10);
  ByteImage image = read_png(path, 3);
  for (int y = 10; y < 20; ++y)
    for (int x = 5; x < 15; ++x) image.at(x, y, 1) = 220;
  write_png(path, image);
  SheetConfig config = two_columns();
  config.columns.pop_back();
  config.crop_px = {5, 10, 10, 10};
  const ByteImage out = picture_sheet({{path}}, config);
  EXPECT_EQ(out.height, 4 + 18 + 18 + 20 + 4);
  for (const int x : {4, 23})
    for (const int y : {40, 59}) EXPECT_EQ(out.at(x, y, 1), 220) << x << ' ' << y;
  config.crop_px = {5, 10, 36, 10};
  EXPECT_EQ(message_of<DataError>([&] { picture_sheet({{path}}, config); }),
            path.string() + ": is 40 x 30 pixels, crop_px reaches to 41 x 20");
}

TEST(PictureSheet, RefusesColumnsThatDoNotMatch) {
  const ScratchFolder scratch;
  const auto r1 = grey(scratch, "real/x.png", 1), deeper = grey(scratch, "real/ours/y.png", 1);
  EXPECT_EQ(message_of<DataError>([&] { pictures_of_columns({r1}, two_columns()); }),
            "sheet s: 1 pictures below real, 0 below ours");
  EXPECT_THAT(pictures_of_columns({r1, deeper}, two_columns())[1], testing::ElementsAre(deeper));
}

}  // namespace
}  // namespace tacipc
