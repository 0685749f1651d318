// Archives and refusals; what the layouts hold is checked in Python (tests/pipeline/check_repack.py).
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include "common/base/error.h"
#include "common/base/sha256.h"
#include "common/format/hdf5_writer.h"
#include "stages/dataset/repack/frame_archives.h"
#include "stages/dataset/repack/lerobot.h"
#include "stages/dataset/repack/univtac.h"
#include "tests/program_test.h"
#include "tests/stages/dataset/pack/sample_files.h"

namespace tacipc {
namespace repack_test {

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

/// One sample "a.b" of a toy sensor in two frames; \param more is written into it.
std::filesystem::path two_frames(const ScratchFolder& scratch, const std::string& name,
                                 const std::function<void(Hdf5Writer&)>& more) {
  std::filesystem::path path = scratch / (name + ".h5");
  Hdf5Writer file(path);
  file.group("/sensors/toy");
  file.group("/data/a.b/obs");
  for (const auto& [key, value] : Value::Map{{"sensor_id", "toy"},
                                             {"n_frames", 2},
                                             {"sample_yaml", "motion: press"},
                                             {"path_csv", "0,0,0\n"},
                                             {"mu", 0.0},
                                             {"limit_balance", 0.5},
                                             {"reason", "weight"}})
    file.attribute("/data/a.b", key, value);
  more(file);
  file.close();
  return path;
}

void add_field(Hdf5Writer& file, const std::string& path, NumberType type, const std::vector<std::size_t>& shape,
               const std::string& letters, double value = 1.0) {
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  file.write("/data/a.b/" + path, type, shape, to_bytes(type, std::vector<double>(count, value)));
  file.attribute("/data/a.b/" + path, "shape", letters);
}

TEST(SampleFiles, FramesHaveEqualFilesAndTheRestIsTheSamples) {
  const ScratchFolder scratch;
  const auto path = two_frames(scratch, "s", [](Hdf5Writer& file) {
    add_field(file, "obs/force_N", NumberType::f32, {2, 3}, "(T,3)", 0.0);
    add_field(file, "obs/phase", NumberType::u8, {2}, "(T)");
    add_field(file, "obs/mask", NumberType::u8, {2, 4, 5}, "(T,H,W)");
    add_field(file, "obs/Field_N", NumberType::f32, {2, 17}, "(T,N)");
    add_field(file, "check/gap_mm", NumberType::f32, {2}, "(T)", std::numeric_limits<double>::quiet_NaN());
    file.attribute("/data/a.b/check/gap_mm", "nan", "where nothing is near");
    add_field(file, "sim/triangles", NumberType::i32, {2, 3}, "(F,3)");
    add_field(file, "ensemble/press_force_N", NumberType::f32, {2}, "(T)");
    add_field(file, "variants/red/rgb", NumberType::u8, {2, 4, 5, 3}, "(T,H,W,3)");
  });
  const Hdf5Reader shard(path);
  const SampleFiles sample(shard, "a.b");
  EXPECT_EQ(sample.kind(), "toy");
  std::map<std::string, std::vector<std::string>> names;
  std::map<std::string, std::string> json;
  const TakeFile take = [&](const std::string& of, const std::string& name, std::string_view bytes) {
    names[of].push_back(name);
    if (name == "json") json[of] = bytes;
  };
  sample.write_frames(take);
  sample.write_sample(take);
  EXPECT_THAT(names["frame_0000"], ElementsAre("gap_mm.npy", "field_n.npy", "mask.png", "red.rgb.png", "json"));
  EXPECT_EQ(names["frame_0001"], names["frame_0000"]);
  EXPECT_THAT(names[""],
              ElementsAre("path.csv", "sample.yaml", "ensemble.press_force_n.npy", "sim.triangles.npy", "json"));
  EXPECT_EQ(json["frame_0001"],
            "{\n  \"id\": \"a.b\",\n  \"frame\": 1,\n  \"obs\": {\n    \"force_N\": [0.0, 0.0, 0.0],\n    \"phase\": "
            "1\n  },\n"
            "  \"sample\": {\n    \"mu\": 0.0,\n    \"n_frames\": 2,\n    \"sensor_id\": \"toy\"\n  }\n}\n");
  EXPECT_THAT(json[""],
              HasSubstr("\"limit_balance\": 0.5,\n    \"mu\": 0.0,\n    \"n_frames\": 2,\n    \"reason\": \"weight\""));
}

TEST(SampleFiles, NamesThatDifferInCaseAloneAreRefused) {
  const ScratchFolder scratch;
  const auto path = two_frames(scratch, "s", [](Hdf5Writer& file) {
    add_field(file, "obs/field_n", NumberType::f32, {2, 17}, "(T,N)");
    add_field(file, "obs/field_N", NumberType::f32, {2, 17}, "(T,N)");
  });
  const Hdf5Reader shard(path);
  EXPECT_EQ(message_of<DataError>([&] { SampleFiles(shard, "a.b"); }),
            "a.b: two fields differ in case alone: field_n.npy");
}

/// Message when two samples go into archives, empty if there is none.
std::string archive_both(const ScratchFolder& scratch, const std::filesystem::path& one,
                         const std::filesystem::path& other) {
  const Hdf5Reader first(one), second(other);
  FrameArchives archives("train-0", [&](const std::string& name) {
    std::filesystem::create_directories((scratch / name).parent_path());
    return scratch / name;
  });
  return message_of<DataError>([&] {
    archives.add(SampleFiles(first, "a.b"));
    archives.add(SampleFiles(second, "a.b"));
    archives.close();
  });
}

TEST(FrameArchives, SamplesOfOneKindMustHaveTheSameFiles) {
  const ScratchFolder scratch;
  const auto with = [&](const std::string& name, NumberType type, const std::vector<std::size_t>& shape, bool free) {
    return two_frames(scratch, name, [&](Hdf5Writer& file) {
      add_field(file, "obs/force_N", type, shape, "(T,3)");
      if (free) add_field(file, "obs/object_velocity_mm_s", NumberType::f32, {2, 3}, "(T,3)");
    });
  };
  const auto plain = with("plain", NumberType::f32, {2, 3}, false);
  const std::string why = ": readers of WebDatasets need the same files in every sample";
  EXPECT_EQ(archive_both(scratch, plain, with("whole", NumberType::i32, {2, 3}, false)),
            "a.b has json: obs.force_N int32 (3), a.b has not" + why);
  EXPECT_EQ(archive_both(scratch, plain, with("longer", NumberType::f32, {2, 17}, false)),
            "a.b has force_n.npy float32 (17), a.b has not" + why);
  EXPECT_EQ(archive_both(scratch,
                         two_frames(scratch, "none",
                                    [](Hdf5Writer& file) { add_field(file, "obs/phase", NumberType::u8, {2}, "(T)"); }),
                         plain),
            "a.b has json: obs.force_N float32 (3), a.b has not" + why);
  EXPECT_EQ(archive_both(scratch, plain, with("free", NumberType::f32, {2, 3}, true)), "");
  const std::string command = fmt::format(
      "cd {} && tar -tf train-0-toy.tar > a && tar -tf train-0-toy_free.tar > b && tar -tf samples/train-0.tar > c",
      (scratch / "").string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_file(scratch / "a"), "a_b/frame_0000.json\na_b/frame_0001.json\n");
  EXPECT_EQ(read_file(scratch / "b"), read_file(scratch / "a"));
  EXPECT_EQ(read_file(scratch / "c"),
            "a_b.path.csv\na_b.sample.yaml\na_b.json\na_b.path.csv\na_b.sample.yaml\na_b.json\n");
}

/// A shard of one sample in three frames these seconds apart, with and without some fields.
std::filesystem::path small_shard(const ScratchFolder& scratch, const std::string& name, double step_s, bool torque,
                                  bool times, bool pressed) {
  Hdf5Writer file(scratch / (name + ".h5"));
  const std::string sample = "/data/" + name, obs = sample + "/obs/";
  file.group(sample + "/obs");
  file.attribute("/", "shard", name);
  const auto add = [&](const std::string& field, NumberType type, std::size_t width, double scale) {
    file.dataset(obs + field, type, width > 1 ? std::vector<std::size_t>{3, width} : std::vector<std::size_t>{3},
                 false);
    for (std::size_t t = 0; t < 3; ++t)
      file.write_frame(obs + field, t, to_bytes(type, std::vector<double>(width, scale * static_cast<double>(t))));
  };
  add("force_N", NumberType::f32, 3, 1.0);
  if (torque) add("torque_Nmm", NumberType::f32, 3, 1.0);
  if (times) add("time_s", NumberType::f64, 1, step_s);
  if (pressed) add("press_force_N", NumberType::f32, 1, 1.0);
  for (const auto& [key, value] :
       {std::pair{"sensor_id", "mctac"}, {"object_id", "star"}, {"motion", "down"}, {"split", "train"}})
    file.attribute(sample, key, value);
  file.attribute(sample, "n_frames", 3);
  file.close();
  return scratch / (name + ".h5");
}

std::string refusal_or_record(const ScratchFolder& scratch, const std::vector<std::filesystem::path>& shards) {
  const OutputPath output = [&](const std::string& name) {
    std::filesystem::create_directories((scratch / name).parent_path());
    return scratch / name;
  };
  try {
    return to_yaml(write_lerobot(shards, output));
  } catch (const DataError& error) {
    return error.what();
  }
}

TEST(LeRobot, RefusesSamplesOfOtherFields) {
  const ScratchFolder scratch;
  const auto whole = small_shard(scratch, "train-0", 0.01, true, true, true);
  EXPECT_THAT(refusal_or_record(scratch, {whole, small_shard(scratch, "train-1", 0.01, true, true, true)}),
              HasSubstr("episodes: 2\n"));
  EXPECT_EQ(refusal_or_record(scratch, {whole, small_shard(scratch, "train-2", 0.01, false, true, true)}),
            "train-2: has no field force_N, which earlier samples have: pack all shards with one profile");
  const auto less = small_shard(scratch, "train-3", 0.01, true, true, false);
  EXPECT_EQ(refusal_or_record(scratch, {whole, less}),
            "train-3: has no field press_force_N, which earlier samples have: pack all shards with one profile");
  EXPECT_EQ(refusal_or_record(scratch, {less, small_shard(scratch, "train-4", 0.01, true, true, true)}),
            "train-4: has a field press_force_N, which earlier samples have not: pack all shards with one profile");
  EXPECT_EQ(refusal_or_record(scratch, {small_shard(scratch, "train-5", 0.01, true, false, true)}),
            "train-5: has no field time_s: pack with a profile that has it");
}

TEST(LeRobot, SaysThatFramesAreNotEquallyFarApart) {
  const ScratchFolder scratch;
  const auto even = small_shard(scratch, "train-0", 0.01, true, true, true);
  EXPECT_EQ(refusal_or_record(scratch, {even, small_shard(scratch, "train-1", 0.01, true, true, true)}),
            "mctac:\n  episodes: 2\n  frames: 6\n  tasks: 1\n  equally_timed: true\n");
  EXPECT_THAT(refusal_or_record(scratch, {even, small_shard(scratch, "train-2", 0.03, true, true, true)}),
              HasSubstr("equally_timed: false\n"));
  EXPECT_THAT(read_file(scratch / "mctac/meta/info.json"), HasSubstr("\"fps\": 100,"));
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

/// The file `s.h5` with one sample that has texts; \return its bytes.
std::string shard_with_texts(const ScratchFolder& scratch) {
  {
    Hdf5Writer file(scratch / "s.h5");
    file.attribute("/", "shard", "s");
    file.group("/sensors/toy");
    file.write("/data/a/obs/force_N", NumberType::f32, {1, 3}, to_bytes(NumberType::f32, {1.0, 2.0, 3.0}));
    file.attribute("/data/a/obs/force_N", "shape", "(T,3)");
    file.attribute("/data/a", "n_frames", 1);
    file.attribute("/data/a", "sample_yaml", "motion: here\n");
    file.attribute("/data/a", "sensor_id", "toy");
    file.close();
  }
  return read_file(scratch / "s.h5");
}

TEST_F(RepackTest, ADamagedShardIsRefusedBeforeItIsRead) {
  scratch_.file("c.yaml", "format: folder\n");
  const std::string bytes = shard_with_texts(scratch_);
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

TEST_F(RepackTest, ACrashOfTheLibraryIsOneMessage) {
  scratch_.file("c.yaml", "format: folder\n");
  const std::string bytes = shard_with_texts(scratch_);
  const std::size_t heap = bytes.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  int crashes = 0;
  ASSERT_GT(bytes.size(), heap + 48);
  for (std::size_t at = heap + 25; at < heap + 48; ++at) {  // where the length of the first text is, and behind it
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    scratch_.file("s.h5", damaged);
    scratch_.file("s.h5.sha256", sha256(damaged) + "  s.h5\n");  // a stranger's digest is right
    const int code = run_command(fmt::format("{}/repack --config {} --shard {} --out {} --log-level error",
                                             TACIPC_BIN_DIR, (scratch_ / "c.yaml").string(),
                                             (scratch_ / "s.h5").string(), (scratch_ / "out").string()));
    ASSERT_TRUE(code == 0 || code == 1) << at << ": " << code << ": " << said_;
    if (code == 0) continue;
    ASSERT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << at << ": " << said_;
    ASSERT_FALSE(std::filesystem::exists(scratch_ / "out/.partial-repack")) << at;
    ASSERT_FALSE(std::filesystem::exists(scratch_ / "out/repack.yaml")) << at;
    if (said_.find("libhdf5 crashed while reading it: the file is damaged") == std::string::npos) continue;
    ++crashes;
    EXPECT_THAT(said_, HasSubstr((scratch_ / "s.h5").string() + ": libhdf5 crashed"));
    EXPECT_THAT(read_file(scratch_ / "out/repack.failed.yaml"), HasSubstr("libhdf5 crashed"));
  }
  EXPECT_GT(crashes, 0) << "another version of the library: damage something on which that one crashes";
}

}  // namespace repack_test
}  // namespace tacipc
