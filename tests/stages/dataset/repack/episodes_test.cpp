// Samples and both fingers of grasps as episodes of LeRobot and UniVTAC.
#include "stages/dataset/repack/episodes.h"

#include <gmock/gmock.h>

#include <map>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/hdf5_writer.h"
#include "stages/dataset/repack/lerobot.h"
#include "stages/dataset/repack/lerobot_features.h"
#include "stages/dataset/repack/univtac.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace episodes_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::size_t kFrames = 2, kPressFrames = 4;

/// A shard being written, of samples with two images each.
class Shard {
 public:
  Shard(const ScratchFolder& scratch, const std::string& name) : path_(scratch / (name + ".h5")), file_(path_) {
    file_.attribute("/", "shard", name);
    file_.group("/data");
  }

  /// \param first_s time of the first image; the second is 0.02 s later
  Shard& sample(const std::string& id, double first_s = 0.0) {
    const std::string group = "/data/" + id;
    file_.group(group + "/obs");
    for (const auto& [key, value] : Value::Map{{"sensor_id", "mctac"},
                                               {"object_id", "star"},
                                               {"motion", "down"},
                                               {"split", "train"},
                                               {"index", next_index_++},
                                               {"n_frames", kFrames}})
      file_.attribute(group, key, value);
    add(group + "/obs/time_s", NumberType::f64, {kFrames}, {first_s, first_s + 0.02});
    add(group + "/obs/press_force_N", NumberType::f32, {kFrames}, {1.0, 2.0});
    add(group + "/obs/object_pose", NumberType::f32, {kFrames, 7}, {1, 2, 3, 0, 0, 0.6, 0.8, 4, 5, 6, 0, 0, 0, 1});
    std::vector<double> codes;
    for (int i = 0; i < 2 * 2 * 3 * 3; ++i) codes.push_back(i);
    add(group + "/obs/rgb", NumberType::u8, {kFrames, 2, 3, 3}, codes);
    file_.attribute(group + "/obs/rgb", "meaning", "image");
    return *this;
  }

  /// Poses move by 1 mm a frame of the press; the fingers are 20 mm apart and close by 2 mm a frame.
  Shard& finger(const std::string& id, const std::string& grasp, const std::string& side, double first_s = 0.01) {
    sample(id, first_s);
    const std::string group = "/data/" + id;
    file_.attribute(group, "grasp", grasp);
    file_.attribute(group, "finger", side);
    std::vector<double> times_s, hand, fingers, object;
    for (std::size_t t = 0; t < kPressFrames; ++t) {
      const auto step = static_cast<double>(t);
      times_s.push_back(0.01 * step);
      hand.insert(hand.end(), {0, 0, step, 0, 0, 0, 1});
      fingers.insert(fingers.end(), {step - 10, 0, 0, 0.6, 0, 0.8, 0, 10 - step, 0, 0, 0, 0, 0, 1});
      object.insert(object.end(), {0, step, 0, 0, 0, 0, 1});
    }
    add(group + "/series/time_s", NumberType::f64, {kPressFrames}, times_s);
    add(group + "/series/hand_pose", NumberType::f64, {kPressFrames, 7}, hand);
    add(group + "/series/finger_pose", NumberType::f64, {kPressFrames, 2, 7}, fingers);
    add(group + "/series/object_pose", NumberType::f64, {kPressFrames, 7}, object);
    return *this;
  }

  std::filesystem::path close() {
    file_.close();
    return path_;
  }

 private:
  void add(const std::string& path, NumberType type, const std::vector<std::size_t>& shape,
           const std::vector<double>& values) {
    file_.write(path, type, shape, to_bytes(type, values));
  }

  std::filesystem::path path_;
  Hdf5Writer file_;
  int next_index_ = 0;
};

TEST(Episodes, FingersOfAGraspAreOneWhereverTheyAre) {
  const ScratchFolder scratch;
  const auto val = Shard(scratch, "val-0").sample("v").finger("h", "g", "right").finger("i", "i", "left").close();
  const auto train = Shard(scratch, "train-0")
                         .finger("a", "a", "left")
                         .finger("b", "a", "right")
                         .sample("c")
                         .finger("g", "g", "left")
                         .finger("z", "y", "right")
                         .close();
  std::vector<std::string> seen;
  const std::size_t alone = for_each_episode({val, train}, [&](std::size_t shard, const Episode& episode) {
    seen.push_back(fmt::format("{} {} {} {}", shard, episode.id(), episode.kind(),
                               episode.is_grasp() ? episode.sample(1).group : "-"));
  });
  EXPECT_THAT(seen, ElementsAre("0 a mctac_grasp /data/b", "0 c mctac -", "0 g mctac_grasp /data/h", "1 v mctac -"));
  EXPECT_EQ(alone, 2U) << "i has no right finger, z no left one";
}

TEST(Episodes, FingersOfDifferentFramesAreRefused) {
  const ScratchFolder scratch;
  const auto take = [](std::size_t, const Episode&) {};
  const auto other = Shard(scratch, "a").finger("a", "a", "left", 0.0).finger("b", "a", "right", 0.01).close();
  EXPECT_EQ(message_of<DataError>([&] { for_each_episode({other}, take); }),
            "a: its fingers have images of different frames");
  const auto late = Shard(scratch, "b").finger("a", "a", "left", 0.5).finger("b", "a", "right", 0.5).close();
  EXPECT_EQ(message_of<DataError>([&] { for_each_episode({late}, take); }),
            "a: the series has no frame at 0.5 s, where there is an image");
}

