#include "common/sample/film.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace film_test {

namespace fs = std::filesystem;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pointwise;

constexpr Film::Size kLarge{4000, 4000};

class FilmTest : public ::testing::Test {
 protected:
  /// Three frames of 8 × 6 pixels: tactile red 10, 20, 30, markers green 40, 50, 60, indented 0, 1, 2 mm and twice
  /// that.
  FilmedGel gel(const std::string& name, bool markers = true, double deeper = 1.0) {
    const std::string folder = name.empty() ? "" : name + "/";
    scratch_.file(folder + "press/press.yaml", "stage: press\nof: " + name + "\n");
    const fs::path press = scratch_ / (folder + "press"), render = scratch_ / (folder + "render");
    for (int f = 0; f < 3; ++f) {
      const fs::path frame = render / fmt::format("frame_{:04}", f);
      fs::create_directories(frame);
      write_png(frame / "tactile.png", colored(10 * (f + 1), 0));
      if (markers) write_png(frame / "marker.png", colored(0, 40 + 10 * f));
      write_exr(frame / "indentation.exr", FloatImage(8, 6, 1, static_cast<float>(1e-3 * f * deeper)), {"Y"});
    }
    write_record(press, render);
    return {press, render};
  }
  static void write_record(const fs::path& press, const fs::path& render) {
    write_file(render / "render.yaml",
               fmt::format("stage: render\ninputs:\n  press: {{path: ../press, hash: {}}}\n", content_hash(press)));
  }
  static ByteImage colored(int red, int green) {
    ByteImage image(8, 6, 3, 0);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      image.pixels[i] = static_cast<std::uint8_t>(red);
      image.pixels[i + 1] = static_cast<std::uint8_t>(green);
    }
    return image;
  }
  static std::array<int, 3> pixel(const ByteImage& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
  }
  std::string refused(const std::vector<FilmedGel>& gels, Film::Size most = kLarge) {
    return message_of<DataError>([&] { Film(gels, 3, most); });
  }
  std::string path(const std::string& name) const { return (scratch_ / name).string(); }

  ScratchFolder scratch_;
};

TEST_F(FilmTest, ShowsTactileImageMarkersAndIndentationSideBySide) {
  const Film film({gel("")}, 3, kLarge);
  EXPECT_THAT(film.columns(), ElementsAre("tactile", "marker", "indentation"));
  EXPECT_EQ(film.size().width, 8 + 4 + 8 + 4 + 8);
  EXPECT_EQ(film.size().height, 6);
  for (int f = 0; f < 3; ++f) {
    const ByteImage picture = film.picture(static_cast<std::size_t>(f));
    EXPECT_EQ(pixel(picture, 3, 2), (std::array{10 * (f + 1), 0, 0}));
    EXPECT_EQ(pixel(picture, 12 + 3, 2), (std::array{0, 40 + 10 * f, 0}));
    EXPECT_EQ(pixel(picture, 9, 2), (std::array{24, 24, 24})) << "the gap";
  }
  // One scale for all frames: half as deep is not the deepest colour.
  EXPECT_NE(pixel(film.picture(1), 26, 3), pixel(film.picture(2), 26, 3));
  EXPECT_NE(pixel(film.picture(0), 26, 3), pixel(film.picture(1), 26, 3));
}

TEST_F(FilmTest, HasARowForEachGelAndTheColumnsThatAllHave) {
  const Film film({gel("left"), gel("right", false, 2.0)}, 3, kLarge);
  EXPECT_THAT(film.columns(), ElementsAre("tactile", "indentation"));
  EXPECT_EQ(film.size().height, 6 + 4 + 6);
  const ByteImage last = film.picture(2), middle = film.picture(1);
  EXPECT_EQ(pixel(last, 3, 12), (std::array{30, 0, 0}));
  EXPECT_EQ(pixel(last, 14, 3), pixel(middle, 14, 13)) << "2 mm in both: one scale for all gels";
}

