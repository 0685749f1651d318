#include "common/sample/render_folder.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace render_folder_test {

TEST(RenderFolder, FramesHaveFourDigitsOrMore) {
  EXPECT_EQ(frame_name(5), "frame_0005");
  EXPECT_EQ(frame_folder(12345), "frame_12345/");
  EXPECT_EQ(frame_folder(7, "red"), "frame_0007/red/");
  EXPECT_EQ(frame_number("frame_0012"), 12u);
  for (const char* name : {"frame_", "frame_1x", "frames_1", "frame_-1", ""}) EXPECT_FALSE(frame_number(name)) << name;
}

TEST(RenderFolder, FramesAscend) {
  const ScratchFolder folder;
  for (const char* name : {"frame_0010", "frame_0002", "other"}) std::filesystem::create_directories(folder / name);
  folder.file("frame_0001", "a file");
  EXPECT_THAT(frames_in(folder / ""), ::testing::ElementsAre(2u, 10u));
}

TEST(RenderFolder, CodesGoBackToWhatTheyMean) {
  for (const ContactState state : {ContactState::none, ContactState::stick, ContactState::slip}) {
    EXPECT_EQ(state_of(stick_slip_code(state)), state);
    EXPECT_EQ(touches(contact_code(state)), state != ContactState::none);
  }
  for (int k = 0; k < 5; ++k) EXPECT_EQ(segment_of(segment_code(static_cast<Segment>(k))), static_cast<Segment>(k));
  EXPECT_EQ(stick_slip_code(ContactState::slip), 254);
  EXPECT_EQ(segment_code(Segment::marker), 180);
  EXPECT_EQ(message_of<DataError>([] { state_of(128); }), "stick_slip.png: 128 is not one of its codes");
  EXPECT_EQ(message_of<DataError>([] { segment_of(300); }), "segment.png: 300 is not one of its codes");
  EXPECT_EQ(message_of<DataError>([] { touches(1); }), "contact.png: 1 is not one of its codes");
}

TEST(RenderFolder, FilesGoIntoTheirFrame) {
  const ScratchFolder scratch;
  std::vector<std::string> words{"render", "--out", (scratch / "out").string(), "--log-level", "off"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  const StageSpec spec{.name = "render", .summary = "Writes a frame.", .inputs = {}};
  const MarkerPixels px{{1.5, 2.5}, {std::nan(""), std::nan("")}};
  const FloatImage normal(2, 1, 3, 0.1234567f), traction(2, 1, 3, -297001.0f);
  const auto write = [&](Stage& stage) {
    write_frame(stage, frame_folder(4), FrameFile::depth, FloatImage(2, 1, 1, 12.3456789e-3f), 0, Digits::of_datasets);
    write_frame(stage, frame_folder(4), FrameFile::normal, normal, 0, Digits::of_datasets);
    write_frame(stage, frame_folder(4), FrameFile::traction, traction, 0, Digits::of_datasets);
    write_frame(stage, frame_folder(4), FrameFile::linear, normal, 0, Digits::of_datasets);
    write_frame(stage, frame_folder(3), FrameFile::depth, FloatImage(2, 1, 1, 0.5f));
    write_frame(stage, frame_folder(3), FrameFile::basis, FloatImage(2, 1, 3, 0.25f), 1);
    write_frame(stage, frame_folder(3, "red"), FrameFile::tactile, ByteImage(2, 1, 3, 9));
    write_marker_px(stage, frame_folder(3), px);
  };
  ASSERT_EQ(run_stage(spec, static_cast<int>(argv.size()), argv.data(), write), 0);
  EXPECT_EQ(read_exr(frame_path(scratch / "out", 3, FrameFile::depth), {"Y"}).pixels, (std::vector<float>(2, 0.5f)));
  // In a dataset numbers are multiples of the field's step: 2^-25 m, 2^-12, 16 Pa; radiance stays.
  const auto packed = [&](FrameFile file) {
    return double{read_exr(frame_path(scratch / "out", 4, file), field_of(file).channels).pixels[0]};
  };
  EXPECT_EQ(packed(FrameFile::depth), std::ldexp(std::round(std::ldexp(12.3456789e-3, 25)), -25));
  EXPECT_EQ(packed(FrameFile::normal), std::ldexp(std::round(std::ldexp(0.1234567, 12)), -12));
  EXPECT_EQ(packed(FrameFile::traction), -297008.0);
  EXPECT_EQ(packed(FrameFile::linear), double{0.1234567f});
  EXPECT_EQ(read_exr(scratch / "out/frame_0003/basis_01.exr", {"R", "G", "B"}).pixels.size(), 6u);
  EXPECT_EQ(read_png(scratch / "out/frame_0003/red/tactile.png", 3).pixels, std::vector<std::uint8_t>(6, 9));
  const MarkerPixels back = read_marker_px(scratch / "out/frame_0003/marker_px.npy");
  EXPECT_EQ(back.row(0), px.row(0));
  EXPECT_TRUE(std::isnan(back(1, 0)) && std::isnan(back(1, 1)));
}

}  // namespace render_folder_test
}  // namespace tacipc
