#include "stages/comparison/method_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <sstream>

#include "common/error.h"
#include "common/files.h"

namespace tacipc {
namespace {

constexpr std::array<const char*, 4> kColumns{"ssim_s", "ssim_w", "mae", "psnr_db"};

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

std::string cells(const Score& s) {
  return fmt::format("{:.3f} | {:.3f} | {:.4f} | {:.2f}", s.ssim_s, s.ssim_w, s.mae, s.psnr_db);
}

}  // namespace

MethodScores read_scores(const std::filesystem::path& samples, const std::string& name, const BenchmarkCases& cases) {
  std::istringstream text(read_file(samples));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = fields_of(line);
  std::array<std::size_t, 4> column{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto place = std::find(header.begin(), header.end(), kColumns[k]);
    if (place == header.end()) throw DataError("{}: has no column {}", samples.string(), kColumns[k]);
    column[k] = static_cast<std::size_t>(place - header.begin());
  }
  std::map<std::pair<std::string, std::string>, Score> found;  // file name and region
  while (std::getline(text, line)) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != header.size())
      throw DataError("{}: a row has {} fields, the header {}", samples.string(), fields.size(), header.size());
    const auto value = [&](std::size_t k) { return std::strtod(fields[column[k]].c_str(), nullptr); };
    found[{std::filesystem::path(fields[0]).stem().string(), fields[1]}] = {value(0), value(1), value(2), value(3)};
  }
  MethodScores scores{.name = name, .box = {}, .full = {}};
  for (const ObjectCase& object : cases.objects)
    for (const PhotographCase& image : object.images)
      for (const char* region : {"box", "full"}) {
        const auto place = found.find({image.name, region});
        if (place == found.end()) throw DataError("{}: has no row for {} ({})", samples.string(), image.name, region);
        (std::string(region) == "box" ? scores.box : scores.full).push_back(place->second);
      }
  return scores;
}

Score mean_of(const std::vector<Score>& scores) {
  Score mean;
  const auto n = static_cast<double>(scores.size());
  for (const Score& s : scores) {
    mean.ssim_s += s.ssim_s / n;
    mean.ssim_w += s.ssim_w / n;
    mean.mae += s.mae / n;
    mean.psnr_db += s.psnr_db / n;
  }
  return mean;
}

Verdict judge(const std::vector<MethodScores>& methods, const BenchmarkCases& cases) {
  const Score ours = mean_of(methods.front().box);
  const auto& must = cases.must;
  Verdict verdict{.musts = !must || (ours.ssim_s >= (*must)[0] && ours.mae <= (*must)[1] && ours.psnr_db >= (*must)[2]),
                  .ahead = true};
  for (std::size_t m = 1; m < methods.size(); ++m) {
    const Score other = mean_of(methods[m].box);
    verdict.ahead = verdict.ahead && ours.ssim_s > other.ssim_s && ours.mae < other.mae && ours.psnr_db > other.psnr_db;
  }
  return verdict;
}

std::string to_markdown(const std::vector<MethodScores>& methods, const BenchmarkCases& cases) {
  const Verdict verdict = judge(methods, cases);
  std::string text = fmt::format(
      "| {} | SSIM-S | SSIM-W | MAE | PSNR dB | whole image: SSIM-S | SSIM-W | MAE | PSNR dB "
      "|\n|---|---|---|---|---|---|---|---|---|\n",
      cases.title);
  for (const MethodScores& method : methods)
    text += fmt::format("| {} | {} | {} |\n", method.name, cells(mean_of(method.box)), cells(mean_of(method.full)));
  text += fmt::format("\nMeans over {} photographs; the first four columns in the contact box. ",
                      methods.front().box.size());
  if (const auto& must = cases.must)
    text += fmt::format("Required of the first row there: SSIM-S {}, MAE {}, PSNR {} dB{}; ahead of ", (*must)[0],
                        (*must)[1], (*must)[2], verdict.musts ? " (holds)" : " (**missed**)");
  else
    text += "The first row there is ahead of ";
  text += fmt::format("every other row on {}: {}.\n", cases.must ? "the three" : "SSIM-S, MAE and PSNR",
                      verdict.ahead ? "yes" : "**no**");
  text += "\n| image, in the box |";
  for (const MethodScores& method : methods) text += fmt::format(" {}: SSIM-S | SSIM-W | MAE | PSNR dB |", method.name);
  text += "\n|---|";
  for (std::size_t m = 0; m < methods.size(); ++m) text += "---|---|---|---|";
  text += '\n';
  std::size_t i = 0;
  for (const ObjectCase& object : cases.objects)
    for (const PhotographCase& image : object.images) {
      text += fmt::format("| {}{} |", image.name, image.name == object.fit_image ? " (fitted place)" : "");
      for (const MethodScores& method : methods) text += fmt::format(" {} |", cells(method.box[i]));
      text += '\n';
      ++i;
    }
  return text;
}

}  // namespace tacipc
