#include "stages/dataset/report/contact_sheet.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sample_folder.h"

namespace tacipc {
namespace contact_sheet_test {

namespace fs = std::filesystem;

TEST(SheetLayout, OneIsLargeManyStayWithinTheWidth) {
  for (int count = 1; count <= 60; ++count) {
    const SheetLayout layout = SheetLayout::for_samples(count);
    SCOPED_TRACE(count);
    EXPECT_LE(layout.width, 2400);
    EXPECT_GE(layout.width, 1400);
    EXPECT_GE(layout.columns * layout.rows, count);
    EXPECT_LT(layout.columns * (layout.rows - 1), count);
    EXPECT_EQ(layout.picture_width * 3, layout.picture_height * 4);
    EXPECT_LE(layout.cell_x(count - 1) + layout.cell_width + SheetLayout::kMargin, layout.width);
    EXPECT_EQ(layout.cell_y(count - 1) + layout.cell_height + SheetLayout::kMargin, layout.height);
  }
  EXPECT_EQ(SheetLayout::for_samples(1).columns, 1);
  EXPECT_EQ(SheetLayout::for_samples(4).columns, 2);
  EXPECT_EQ(SheetLayout::for_samples(19).rows, 7);
}

class ContactSheetTest : public ::testing::Test {
 protected:
  ScratchFolder scratch_;
  fs::path folder_ = write_sample(scratch_ / "");
};

/// Number of pixels of this colour inside a rectangle.
int count_color(const ByteImage& image, const std::array<int, 4>& box, const std::array<int, 3>& color) {
  int count = 0;
  for (int y = box[1]; y < box[1] + box[3]; ++y) {
    for (int x = box[0]; x < box[0] + box[2]; ++x)
      count += image.at(x, y, 0) == color[0] && image.at(x, y, 1) == color[1] && image.at(x, y, 2) == color[2];
  }
  return count;
}

TEST_F(ContactSheetTest, ShowsTheThreePicturesSideBySide) {
  const std::vector<SampleReport> samples(2, read_sample(folder_));
  const ByteImage sheet = contact_sheet("Title", samples);
  const SheetLayout layout = SheetLayout::for_samples(2);
  EXPECT_EQ(sheet.width, layout.width);
  EXPECT_EQ(sheet.height, layout.height);
  const int area = layout.picture_width * layout.picture_height;
  for (int i = 0; i < 2; ++i) {
    const std::array<int, 4> cell{layout.cell_x(i), layout.cell_y(i), layout.cell_width, layout.cell_height};
    for (const int red : {200, 120, 60}) EXPECT_EQ(count_color(sheet, cell, {red, 40, 40}), area) << i << ' ' << red;
  }
}

TEST_F(ContactSheetTest, KeepsTheProportionsOfOtherPictures) {
  write_flat_png(folder_ / "render/frame_0002/tactile.png", 30, 60, 200);
  const ByteImage sheet = contact_sheet("Title", {read_sample(folder_)});
  const SheetLayout layout = SheetLayout::for_samples(1);
  EXPECT_EQ(count_color(sheet, {0, 0, sheet.width, sheet.height}, {200, 40, 40}),
            layout.picture_height * layout.picture_height / 2);
}

TEST_F(ContactSheetTest, VerdictsAreGreenOrRed) {
  SampleReport sample = read_sample(folder_);
  const ByteImage passed = contact_sheet("Title", {sample});
  sample.failure = "press: frame 2: no convergence " + std::string(500, 'x');
  sample.images.reset();
  const ByteImage failed = contact_sheet("Title", {sample});
  const std::array<int, 4> all{0, 0, passed.width, passed.height};
  EXPECT_GT(count_color(passed, all, {21, 112, 60}), 20);
  EXPECT_EQ(count_color(passed, all, {163, 35, 27}), 0);
  EXPECT_EQ(count_color(failed, all, {21, 112, 60}), 0);
  EXPECT_GT(count_color(failed, all, {163, 35, 27}), 100);
}

TEST_F(ContactSheetTest, LongAndForeignNamesStayInsideTheirCell) {
  SampleReport sample = read_sample(folder_);
  sample.name = "\xe6\x98\x9f\xc3\xa4 " + std::string(300, 'W');
  const ByteImage sheet = contact_sheet(std::string(500, 'T'), {sample});
  const SheetLayout layout = SheetLayout::for_samples(1);
  const std::array<int, 4> right{layout.width - SheetLayout::kMargin + 1, 0, SheetLayout::kMargin - 1, layout.height};
  EXPECT_EQ(count_color(sheet, right, {243, 244, 247}), right[2] * right[3]);
}

TEST_F(ContactSheetTest, APictureThatIsNoneIsAnError) {
  const SampleReport sample = read_sample(folder_);
  write_file(folder_ / "render/frame_0002/normal.png", "no picture");
  EXPECT_NE(message_of<DataError>([&] { contact_sheet("Title", {sample}); }).find("normal.png"), std::string::npos);
}

}  // namespace contact_sheet_test
}  // namespace tacipc
