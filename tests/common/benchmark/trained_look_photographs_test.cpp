// Photographs of real sensors: every second one trains, the others are compared.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "common/base/rng.h"
#include "common/benchmark/trained_look.h"
#include "common/image/picture.h"
#include "tests/shared_data.h"

namespace tacipc {
namespace trained_look_photographs_test {

constexpr int kReduction = 2;

struct Photographs {
  FloatImage background;
  std::vector<FloatImage> images;
};

Photographs read(const std::filesystem::path& folder, const std::string& background, const std::string& beginning) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".png" && name != background && name.rfind(beginning, 0) == 0)
      files.push_back(entry.path());
  }
  std::ranges::sort(files);
  Photographs out{.background = means_over_squares(read_png(folder / background, 3), kReduction), .images = {}};
  for (const auto& file : files) out.images.push_back(means_over_squares(read_png(file, 3), kReduction));
  return out;
}

/// As depthnet disturbs images by configs/depthnet/default.yaml, without noise and shifts.
ImageLook disturbed(FloatImage background, FloatImage image, std::uint64_t draw) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto within = [&](std::uint64_t kind, double size) {
      return size * (2.0 * random_uniform(5, draw, 3 * kind + i % 3) - 1.0);
    };
    const double change = (image.pixels[i] - background.pixels[i]) * (1.0 + within(0, 0.1)) + within(1, 4.0);
    background.pixels[i] += static_cast<float>(within(2, 8.0));
    image.pixels[i] = background.pixels[i] + static_cast<float>(change);
  }
  return look_of(background, image);
}

TrainedLook trained_on(const Photographs& photographs) {
  std::vector<std::vector<ImageLook>> groups;
  for (std::size_t i = 0; i < photographs.images.size(); i += 2) {
    groups.push_back({look_of(photographs.background, photographs.images[i])});
    for (std::uint64_t draw = 0; draw < 12; ++draw)
      groups.back().push_back(disturbed(photographs.background, photographs.images[i], 100 * i + draw));
  }
  return TrainedLook::of(groups, kReduction);
}

struct Sensor {
  const char *folder, *background, *beginning;
};
std::ostream& operator<<(std::ostream& out, const Sensor& sensor) { return out << sensor.folder; }
class OfSensor : public testing::TestWithParam<Sensor> {};

TEST_P(OfSensor, DeviationsAreFoundAndPhotographsAsTrainedAreNot) {
  TACIPC_SHARED_DATA(folder, std::string("data/") + GetParam().folder);
  const Photographs all = read(folder, GetParam().background, GetParam().beginning);
  ASSERT_GE(all.images.size(), 20U);
  const TrainedLook look = trained_on(all);
  const auto deviations = [&](const auto& change) {
    std::map<std::string, int> found;
    for (std::size_t i = 1; i < all.images.size(); i += 2) {
      std::pair<FloatImage, FloatImage> pair{all.background, all.images[i]};
      change(pair, i);
      ++found[look.compare(pair.first, pair.second).deviation];
    }
    return found;
  };
  const auto turned_by = [](const ImageTurn& turn) {
    return [turn](auto& pair, std::size_t) { pair = {turned(pair.first, turn), turned(pair.second, turn)}; };
  };
  const int count = static_cast<int>(all.images.size() / 2);
  const auto nearly_all = [&](std::map<std::string, int> found, const char* deviation) {
    std::string text;
    for (const auto& [key, times] : found) text += " " + key + ": " + std::to_string(times);
    EXPECT_GE(found[deviation], (9 * count + 9) / 10) << deviation << ":" << text;
  };
  nearly_all(deviations([](auto&, std::size_t) {}), "");
  nearly_all(deviations(turned_by({.swapped = true})), "red_blue_swapped");
  nearly_all(deviations(turned_by({.left_right = true, .top_bottom = true})), "turned_180");
  nearly_all(deviations(turned_by({.left_right = true})), "mirrored_left_right");
  nearly_all(deviations([&](auto& pair, std::size_t i) { pair.first = all.images[(i + 2) % all.images.size()]; }),
             "background_touched");
  nearly_all(deviations([](auto& pair, std::size_t) {
               for (FloatImage* image : {&pair.first, &pair.second})
                 for (std::size_t k = 0; k < image->pixels.size(); k += 3) image->pixels[k] *= 0.6F;  // weak red lamps
             }),
             "other_lamps");
}
INSTANTIATE_TEST_SUITE_P(TrainedLookOfPhotographs, OfSensor,
                         testing::Values(Sensor{"gelsight_sim2real/images", "background_real.png", "calib_"},
                                         Sensor{"gelsight_objectfolder_ball4", "background.png", "frame_"},
                                         Sensor{"gsmini_balls", "background.png", "gelsight"},
                                         Sensor{"digit_ball8p8/D20641", "background.png", "frame_"}));

}  // namespace trained_look_photographs_test
}  // namespace tacipc
