// Archives and refusals; what the layouts hold is checked in Python (tests/pipeline/check_repack.py).
#include <gmock/gmock.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/sha256.h"
#include "common/format/hdf5_writer.h"
#include "stages/dataset/repack/frame_files.h"
#include "stages/dataset/repack/tar_writer.h"
#include "tests/program_test.h"
#include "tests/stages/dataset/pack/sample_files.h"

namespace tacipc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(TarWriter, TheSameFilesAreTheSameBytesAndUnpack) {
  const ScratchFolder scratch;
  const std::string deep = std::string(90, 'a') + "/" + std::string(90, 'b') + "/" + std::string(120, 'c') + ".txt";
  const auto write = [&](const std::string& name) {
    TarWriter tar(scratch / name);
    tar.add("one/frame_0000.json", "{}");
    tar.add(deep, "a name longer than the old header holds");
    tar.add("empty", "");
    tar.close();
    return read_file(scratch / name);
  };
  EXPECT_EQ(write("a.tar"), write("b.tar"));
  const std::string command = fmt::format("cd {} && tar -xf a.tar", (scratch / "").string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_file(scratch / deep), "a name longer than the old header holds");
  EXPECT_EQ(read_file(scratch / "one/frame_0000.json"), "{}");
  EXPECT_EQ(read_file(scratch / "empty"), "");
}

TEST(TarWriter, AFullDiskIsAnError) {
  TarWriter tar("/dev/full");
  const auto fill = [&] {
    for (int i = 0; i < 100; ++i) tar.add("file", std::string(1 << 16, 'x'));
    tar.close();
  };
  EXPECT_THAT(message_of<DataError>(fill), HasSubstr("/dev/full: cannot be written"));
}

TEST(FrameFiles, SmallFieldsGoToJsonAndLargeOnesApart) {
  const ScratchFolder scratch;
  {
    Hdf5Writer file(scratch / "s.h5");
    file.group("/sensors/toy");
    const auto add = [&](const std::string& path, NumberType type, const std::vector<std::size_t>& shape,
                         const std::string& letters, std::size_t count) {
      file.write("/data/a/" + path, type, shape, to_bytes(type, std::vector<double>(count, 1.0)));
      file.attribute("/data/a/" + path, "shape", letters);
    };
    add("obs/force_N", NumberType::f32, {2, 3}, "(T,3)", 6);
    add("obs/mask", NumberType::u8, {2, 4, 5}, "(T,H,W)", 40);
    add("obs/field", NumberType::f32, {2, 17}, "(T,N)", 34);
    add("sim/triangles", NumberType::i32, {2, 3}, "(F,3)", 6);
    add("variants/red/rgb", NumberType::u8, {2, 4, 5, 3}, "(T,H,W,3)", 120);
    file.attribute("/data/a", "n_frames", 2);
    file.attribute("/data/a", "sample_yaml", "motion:\n  kind: press\n");
    file.attribute("/data/a", "mu", 0.5);
    file.close();
  }
  std::vector<std::string> names;
  std::string json;
  write_frames(Hdf5Reader(scratch / "s.h5"), "a", [&](const std::string& name, std::string_view bytes) {
    names.push_back(name);
    if (name == "a/frame_0001.json") json = bytes;
  });
  EXPECT_THAT(names, ElementsAre("a/frame_0000.sample.yaml", "a/frame_0000.field.npy", "a/frame_0000.mask.png",
                                 "a/frame_0000.sim.triangles.npy", "a/frame_0000.red.rgb.png", "a/frame_0000.json",
                                 "a/frame_0001.field.npy", "a/frame_0001.mask.png", "a/frame_0001.red.rgb.png",
                                 "a/frame_0001.json"));
  EXPECT_EQ(
      json,
      "{\n  \"id\": \"a\",\n  \"frame\": 1,\n  \"obs\": {\n    \"force_N\": [1, 1, 1]\n  },\n  \"sample\": {\n    "
      "\"mu\": 0.5,\n    \"n_frames\": 2\n  }\n}\n");
}

class RepackTest : public ProgramTest {};

TEST_F(RepackTest, WhatIsNoShardIsRefused) {
  scratch_.file("c.yaml", "format: zarr\n");
  scratch_.file("no.h5", "no");
  const auto run = [&] {
    scratch_.file("no.h5.sha256", sha256_of_file(scratch_ / "no.h5") + "  no.h5\n");
    return run_command(fmt::format("{}/repack --config {} --shard {} --out {} --log-level error", TACIPC_BIN_DIR,
                                   (scratch_ / "c.yaml").string(), (scratch_ / "no.h5").string(),
                                   (scratch_ / "out").string()));
  };
  EXPECT_EQ(run(), 2);
  EXPECT_THAT(said_, HasSubstr("format: 'zarr' is not one of webdataset, univtac, folder"));
  scratch_.file("c.yaml", "format: folder\n");
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, HasSubstr("no.h5: /: is not a readable HDF5 file"));
  Hdf5Writer other(scratch_ / "no.h5");
  other.group("/something");
  other.close();
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, HasSubstr("no.h5: is not a shard of pack"));
}

TEST_F(RepackTest, ADamagedShardIsRefusedBeforeItIsRead) {
  scratch_.file("c.yaml", "format: folder\n");
  {
    Hdf5Writer file(scratch_ / "s.h5");
    file.attribute("/", "shard", "s");
    file.group("/sensors/toy");
    file.write("/data/a/obs/force_N", NumberType::f32, {1, 3}, to_bytes(NumberType::f32, {1.0, 2.0, 3.0}));
    file.attribute("/data/a/obs/force_N", "shape", "(T,3)");
    file.attribute("/data/a", "n_frames", 1);
    file.attribute("/data/a", "sample_yaml", "motion: here\n");
    file.close();
  }
  const std::string bytes = read_file(scratch_ / "s.h5");
  const auto run = [&](const std::string& with) {
    scratch_.file("s.h5", with);
    return run_command(fmt::format("{}/repack --config {} --shard {} --out {} --log-level error", TACIPC_BIN_DIR,
                                   (scratch_ / "c.yaml").string(), (scratch_ / "s.h5").string(),
                                   (scratch_ / "out").string()));
  };
  EXPECT_EQ(run(bytes), 1);
  EXPECT_THAT(said_, HasSubstr("s.h5: there is no s.h5.sha256 beside it"));
  scratch_.file("s.h5.sha256", sha256(bytes) + "  s.h5\n");
  ASSERT_EQ(run(bytes), 0) << said_;
  // The heap that texts stand in: of some bits here HDF5 crashes, of others it reads another text.
  const std::size_t heap = bytes.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  for (std::size_t at = heap; at < std::min(heap + 64, bytes.size()); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    ASSERT_EQ(run(damaged), 1) << at << ": " << said_;
    ASSERT_THAT(said_, HasSubstr("s.h5: is damaged, or not the file that s.h5.sha256 is of")) << at;
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
  }
}

}  // namespace
}  // namespace tacipc
