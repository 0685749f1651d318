// Photographs that are not as the training's were: each deviation is found and named, images as trained are not.
#include "common/benchmark/trained_look.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/image/picture.h"
#include "tests/common/benchmark/shaded_dents.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace trained_look_test {

const MadeUpLamps kThree, kOpposite{.degrees = {180.0, 0.0, 90.0}, .codes = {80.0, 140.0, 110.0}},
    kWhite{.degrees = {45.0, 45.0, 45.0}, .codes = {120.0, 100.0, 80.0}};

ImageLook made_look(const MadeUpLamps& lamps, std::size_t index, double brighter) {
  FloatImage background = means_over_squares(shaded_image(lamps, index, false), 1),
             image = means_over_squares(shaded_image(lamps, index, true), 1);
  for (FloatImage* one : {&background, &image})
    for (float& code : one->pixels) code += static_cast<float>(brighter);
  return look_of(background, image);
}

/// Trained on `count` images, with backgrounds up to three codes brighter or darker.
TrainedLook trained_on(const std::vector<MadeUpLamps>& lamps, std::size_t count) {
  std::vector<std::vector<ImageLook>> groups;
  for (std::size_t i = 0; i < count; ++i) {
    groups.emplace_back();
    for (const double brighter : {0.0, 6.0 * random_uniform(3, i, 0) - 3.0})
      groups.back().push_back(made_look(lamps[i % lamps.size()], i, brighter));
  }
  return TrainedLook::of(groups, 1);
}

struct Pair {
  FloatImage background, image;
};
Pair photograph(const MadeUpLamps& lamps, std::size_t index) {
  return {means_over_squares(shaded_image(lamps, index, false), 1),
          means_over_squares(shaded_image(lamps, index, true), 1)};
}
Pair turned_pair(const Pair& pair, const ImageTurn& turn) {
  return {turned(pair.background, turn), turned(pair.image, turn)};
}

class OfLamps : public testing::TestWithParam<MadeUpLamps> {};

TEST_P(OfLamps, DeviationsAreNamedAndImagesAsTrainedAreNot) {
  const TrainedLook look = trained_on({GetParam()}, 24);
  const auto found = [&](const char* deviation, const auto& change) {
    int count = 0;
    for (std::size_t i = 100; i < 110; ++i) {
      const Pair pair = change(i);
      const LookComparison comparison = look.compare(pair.background, pair.image);
      EXPECT_EQ(comparison.deviation.empty(), comparison.distance <= 1.0);
      count += comparison.deviation == deviation;
    }
    return count;
  };
  const auto turned_by = [&](const ImageTurn& turn) {
    return [turn](std::size_t i) { return turned_pair(photograph(GetParam(), i), turn); };
  };
  int as_trained = 0;
  for (std::size_t i = 100; i < 120; ++i) {
    const Pair pair = photograph(GetParam(), i);
    as_trained += look.compare(pair.background, pair.image).deviation.empty();
    as_trained += look.compare(pair.background, pair.background).deviation.empty();  // nothing touched
  }
  EXPECT_EQ(as_trained, 40);
  EXPECT_GE(found("red_blue_swapped", turned_by({.swapped = true})), 9);
  EXPECT_GE(found("turned_180", turned_by({.left_right = true, .top_bottom = true})), 9);
  EXPECT_GE(found("image_red_blue_swapped",
                  [](std::size_t i) {
                    Pair pair = photograph(GetParam(), i);
                    pair.image = turned(pair.image, {.swapped = true});
                    return pair;
                  }),
            9);
  EXPECT_GE(found("background_touched",
                  [](std::size_t i) {
                    Pair pair = photograph(GetParam(), i);
                    pair.background = photograph(GetParam(), i + 20).image;
                    return pair;
                  }),
            9);
  EXPECT_GE(found("other_lamps",
                  [](std::size_t i) {
                    MadeUpLamps other = GetParam();
                    for (double& degrees : other.degrees) degrees += 50.0;
                    other.codes[1] *= 1.2;
                    return photograph(other, i);
                  }),
            9);
}
INSTANTIATE_TEST_SUITE_P(TrainedLook, OfLamps, testing::Values(kThree, kOpposite, kWhite));

