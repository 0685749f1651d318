// Makes the data sheet ("blind card") of a sensor: fitted values with their data, and held-out predictions compared
// with measurements.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/config/config.h"
#include "common/stage/named_path.h"

namespace tacipc {

/// Content of configs/studies/cards/*.yaml. Paths are relative to the file.
struct CardConfig {
  std::string title;
  std::string about;                     // sentence below the title
  std::vector<std::string> mechanics;    // identification files
  std::vector<std::string> photographs;  // photograph benchmarks

  static CardConfig read(ConfigReader& in);
};

/// One photograph: errors in the contact box.
struct CardPhotograph {
  std::string name;
  bool fitted = false;  // the light was fitted to it; for other photographs at most the position was fitted
  double rmse_codes = 0.0, ssim = 0.0, mae = 0.0, psnr_db = 0.0;
};

/// Results of a finished photograph comparison, named after its file.
struct CardImages {
  std::string name;
  std::filesystem::path folder;
  int calibrated_on = 0;              // number of ball photographs for calibration
  double predicted_rmse_codes = 0.0;  // error of the calibration photographs, each left out of the fit
  std::vector<CardPhotograph> photographs;
};
/// Reads a finished comparison.
/// \throw DataError if files are missing or lack these numbers
CardImages read_card_images(const std::string& name, const std::filesystem::path& folder);

/// The finished data sheet.
struct Card {
  std::string page;                                       // Markdown
  Value::Map values;                                      // the numbers of the page as YAML
  std::map<std::string, std::filesystem::path> pictures;  // files by the names that the page links
};
/// Makes the data sheet.
/// \param mechanics folders of finished fits of `identify`, by the names of their files
/// \throw DataError if a fit's record or table cannot be read
Card make_card(const CardConfig& config, const std::vector<NamedPath>& mechanics,
               const std::vector<CardImages>& images);

}  // namespace tacipc