TEST(LeRobotFeatures, OfAGraspNameBothFingersGripAndPoses) {
  const ScratchFolder scratch;
  const auto shard = Shard(scratch, "train-0").finger("a", "a", "left").finger("b", "a", "right").close();
  for_each_episode({shard}, [](std::size_t, const Episode& episode) {
    std::map<std::string, std::vector<double>> last;
    for (const Feature& feature : lerobot_features(true))
      if (feature.in(episode) && !feature.is_image()) last[feature.name] = feature.frame(episode, 1);
    EXPECT_THAT(last["observation.grip"], ElementsAre(2.0, 2.0));
    EXPECT_THAT(last["observation.state"], ElementsAre(0, 0, 0.003, 0, 0, 0, 1, 0.014))
        << "images 0 and 1 are frames 1 and 3";
    EXPECT_EQ(last["action"], last["observation.state"]) << "nothing comes after the last frame";
    EXPECT_THAT(last["observation.object_pose"], ElementsAre(0, 0.003, 0, 0, 0, 0, 1));
    EXPECT_FALSE(last.contains("observation.wrench.tactile_left")) << "there are no forces";
    EXPECT_EQ(task_of(episode), "down star");
  });
}

TEST(LeRobot, GraspsAreADatasetOfTheirOwn) {
  const ScratchFolder scratch;
  const auto shard = Shard(scratch, "train-0")
                         .finger("a", "a", "left")
                         .finger("b", "a", "right")
                         .sample("c")
                         .finger("d", "d", "left")
                         .close();
  const Value::Map summary = write_lerobot({shard}, [&](const std::string& name) {
    std::filesystem::create_directories((scratch / name).parent_path());
    return scratch / name;
  });
  EXPECT_EQ(to_yaml(summary),
            "mctac:\n  episodes: 1\n  frames: 2\n  tasks: 1\n  equally_timed: true\n"
            "mctac_grasp:\n  episodes: 1\n  frames: 2\n  tasks: 1\n  equally_timed: true\nfingers_left_out: 1\n");
  const std::string info = read_file(scratch / "mctac_grasp/meta/info.json");
  for (const char* feature :
       {"observation.images.tactile_left", "observation.images.tactile_right", "observation.grip"})
    EXPECT_THAT(info, HasSubstr(fmt::format("\"{}\"", feature)));
  EXPECT_THAT(read_file(scratch / "mctac_grasp/meta/stats.json"), HasSubstr("\"q99\": [2.0, 2.0]"));
}

TEST(UniVtac, AnEpisodeIsAFileWithEncodedImagesAndPosesInMetres) {
  const ScratchFolder scratch;
  const auto shard = Shard(scratch, "train-0").sample("c").finger("a", "a", "left").finger("b", "a", "right").close();
  const Value::Map summary = write_univtac({shard}, [&](const std::string& name) {
    std::filesystem::create_directories((scratch / name).parent_path());
    return scratch / name;
  });
  EXPECT_EQ(to_yaml(summary), "mctac:\n  episodes: 1\n  frames: 2\nmctac_grasp:\n  episodes: 1\n  frames: 2\n");
  const Hdf5Reader press(scratch / "mctac/train/hdf5/0.hdf5"), grasp(scratch / "mctac_grasp/train/hdf5/1.hdf5");
  const auto numbers = [](const Hdf5Reader& file, const std::string& path) {
    return from_bytes(file.type(path), file.read(path));
  };
  EXPECT_EQ(press.shape("/embodiment/joint"), (std::vector<std::size_t>{2, 0}));
  EXPECT_THAT(press.text_attribute("/embodiment/joint", "absent"), HasSubstr("no robot"));
  EXPECT_THAT(numbers(press, "/step"), ElementsAre(0, 1));
  EXPECT_FALSE(press.has("/tactile/right_tactile"));
  EXPECT_FALSE(press.has("/tactile/left_tactile/depth"));
  EXPECT_EQ(press.text_attribute("/tactile/left_tactile", "absent_depth"), "not packed");
  std::vector<double> object = numbers(press, "/actor/star");
  object.resize(7);
  EXPECT_THAT(object, ElementsAre(0.001F, 0.002F, 0.003F, 0.8F, 0, 0, 0.6F));
  EXPECT_THAT(numbers(press, "/tactile/left_tactile/pose"), ElementsAre(0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0));
  EXPECT_THAT(numbers(grasp, "/embodiment/ee"), ElementsAre(0, 0, 0.001F, 1, 0, 0, 0, 0, 0, 0.003F, 1, 0, 0, 0));
  std::vector<double> left = numbers(grasp, "/tactile/left_tactile/pose");
  left.resize(7);
  EXPECT_THAT(left, ElementsAre(-0.009F, 0, 0, 0, 0.6F, 0, 0.8F));
  EXPECT_TRUE(grasp.has("/tactile/right_tactile/rgb"));
}

}  // namespace episodes_test
}  // namespace tacipc