TEST(TrainedLook, AllowsWhatTheTrainingVaried) {
  MadeUpLamps brighter = kThree, turned_a_little = kThree, between = kThree;
  brighter.codes = {125.0, 140.0, 115.0};
  turned_a_little.degrees[0] += 25.0;
  between.codes = {114.0, 129.0, 104.0};
  const TrainedLook narrow = trained_on({kThree}, 24), wide = trained_on({kThree, brighter, turned_a_little}, 24);
  for (std::size_t i = 200; i < 205; ++i) {
    const Pair pair = photograph(between, i);
    EXPECT_EQ(narrow.compare(pair.background, pair.image).deviation, "other_lamps");
    EXPECT_EQ(wide.compare(pair.background, pair.image).deviation, "");
  }
}

TEST(TrainedLook, IsReadAsItWasWrittenAndRefusedIfDamaged) {
  const TrainedLook look = trained_on({kThree}, 12);
  const std::string text = look.to_text();
  const TrainedLook again = TrainedLook::from_text(text, "model.onnx");
  EXPECT_EQ(again.reduction(), 1);
  for (std::size_t i = 50; i < 53; ++i) {
    const Pair pair = turned_pair(photograph(kThree, i), {.swapped = true});
    const LookComparison one = look.compare(pair.background, pair.image),
                         other = again.compare(pair.background, pair.image);
    EXPECT_NEAR(one.distance, other.distance, 1e-3 * one.distance);
    EXPECT_EQ(one.deviation, other.deviation);
  }
  std::vector<std::string> damaged{"", "[", "a list", text.substr(0, text.size() / 2), text + "more: 1\n"};
  for (const auto& [from, to] : {std::pair{"format: 1", "format: 2"},
                                 {"reduction: 1", "reduction: 0"},
                                 {"pattern:", "patterns:"},
                                 {"mean: [", "mean: [.inf, "},
                                 {"least_change_codes: ", "least_change_codes: -"}}) {
    damaged.push_back(text);
    damaged.back().replace(text.find(from), std::string(from).size(), to);
  }
  for (const std::string& one : damaged)
    EXPECT_EQ(message_of<DataError>([&] { TrainedLook::from_text(one, "model.onnx"); }),
              "model.onnx: its statistics of the training images are damaged")
        << one.substr(0, 60);
}

TEST(LookReport, TellsManyImagesTogether) {
  LookReport report;
  report.add("a", {.distance = 0.4});
  EXPECT_TRUE(report.warnings("photographs").empty());
  const char* const swapped = "the image and its background have red and blue swapped";
  for (const auto& [name, distance] : {std::pair{"b", 6.31}, {"c", 5.2}, {"d", 7.94}, {"e", 6.0}})
    report.add(name,
               {.distance = distance, .deviation = "red_blue_swapped", .meaning = swapped, .undone = 0.1 * distance});
  report.add("f", {.distance = 2.0, .deviation = "other_lamps", .meaning = "other lamps"});
  EXPECT_THAT(
      report.warnings("photographs"),
      testing::ElementsAre("4 of 6 photographs (b, c, d, …) are unlike those of the training, at 5.2 to 7.9 times "
                           "its limit: the image and its background have red and blue swapped; undone, at 0.8",
                           "1 of 6 photographs (f) are unlike those of the training, at 2.0 times its limit: "
                           "other lamps"));
  EXPECT_EQ(to_yaml(report.summary()),
            "images: 5\nof: 6\nlargest_distance: 7.94\ndeviations:\n  other_lamps: 1\n  red_blue_swapped: 4\n");
}

}  // namespace trained_look_test
}  // namespace tacipc
