#include "stages/study/tabulate/picture_sheet.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace picture_sheet_test {

namespace fs = std::filesystem;

fs::path grey(const ScratchFolder& scratch, const std::string& name, std::uint8_t code) {
  fs::create_directories((scratch / name).parent_path());
  write_png(scratch / name, ByteImage(40, 30, 3, code));
  return scratch / name;
}

SheetConfig two_columns() {
  return {.name = "s", .alt = "", .crop_px = {}, .picture_px = 20, .columns = {{"A", "real"}, {"B", "ours"}}};
}

TEST(PictureSheet, ColumnsAreTheirMethodsWhateverFoldersPicturesLieIn) {
  const ScratchFolder scratch;
  const auto r1 = grey(scratch, "ours/real/out/x.png", 200), r2 = grey(scratch, "ours/y.png", 150),
             o1 = grey(scratch, "real/ball/x.png", 100), o2 = grey(scratch, "ours/real/ball/y.png", 50),
             other = grey(scratch, "other/real/x.png", 0);
  const auto columns =
      pictures_of_columns({{"ours", o1}, {"real", r1}, {"ours", o2}, {"real", r2}, {"other", other}}, two_columns());
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
  const auto path = grey(scratch, "real/ours/x.png", 1);
  EXPECT_EQ(message_of<DataError>([&] {
              pictures_of_columns({{"real", path}}, two_columns());
            }),
            "sheet s: 1 pictures of real, 0 of ours");
  EXPECT_EQ(message_of<DataError>([&] { pictures_of_columns({}, two_columns()); }),
            "sheet s: 0 pictures of real, 0 of real");
}

TEST(DifferenceSheet, ShowsPhotographOursDifferenceAndRival) {
  const ComparedPicture row{.real = ByteImage(100, 80, 3, 100),
                            .ours = ByteImage(100, 80, 3, 90),
                            .rival = ByteImage(100, 80, 3, 40),
                            .box_px = {30, 30, 20, 10}};
  ComparedPicture corner = row;
  corner.box_px = {90, 0, 10, 10};
  const ByteImage out = difference_sheet({row, corner});
  EXPECT_EQ(out.width, 4 + 4 * 64);    // 20 + 2 · 20 wide, 4 between
  EXPECT_EQ(out.height, 4 + 54 + 34);  // 10 + 2 · 20, then 10 + 20 high
  EXPECT_EQ(out.at(0, 0, 0), 255);
  EXPECT_EQ(out.at(10, 10, 1), 100);
  EXPECT_EQ(out.at(74, 10, 1), 90);
  EXPECT_EQ(out.at(138, 10, 1), 108);  // 128 + 2 (90 − 100)
  EXPECT_EQ(out.at(202, 10, 1), 40);
  EXPECT_EQ(out.at(5, 60, 1), 100);
  EXPECT_EQ(out.at(35, 60, 1), 255);  // the second row is only 30 wide
}

}  // namespace picture_sheet_test
}  // namespace tacipc
