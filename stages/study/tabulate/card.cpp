#include "stages/study/tabulate/card.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/benchmark/benchmark_cases.h"
#include "common/config/key_path.h"
#include "common/format/csv.h"
#include "tacipc_tabulate_texts.h"

namespace tacipc {
namespace {

constexpr double kCodes = 255.0;

Value record_of(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw DataError("{}: does not exist: it is not finished", path.string());
  return ConfigReader::from_file(path).content();
}

/// Value of a record at a key.
/// \throw DataError if there is none
const Value& at(const Value& record, const std::filesystem::path& path, const std::string& key) {
  const KeyPath found = follow(record, key);
  if (!found.rest.empty()) throw DataError("{}: has no {}", path.string(), key);
  return *found.at;
}

double number_at(const Value& record, const std::filesystem::path& path, const std::string& key) {
  double value = 0.0;
  const auto* text = std::get_if<std::string>(&at(record, path, key).data());
  if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc{})
    throw DataError("{}: {} is no number", path.string(), key);
  return value;
}

/// Photographs of known objects that calibrate in addition to the balls.
std::vector<std::string> calibrating_objects(const std::filesystem::path& folder) {
  const auto path = folder / "cases" / "known_objects.yaml";
  std::vector<std::string> files;
  if (!std::filesystem::exists(path)) return files;
  ConfigReader in = ConfigReader::from_file(path);
  for (ConfigReader& object : in.sections("objects")) files.push_back(object.text("photograph"));
  return files;
}

/// True if an image `a/b_1.0.png` belongs to a photograph `b_1.0_real.png`.
bool is_of(const std::string& image, const std::string& photograph) {
  const std::string stem = std::filesystem::path(image).stem().string();
  if (!photograph.starts_with(stem)) return false;
  const std::string rest = photograph.substr(stem.size());
  return rest.starts_with('_') || rest == std::filesystem::path(photograph).extension();
}

}  // namespace

CardConfig CardConfig::read(ConfigReader& in) {
  CardConfig out;
  out.title = in.text("title");
  out.about = in.text_or("about", "");
  out.mechanics = in.texts("mechanics");
  out.photographs = in.texts("photographs");
  if (out.mechanics.empty() && out.photographs.empty()) in.fault("mechanics", "neither this nor photographs are named");
  return out;
}

CardImages read_card_images(const std::string& name, const std::filesystem::path& folder) {
  CardImages out{.name = name, .folder = folder, .photographs = {}};
  const auto record_path = folder / "calibrate" / "calibrate.yaml";
  const Value record = record_of(record_path);
  out.calibrated_on = static_cast<int>(number_at(record, record_path, "summary.photographs"));
  const auto& model = at(record, record_path, "summary.model");
  const auto* kept = std::get_if<std::string>(&model.data());
  out.predicted_rmse_codes =
      number_at(record, record_path, "summary.held_out_rmse_codes." + (kept ? *kept : std::string()));
  const auto samples = folder / "metrics" / "ours" / "samples.csv";
  const std::vector<std::string> calibrating = calibrating_objects(folder);
  CsvReader table(samples);
  while (table.next()) {
    if (table["region"] != "box") continue;
    const std::string image = table["name"];
    out.photographs.push_back(
        {.name = image,
         .fitted = std::ranges::any_of(calibrating, [&](const std::string& file) { return is_of(image, file); }),
         .rmse_codes = kCodes * std::sqrt(table.number("mse")),
         .ssim = table.number("ssim_s"),
         .mae = table.number("mae"),
         .psnr_db = table.number("psnr_db")});
  }
  if (out.photographs.empty()) throw DataError("{}: has no photograph with a contact box", samples.string());
  return out;
}

Card make_card(const CardConfig& config, const std::vector<NamedPath>& mechanics,
               const std::vector<CardImages>& images) {
  Card out;
  out.page = fmt::format("# Blind card: {}\n\n", config.title);
  if (!config.about.empty()) out.page += config.about + "\n\n";
  out.page += kCardAbout;
  Value::Map fits, compared;
  for (const auto& [name, folder] : mechanics) {
    out.page += fmt::format("\n## Mechanics: {}\n\n{}", name, read_file(folder / "table.md"));
    const Value record = record_of(folder / "identify.yaml");
    fits.emplace_back(name, at(record, folder / "identify.yaml", "summary"));
    std::vector<std::filesystem::path> plots;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".svg") plots.push_back(entry.path());
    std::ranges::sort(plots);
    out.page += '\n';
    for (const auto& plot : plots) {
      const std::string picture = name + "_" + plot.filename().string();
      out.pictures[picture] = plot;
      out.page += fmt::format("![{}]({})\n", plot.stem().string(), picture);
    }
  }
  for (const CardImages& i : images) {
    out.page += fmt::format(kCardImages, i.name, i.calibrated_on,
                            std::ranges::any_of(i.photographs, [](const CardPhotograph& p) { return p.fitted; })
                                ? " and those marked as fitted"
                                : "",
                            i.predicted_rmse_codes);
    Value::List rows;
    for (const CardPhotograph& p : i.photographs) {
      out.page += fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.3f} | {:.4f} | {:.2f} |\n", p.name,
                              p.fitted ? "fitted" : "predicted", i.predicted_rmse_codes, p.rmse_codes, p.ssim, p.mae,
                              p.psnr_db);
      rows.emplace_back(Value::Map{{"photograph", p.name},
                                   {"fitted", p.fitted},
                                   {"error_codes", p.rmse_codes},
                                   {"ssim_s", p.ssim},
                                   {"mae", p.mae},
                                   {"psnr_db", p.psnr_db}});
    }
    const std::string picture = i.name + "_sheet.png";
    out.pictures[picture] = i.folder / "comparison" / "sheet.png";
    out.page += fmt::format("\nPhotograph, ours, twice the difference, the depth-based method:\n\n![{}]({})\n", i.name,
                            picture);
    compared.emplace_back(i.name, Value::Map{{"calibrated_on", i.calibrated_on},
                                             {"expected_codes", i.predicted_rmse_codes},
                                             {"photographs", std::move(rows)}});
  }
  out.values.emplace_back("title", config.title);
  if (!fits.empty()) out.values.emplace_back("mechanics", std::move(fits));
  if (!compared.empty()) out.values.emplace_back("images", std::move(compared));
  return out;
}

}  // namespace tacipc
