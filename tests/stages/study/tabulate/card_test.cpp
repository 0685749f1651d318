#include "stages/study/tabulate/card.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace card_test {

/// What identify and sim2real leave, as far as a card reads it.
struct Folders {
  ScratchFolder scratch;
  std::filesystem::path fit = scratch / "fit", shots = scratch / "shots";

  Folders() {
    for (const auto& folder : {fit, shots / "calibrate", shots / "metrics" / "ours", shots / "comparison"})
      std::filesystem::create_directories(folder);
    write_file(fit / "table.md", "| gel | value |\n");
    write_file(fit / "identify.yaml",
               "stage: identify\nsummary:\n  unknowns:\n    - {name: youngs_modulus_pa, value: 1.0e+5}\n");
    write_file(fit / "curve_ball.svg", "<svg/>");
    write_file(shots / "calibrate" / "calibrate.yaml",
               "summary:\n  photographs: 22\n  model: both\n  held_out_rmse_codes: {lamps: 7.5, both: 5.5}\n");
    write_file(shots / "metrics" / "ours" / "samples.csv",
               "name,region,mae,mse,psnr_db,ssim_s\na/a_1.png,full,0.1,0.0004,30,0.9\na/"
               "a_1.png,box,0.02,0.0004,31.5,0.91\na/a_1.0.png,box,0.02,0.0004,31.5,0.92\n");
    std::filesystem::create_directories(shots / "cases");
    write_file(shots / "cases" / "known_objects.yaml",
               "objects:\n  - {name: a, photograph: a_1.0_real.png, frame: 4}\n");
    write_file(shots / "comparison" / "sheet.png", "png");
  }
};

CardConfig config() {
  return config_from_text<CardConfig>("title: a gel\nabout: Of two pads.\nmechanics: [g.yaml]\nphotographs: [s.yaml]\n",
                                      "card.yaml");
}

TEST(Card, PutsFitsPredictionsAndMeasurementsOnOnePage) {
  const Folders folders;
  const Card card = make_card(config(), {{.name = "g", .path = folders.fit}}, {read_card_images("s", folders.shots)});
  for (const char* part :
       {"# Blind card: a gel\n", "Of two pads.", "## Mechanics: g\n\n| gel | value |\n",
        "![curve_ball](g_curve_ball.svg)", "Light fitted on 22 photographs of balls and those marked as fitted",
        "have an error of 5.5 codes",
        // √0.0004 of 255 codes
        "| a/a_1.png | predicted | 5.5 | 5.1 | 0.910 | 0.0200 | 31.50 |", "| a/a_1.0.png | fitted | 5.5 |",
        "![s](s_sheet.png)"})
    EXPECT_THAT(card.page, testing::HasSubstr(part));
  EXPECT_EQ(card.pictures.at("s_sheet.png"), folders.shots / "comparison" / "sheet.png");
  const std::string yaml = to_yaml(card.values);
  EXPECT_THAT(yaml, testing::HasSubstr("youngs_modulus_pa"));
  EXPECT_THAT(yaml, testing::HasSubstr("expected_codes: 5.5"));
}

TEST(Card, SaysWhatIsNotFinished) {
  const Folders folders;
  std::filesystem::remove(folders.shots / "calibrate" / "calibrate.yaml");
  EXPECT_THAT(message_of<DataError>([&] { read_card_images("s", folders.shots); }),
              testing::HasSubstr("calibrate.yaml: does not exist: it is not finished"));
  write_file(folders.fit / "identify.yaml", "stage: identify\n");
  EXPECT_THAT(message_of<DataError>([&] { make_card(config(), {{.name = "g", .path = folders.fit}}, {}); }),
              testing::HasSubstr("identify.yaml: has no summary"));
}

TEST(CardConfig, NamesSomething) {
  EXPECT_THAT(message_of<ConfigError>([] { config_from_text<CardConfig>("title: t\n", "card.yaml"); }),
              testing::HasSubstr("neither this nor photographs are named"));
}

}  // namespace card_test
}  // namespace tacipc
