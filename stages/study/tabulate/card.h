// The blind card of a sensor: what was fitted on what, and predictions of what was not, with what was measured beside.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/config/config.h"
#include "common/stage/named_path.h"

namespace tacipc {

/// configs/studies/cards/gelsight_mini.yaml and files like it. Paths are relative to the file.
struct CardConfig {
  std::string title;
  std::string about;                     // a sentence below the title
  std::vector<std::string> mechanics;    // files of `identify`
  std::vector<std::string> photographs;  // benchmarks of `sim2real`

  static CardConfig read(ConfigReader& in);
};

/// One photograph: errors in the contact box.
struct CardPhotograph {
  std::string name;
  bool fitted = false;  // the light learnt from it; to others nothing was fitted but, at most, the place
  double rmse_codes = 0.0, ssim = 0.0, mae = 0.0, psnr_db = 0.0;
};

/// A finished comparison of `sim2real`, by the name of its file.
struct CardImages {
  std::string name;
  std::filesystem::path folder;
  int calibrated_on = 0;              // photographs of balls
  double predicted_rmse_codes = 0.0;  // error of those that calibrate, each left out of the fit
  std::vector<CardPhotograph> photographs;
};
/// \throw DataError if files are missing or say nothing of it
CardImages read_card_images(const std::string& name, const std::filesystem::path& folder);

struct Card {
  std::string page;                                       // Markdown
  Value::Map values;                                      // the same as YAML
  std::map<std::string, std::filesystem::path> pictures;  // by the names that the page links
};
/// \param mechanics folders of finished fits of `identify`, by the names of their files
/// \throw DataError if a fit's record or table cannot be read
Card make_card(const CardConfig& config, const std::vector<NamedPath>& mechanics,
               const std::vector<CardImages>& images);

}  // namespace tacipc
