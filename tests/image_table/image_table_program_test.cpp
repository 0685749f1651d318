#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/image.h"
#include "tests/image_table/small_table.h"
#include "tests/program_test.h"

namespace tacipc {
namespace {

using ImageTableProgram = ProgramTest;

TEST_F(ImageTableProgram, WritesTablesAndSheetsAndNeedsTheirPictures) {
  samples_in(scratch_, "a");
  samples_in(scratch_, "b");
  write_png(scratch_ / "a/x.png", ByteImage(16, 12, 3, 90));
  scratch_.file("t.yaml", kSmallTable +
                              "link_folder: pictures\nsheets: [{name: s, alt: x, picture_px: 20, columns: "
                              "[{heading: A, folder: a}]}]\n");
  const std::string run = fmt::format(
      "cd '{}' && {}/image_table --config t.yaml --log-level error --out out --samples a/samples.csv "
      "b/samples.csv",
      (scratch_ / "").string(), TACIPC_BIN_DIR);
  EXPECT_EQ(run_command(run), 1);
  EXPECT_EQ(said_, "image_table: error: sheet s: 0 pictures below a, 0 below a\n");
  ASSERT_EQ(run_command(run + " --pictures a/x.png"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/table.md"), testing::HasSubstr("![x](pictures/s.png)"));
  EXPECT_THAT(read_file(scratch_ / "out/table.csv"), testing::HasSubstr("first,,box,psnr_ln,2,25,5,"));
  EXPECT_EQ(read_png(scratch_ / "out/pictures/s.png", 3).width, 28);
  EXPECT_THAT(read_file(scratch_ / "out/image_table.yaml"), testing::HasSubstr("summary:\n  rows: 2\n  images: 2\n"));
}

}  // namespace
}  // namespace tacipc