TEST_F(FilmTest, ShrinksUntilItFits) {
  const Film film({gel("")}, 3, {20, 20});
  EXPECT_EQ(film.shrunk_by(), 2);
  EXPECT_EQ(film.size().width, 4 + 4 + 4 + 4 + 4);
  EXPECT_EQ(film.size().height, 4) << "3, made even";
  EXPECT_EQ(pixel(film.picture(2), 1, 1), (std::array{30, 0, 0}));
  EXPECT_EQ(refused({gel("")}, {10, 10}), "a film of 1 rows of 3 pictures does not fit 10 x 10 pixels");
}

TEST_F(FilmTest, RefusesWhatIsNotWhole) {
  const FilmedGel one = gel("one"), two = gel("two"), three = gel("three");
  fs::remove(one.render / "render.yaml");
  EXPECT_EQ(refused({one}), path("one/render") + ": has no render.yaml, so no images are whole");
  fs::remove_all(two.render / "frame_0001");
  EXPECT_EQ(
      refused({two}),
      path("two/render") + ": frame 1 of 0 to 2 is not there; a film needs all (frames: all of the render's file)");
  write_file(three.press / "press.yaml", "stage: press\nof: another\n");
  EXPECT_EQ(refused({three}),
            path("three/render") + ": its images are of another press than " + path("three/press") + "; render again");
  const FilmedGel four = gel("four");
  write_png(four.render / "frame_0002/marker.png", ByteImage(4, 6, 3, 0));
  const Film film({four}, 3, kLarge);
  EXPECT_EQ(message_of<DataError>([&] { film.picture(2); }),
            path("four/render/frame_0002/marker.png") + ": has 4 x 6 pixels, the first image 8 x 6");
}

TEST(FilmTimes, AreThoseOfTheMotionSlowedByARoundNumber) {
  const FilmTimes times = film_times({0.0, 0.01, 0.02, 0.04}, 4, 0.0);
  EXPECT_EQ(times.slower, 10.0) << "0.01 s become 0.1 s";
  EXPECT_THAT(times.seconds, Pointwise(DoubleNear(1e-12), {0.1, 0.1, 0.2, 0.2}));
  EXPECT_EQ(film_times({0.0, 0.5, 1.0}, 3, 0.0).slower, 1.0);
  EXPECT_EQ(film_times({0.0, 0.001, 0.002}, 3, 0.0).slower, 100.0);
  EXPECT_EQ(film_times({0.0, 0.004, 0.008}, 3, 0.0).slower, 20.0);
  EXPECT_EQ(film_times({0.0, 0.02, 0.04}, 3, 0.0).slower, 5.0);
  EXPECT_EQ(film_times({0.0, 0.02, 0.04}, 3, 2.5).slower, 2.5);
  EXPECT_EQ(pace_text(times), "10 times slower than the motion");
  EXPECT_EQ(pace_text(film_times({0.0, 0.5, 1.0}, 3, 0.0)), "at the motion's own pace");
  EXPECT_EQ(pace_text(film_times({0.0, 0.5, 1.0}, 3, 0.25)), "4 times faster than the motion");
  EXPECT_THAT(film_times({0.0, 0.02, 0.04}, 3, 1.0).seconds, Pointwise(DoubleNear(1e-12), {0.02, 0.02, 0.02}));
}

TEST(FilmTimes, AreATenthOfASecondWhereThereAreNone) {
  const FilmTimes times = film_times({}, 3, 0.0);
  EXPECT_EQ(times.slower, 0.0);
  EXPECT_EQ(pace_text(times), "0.1 s a frame");
  EXPECT_THAT(times.seconds, ElementsAre(0.1, 0.1, 0.1));
  EXPECT_EQ(message_of<DataError>([] {
              film_times({0.0, 0.1, 0.1}, 3, 0.0);
            }),
            "frame 2 is at 0.1 s, not later than the one before");
}

}  // namespace film_test
}  // namespace tacipc
