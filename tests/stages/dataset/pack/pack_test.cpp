// The program as the pipeline runs it, on a sample of which every number is known.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "common/base/sha256.h"
#include "common/format/csv.h"
#include "common/format/hdf5_reader.h"
#include "common/stage/record.h"
#include "tests/hdf5_texts.h"
#include "tests/program_test.h"
#include "tests/stages/dataset/pack/sample_files.h"

namespace tacipc {
namespace pack_test {

using ::testing::HasSubstr;

constexpr const char* kId = "toy__cube__press__000000";
constexpr const char* kShard = "train-00000-of-00001";

class PackTest : public ProgramTest {
 protected:
  void SetUp() override {
    sample_.emplace(scratch_, std::string("data/samples/000/") + kId);
    plan_ = std::string(kPlanHeader) + row(kId, 0, kShard);
    scratch_.file("data/plan/samples.csv", plan_);
    scratch_.file("data/plan/dataset.yaml", "name: test\n");
    scratch_.file("pack.yaml", read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/datasets/pack/full_sim.yaml"));
  }
  static std::string row(const std::string& id, int index, const std::string& shard) {
    return fmt::format("{},{},train,val,18446744073709551615,toy,tiny,cube,press,{},samples/000/{}\n", id, index, shard,
                       id);
  }
  int pack(const std::string& out = "out", const std::string& more = "") {
    return run_command(
        fmt::format("cd {} && {}/pack --config pack.yaml --plan data/plan/samples.csv --dataset "
                    "data/plan/dataset.yaml --shard {} --out {} --log-level error {}",
                    (scratch_ / "").string(), TACIPC_BIN_DIR, kShard, out, more));
  }
  std::filesystem::path shard_file(const std::string& out = "out") {
    return scratch_ / fmt::format("{}/{}.h5", out, kShard);
  }
  Hdf5Reader shard(const std::string& out = "out") { return Hdf5Reader(shard_file(out)); }
  static std::string group(const std::string& rest = "") { return fmt::format("/data/{}{}", kId, rest); }
  /// Turns a field on that no shipped configuration packs.
  void also(const std::string& field) {
    std::string text = read_file(scratch_ / "pack.yaml");
    const std::string off = field + ": false";
    scratch_.file("pack.yaml", text.replace(text.find(off), off.size(), field + ": true "));
  }
  /// To what single precision keeps.
  static void expect_same(double is, double must) { EXPECT_NEAR(is, must, 2e-7 * std::abs(must)); }
  static std::vector<double> values(const Hdf5Reader& file, const std::string& path) {
    return from_bytes(file.type(path), file.read(path));
  }

  std::optional<MadeSample> sample_;
  std::string plan_;
};

TEST_F(PackTest, NumbersComeOutInTheUnitsOfTheTable) {
  also("traction_Nmm2");
  ASSERT_EQ(pack(), 0) << said_;
  const Hdf5Reader file = shard();
  const auto obs = [&](const std::string& name) { return values(file, group("/obs/" + name)); };
  EXPECT_EQ(file.shape(group("/obs/rgb")), (std::vector<std::size_t>{2, 3, 4, 3}));
  for (const int i : {0, 1}) {
    const int f = 2 * i;  // frames 0 and 2 have images
    const auto frame = [&](const std::string& name) {
      const std::string path = group("/obs/" + name);
      return from_bytes(file.type(path), file.read_frame(path, static_cast<std::size_t>(i)));
    };
    const ByteImage picture = test_picture(f, 3);
    EXPECT_EQ(frame("rgb"), std::vector<double>(picture.pixels.begin(), picture.pixels.end()));
    for (std::size_t p = 0; p < 12; ++p) {
      const double value = static_cast<double>(p) + 100.0 * f;
      const double half_step = std::ldexp(0.5, -13) + 1e-6 * value;
      EXPECT_NEAR(frame("indentation_mm")[p], 0.01 * value, half_step);
      EXPECT_NEAR(frame("camera_depth_mm")[p], 0.1 * value, half_step);
      EXPECT_NEAR(frame("normal")[p], 0.25 * value, 1e-3 * value);
      for (const char* name : {"indentation_mm", "camera_depth_mm"}) {
        const double steps = std::ldexp(frame(name)[p], 13);
        EXPECT_EQ(steps, std::round(steps)) << name;
      }
    }
    EXPECT_THAT(frame("contact_mask"), ::testing::ElementsAre(0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1));
    EXPECT_THAT(frame("slip_state"), ::testing::ElementsAre(0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2));
    EXPECT_THAT(frame("segmentation"), ::testing::ElementsAre(2, 0, 0, 1, 1, 2, 0, 0, 1, 1, 2, 0));
    // traction.npy holds −100 + 0.5 n Pa; a cell of the 16 mm × 12 mm window is 0.25 mm² large.
    const auto pascal = [&](std::size_t cell, std::size_t kind, std::size_t axis) {
      return -100.0 + 0.5 * static_cast<double>(((static_cast<std::size_t>(f) * 24 * 32 + cell) * 2 + kind) * 3 + axis);
    };
    for (const std::size_t cell : {0u, 33u, 767u}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double normal = 0.25e-6 * pascal(cell, 0, axis), friction = 0.25e-6 * pascal(cell, 1, axis);
        expect_same(frame("force_field_normal_N")[3 * cell + axis], normal);
        expect_same(frame("force_field_friction_N")[3 * cell + axis], friction);
        expect_same(frame("force_field_N")[3 * cell + axis], normal + friction);
        expect_same(frame("traction_Nmm2")[3 * cell + axis], (normal + friction) / 0.25);
      }
    }
  }
  // wrench.npy is −3 + 0.25 n; contact_force.npy −0.5 + n / 32 over two vertices.
  EXPECT_THAT(obs("force_N"), ::testing::ElementsAre(-3, -2.75, -2.5, 0, 0.25, 0.5));
  EXPECT_THAT(obs("torque_Nmm"), ::testing::ElementsAre(-2250, -2000, -1750, 750, 1000, 1250));
  EXPECT_THAT(obs("press_force_N"), ::testing::ElementsAre(0, 1));
  EXPECT_THAT(obs("normal_force_N"), ::testing::ElementsAre(-0.8125, -0.75, -0.6875, 0.6875, 0.75, 0.8125));
  EXPECT_THAT(obs("friction_force_N"), ::testing::ElementsAre(-0.625, -0.5625, -0.5, 0.875, 0.9375, 1.0));
  EXPECT_THAT(obs("phase"), ::testing::ElementsAre(0, 8));
  EXPECT_THAT(obs("frame"), ::testing::ElementsAre(0, 2));
  EXPECT_THAT(obs("time_s"), ::testing::ElementsAre(0, 0.02));
  // −90° about x: half the angle in x and w, w positive.
  const std::vector<double> pose = obs("object_pose");
  const double half = std::sqrt(0.5);
  const std::vector<double> wanted{0, 0, 0, 0, 0, 0, 1, 1, 2, -3, -half, 0, 0, half};
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(pose[i], wanted[i], 1e-6) << i;
  EXPECT_EQ(file.shape(group("/obs/marker_px")), (std::vector<std::size_t>{2, 2, 2, 2}));
  const std::vector<double> px = obs("marker_px");
  EXPECT_EQ(std::vector<double>(px.begin(), px.begin() + 14),
            (std::vector<double>{0.5, 1.5, 2.5, 2.5, 0.5, 1.5, 2.5, 2.5, 0.5, 1.5, 2.5, 2.5, 2.5, 1.5}));
  EXPECT_TRUE(std::isnan(px[14]) && std::isnan(px[15]));
  EXPECT_THAT(obs("marker_visible"), ::testing::ElementsAre(1, 1, 1, 0));
  expect_same(obs("marker_mm")[7], -1.0 + 0.1 * 13);  // frame 2, first marker, y
  EXPECT_THAT(values(file, group("/check/newton_iterations")), ::testing::ElementsAre(0, 14));
  EXPECT_THAT(values(file, group("/check/velocity_residual_mm_s")), ::testing::ElementsAre(2, 2));
  EXPECT_TRUE(std::isnan(values(file, group("/check/min_distance_mm"))[0]));  // nothing was near
  expect_same(values(file, group("/check/min_distance_mm"))[1], 0.03);
}

TEST_F(PackTest, StressIsThereWhereThePressHasIt) {
  for (const char* field : {"pressure_Nmm2", "shear_Nmm2", "nodal_pressure_Nmm2", "nodal_shear_Nmm2", "stress_Nmm2"})
    also(field);
  ASSERT_EQ(pack(), 0) << said_;
  for (const char* field : {"nodal_pressure_Nmm2", "nodal_shear_Nmm2", "stress_Nmm2"})
    EXPECT_EQ(shard().text_attribute(group("/sim"), std::string("absent_") + field),
              "the press file does not say stress: true");
  EXPECT_EQ(shard().text_attribute(group("/obs"), "absent_pressure_Nmm2"), "the dataset's maps leave it out");
  sample_->write_stress();
  ASSERT_EQ(pack("more"), 0) << said_;
  const Hdf5Reader file = shard("more");
  EXPECT_EQ(file.shape(group("/sim/stress_Nmm2")), (std::vector<std::size_t>{2, 5, 6}));
  EXPECT_EQ(file.shape(group("/obs/shear_Nmm2")), (std::vector<std::size_t>{2, 3, 4, 3}));
  // stress.npy holds n Pa, front_pressure.npy 10 n, front_shear.npy 100 n; frames 0 and 2 are packed.
  expect_same(values(file, group("/sim/stress_Nmm2"))[30 + 7], 1e-6 * (60 + 7));
  EXPECT_THAT(values(file, group("/sim/nodal_pressure_Nmm2")),
              ::testing::Pointwise(::testing::DoubleNear(1e-9), {0.0, 20e-6, 80e-6, 100e-6}));
  expect_same(values(file, group("/sim/nodal_shear_Nmm2"))[6 + 3 + 1], 1e-4 * (24 + 6 + 1));
  expect_same(values(file, group("/obs/pressure_Nmm2"))[12 + 5], 1e-6 * 205);
}

TEST_F(PackTest, SchemaAndAttributesSayTheSameFieldByField) {
  ASSERT_EQ(pack(), 0) << said_;
  const Hdf5Reader file = shard();
  const Record schema = Record::from_file(scratch_ / "out/schema.json");
  std::size_t packed = 0;
  for (const Record& field : schema.sections("fields")) {
    const std::string path = group(fmt::format("/{}", field.required_text("path")));
    if (!field.required_flag("packed")) {
      EXPECT_FALSE(file.has(path)) << path;
      continue;
    }
    const std::string name = path.substr(path.rfind('/') + 1);
    if (field.required_text("path").starts_with("series/")) {
      EXPECT_EQ(file.text_attribute(group(), "absent_series"), "no grasp");
      EXPECT_FALSE(file.has(path)) << path;
      continue;
    }
    if (!file.has(path)) {
      EXPECT_NE(file.text_attribute(path.substr(0, path.rfind('/')), fmt::format("absent_{}", name)), "");
      continue;
    }
    ++packed;
    std::size_t same = 0;
    for (const auto& [key, value] : file.attributes(path)) {
      if (const auto* text = std::get_if<std::string>(&value.data()))
        EXPECT_EQ(field.required_text(key), *text) << path << " " << key;
      else
        EXPECT_EQ(field.required_number(key), std::get<double>(value.data())) << path << " " << key;
      ++same;
    }
    EXPECT_EQ(same + 3, field.keys().size()) << path;  // all but path, packed, in_variants
    EXPECT_EQ(name_of(file.type(path)), field.required_text("dtype"));
    const std::string letters = field.required_text("shape");
    EXPECT_EQ(file.shape(path).size(), std::count(letters.begin(), letters.end(), ',') + 1u) << path;
  }
  EXPECT_GT(packed, 40u);
  // And nothing is in the file that the schema does not know.
  for (const std::string& section : file.names(group())) {
    if (section == "variants") continue;
    for (const std::string& name : file.names(group(fmt::format("/{}", section))))
      EXPECT_THAT(read_file(scratch_ / "out/schema.json"),
                  HasSubstr(fmt::format("\"path\": \"{}/{}\"", section, name)));
  }
  EXPECT_EQ(file.text_attribute("/", "schema_sha256"), sha256_of_file(scratch_ / "out/schema.json"));
  EXPECT_EQ(file.text_attribute("/", "config_sha256"), sha256("name: test\n"));
}

TEST_F(PackTest, WhatIsMissingSaysWhy) {
  ASSERT_EQ(pack(), 0) << said_;
  const Hdf5Reader file = shard();
  EXPECT_FALSE(file.has(group("/obs/rgb_marker")));
  EXPECT_EQ(file.text_attribute(group("/obs"), "absent_rgb_marker"), "the sensor prints no markers");
  EXPECT_EQ(file.names(group("/variants")), std::vector<std::string>{"red"});
  EXPECT_EQ(file.names(group("/variants/red")), std::vector<std::string>{"rgb"});
  EXPECT_THAT(file.text_attribute(group("/variants/red"), "absent_normal"), HasSubstr("see obs"));
  const ByteImage picture = test_picture(7, 3);
  EXPECT_EQ(values(file, group("/variants/red/rgb"))[36], picture.pixels[0]);
}

TEST_F(PackTest, TheShardTellsItsCameraAndItsSamples) {
  ASSERT_EQ(pack(), 0) << said_;
  const Hdf5Reader file = shard();
  for (const std::string at : {"/", "/sensors/toy"}) {
    const Record camera = Record::from_file(scratch_.file("camera.yaml", to_yaml(file.attributes(at))));
    EXPECT_EQ(camera.text("camera_model"), "pinhole");
    // 16 mm in 4 pixels at 10 mm: f = 2.5 px; the centre is the image's.
    const Value::Map lines = file.attributes(at);
    const auto k = std::find_if(lines.begin(), lines.end(), [](const auto& line) { return line.first == "K"; });
    ASSERT_NE(k, lines.end());
    EXPECT_THAT(to_yaml(k->second), HasSubstr("[2.5, 0, 2]\n- [0, 2.5, 1.5]\n- [0, 0, 1]"));
  }
  EXPECT_EQ(texts_of(file, "/mask/train"), std::vector<std::string>{kId});
  EXPECT_EQ(texts_of(file, "/mask/pose_val"), std::vector<std::string>{kId});
  EXPECT_EQ(file.text_attribute(group(), "seed"), "18446744073709551615");
  EXPECT_EQ(file.text_attribute(group(), "sample_yaml"), "motion: {kind: press, depth_mm: 1, steps: 2}\n");
  EXPECT_EQ(file.text_attribute(group(), "path_csv"), "0,0,0,0,0,0,0,1\n");
  CsvReader manifest(scratch_ / "out/manifest.csv");
  ASSERT_TRUE(manifest.next());
  EXPECT_EQ(manifest["status"], "made");
  EXPECT_EQ(manifest["offset"], "0");
  EXPECT_EQ(manifest["min_distance_mm"], "0.01");
  EXPECT_EQ(read_file(scratch_ / fmt::format("out/{}.h5.sha256", kShard)),
            fmt::format("{}  {}.h5\n", sha256_of_file(scratch_ / fmt::format("out/{}.h5", kShard)), kShard));
}

TEST_F(PackTest, TheSameSamplesAreTheSameBytes) {
  ASSERT_EQ(pack("one", "--threads 1"), 0) << said_;
  ::setenv("MALLOC_PERTURB_", "90", 1);  // fills what is allocated: nothing of it may reach the file
  ASSERT_EQ(pack("two", "--threads 3"), 0) << said_;
  ::unsetenv("MALLOC_PERTURB_");
  for (const char* name : {"train-00000-of-00001.h5", "manifest.csv", "failures.csv", "schema.json", "pack.yaml"})
    EXPECT_EQ(read_file(scratch_ / (std::string("one/") + name)), read_file(scratch_ / (std::string("two/") + name)))
        << name;
}

TEST_F(PackTest, FailedSamplesStandInTheTablesWithTheirReason) {
  const std::string failed = "toy__cube__press__000001";
  scratch_.file("data/plan/samples.csv", plan_ + row(failed, 1, kShard) + row("elsewhere", 2, "val-00000-of-00001"));
  scratch_.file(
      "data/samples/000/" + failed + "/press/press.failed.yaml",
      "stage: press\nmessage: \"out of balance, twice\"\nframe: 3\ncheck: balance\nvalue: 0.2\nlimit: 0.001\n");
  ASSERT_EQ(pack(), 0) << said_;
  EXPECT_EQ(shard().names("/data"), std::vector<std::string>{kId});
  CsvReader manifest(scratch_ / "out/manifest.csv");
  ASSERT_TRUE(manifest.next() && manifest.next());
  EXPECT_EQ(manifest["id"], failed);
  EXPECT_EQ(manifest["status"], "failed");
  EXPECT_EQ(manifest["offset"], "");
  EXPECT_FALSE(manifest.next());
  EXPECT_EQ(read_file(scratch_ / "out/failures.csv"),
            "id,stage,reason,frame,check,value,limit,log\n" + failed +
                ",press,\"out of balance, twice\",3,balance,0.2,0.001,samples/000/" + failed + "/press/press.log\n");
}

TEST_F(PackTest, UnmadeSamplesAreRefusedOrListed) {
  const std::string unmade = "toy__cube__press__000001";
  scratch_.file("data/plan/samples.csv", plan_ + row(unmade, 1, kShard));
  EXPECT_EQ(pack(), 1);
  EXPECT_THAT(said_, HasSubstr(unmade + ": press has neither a record nor a failure"));
  scratch_.file("pack.yaml", "unmade: list\nobs: {rgb: true}\n");
  ASSERT_EQ(pack(), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/manifest.csv"), HasSubstr(",unmade,"));
  EXPECT_THAT(read_file(scratch_ / "out/failures.csv"), HasSubstr(unmade + ",press,not made,"));
}

TEST_F(PackTest, AShardWithoutSamplesIsStillAShard) {
  scratch_.file("data/plan/samples.csv", kPlanHeader + row("toy__none__press__000001", 1, kShard));
  scratch_.file("pack.yaml", "unmade: list\nobs: {rgb: true}\n");
  ASSERT_EQ(pack(), 0) << said_;
  EXPECT_EQ(shard().names("/data"), std::vector<std::string>{});
}

TEST_F(PackTest, FilesThatAreNotWhatTheRecordsSpeakOfAreRefused) {
  const std::string folder = std::string("data/samples/000/") + kId;
  const auto picture = scratch_ / (folder + "/render/frame_0002/tactile.png");
  write_png(picture, test_picture(9, 3));
  EXPECT_EQ(pack(), 1);
  EXPECT_THAT(said_, HasSubstr("frame_0002/tactile.png: is not the file of its record"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/pack.yaml"));
  write_png(picture, test_picture(2, 3));
  ASSERT_EQ(pack(), 0) << said_;
  const std::string record = read_file(scratch_ / "out/pack.yaml"), bytes = content_hash(shard_file());
  const std::vector<double> times{0.0, 0.5, 1.0};
  write_npy(scratch_ / (folder + "/press/time.npy"), {3}, times.data());
  EXPECT_EQ(pack(), 1);
  EXPECT_THAT(said_, HasSubstr("the images were made of another press than the one that is there"));
  sample_.emplace(scratch_, folder);
  scratch_.file("made_from/press.yaml", "time_step_s: 0.02\n");
  EXPECT_EQ(pack(), 1);
  EXPECT_THAT(said_, HasSubstr("made_from/press.yaml: has changed since press of"));
  // What was packed before may be all there is of samples that were dropped since.
  EXPECT_EQ(read_file(scratch_ / "out/pack.yaml"), record);
  EXPECT_EQ(content_hash(shard_file()), bytes);
}

TEST_F(PackTest, WhatADownloadNeedsOfSamplesIsKeptBesideTheShard) {
  const std::string press = std::string("data/samples/000/") + kId + "/press";
  scratch_.file(press + "/markers.csv", "row,column\n");
  sample_->write_render();
  ASSERT_EQ(pack(), 0) << said_;
  std::filesystem::remove(scratch_ / (press + "/markers.csv"));
  const Record record = Record::from_file(scratch_ / "out/pack.yaml");
  EXPECT_TRUE(record.section("outputs").has("sensors/toy/markers-tiny.csv"));
  for (const Record& sensor : record.section("summary").sections("sensors"))
    for (const Record& file : sensor.sections("files"))
      EXPECT_EQ(content_hash(scratch_ / ("out/" + file.required_text("path"))), file.required_text("hash"));
}

TEST_F(PackTest, OneNameForTwoFilesIsRefused) {
  const std::string other = "toy__cube__press__000001", folder = "data/samples/000/" + other;
  scratch_.file("data/plan/samples.csv", plan_ + row(other, 1, kShard));
  MadeSample second(scratch_, folder);
  scratch_.file("made_from/other.ply", "another object\n");
  std::string record = read_file(scratch_ / (folder + "/press/press.yaml"));
  const std::string hash = content_hash(scratch_ / "made_from/object.ply");
  record.replace(record.find("object.ply"), 10, "other.ply");
  record.replace(record.find(hash), hash.size(), content_hash(scratch_ / "made_from/other.ply"));
  scratch_.file(folder + "/press/press.yaml", record);
  second.write_render();
  EXPECT_EQ(pack(), 1);
  EXPECT_THAT(said_, HasSubstr("object 'cube' is two different files: "));
}

TEST_F(PackTest, MemoryDoesNotGrowWithThePlan) {
  const auto peak_mb = [&](const std::string& out) {
    return Record::from_file(scratch_ / (out + "/pack.timings.yaml")).required_number("peak_memory_mb");
  };
  ASSERT_EQ(pack("small"), 0) << said_;
  std::string rows;
  for (int i = 1; i < 100'000; ++i) rows += row(fmt::format("toy__cube__press__{:06}", i), i, "train-00001-of-00002");
  scratch_.file("data/plan/samples.csv", plan_ + rows);
  ASSERT_EQ(pack("large"), 0) << said_;
  EXPECT_LT(peak_mb("large"), peak_mb("small") + 1.0);
}

TEST_F(PackTest, AFullDiskEndsInAMessage) {
  ASSERT_EQ(pack(), 0) << said_;
  const std::uintmax_t size = std::filesystem::file_size(shard_file());
  // A limit on the size of files ends writing where a full disk would: in the frames, in what the library holds back
  // until the file is closed, and in the last block.
  for (const std::uintmax_t limit : {size / 4, size / 2, size - size / 4, size - 1}) {
    const std::string blocks = fmt::format("ulimit -f {}; ", limit / 512);
    ASSERT_EQ(run_command(fmt::format("{}cd {} && {}/pack --config pack.yaml --plan data/plan/samples.csv --dataset "
                                      "data/plan/dataset.yaml --shard {} --out full --log-level error",
                                      blocks, (scratch_ / "").string(), TACIPC_BIN_DIR, kShard)),
              1)
        << limit << " of " << size << " bytes: " << said_;
    EXPECT_THAT(said_, HasSubstr("cannot be written")) << limit;
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
    EXPECT_FALSE(std::filesystem::exists(scratch_ / fmt::format("full/{}.h5", kShard)));
  }
}

TEST_F(PackTest, WrongWordsAreUsage) {
  scratch_.file("pack.yaml", "obs: {rbg: true}\n");
  EXPECT_EQ(pack(), 2);
  EXPECT_THAT(said_, HasSubstr("pack.yaml:1:7: obs.rbg: unknown key (did you mean rgb?)"));
  EXPECT_THAT(said_, HasSubstr("obs: at least one field must be true"));
  scratch_.file("pack.yaml", "obs: {rgb: true}\n");
  EXPECT_EQ(pack("out", "--shard val-00009-of-00010"), 2);  // CLI11 takes a flag once
  scratch_.file("data/plan/samples.csv", kPlanHeader);
  EXPECT_EQ(pack(), 1);
  EXPECT_THAT(said_, HasSubstr("has no shard 'train-00000-of-00001'"));
}

}  // namespace pack_test
}  // namespace tacipc
