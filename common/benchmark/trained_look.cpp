#include "common/benchmark/trained_look.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/benchmark/unet.h"

namespace tacipc {
namespace {

constexpr int kFormat = 1;
constexpr double kLeastChangeCodes = 1.0;
/// Limits of pattern, relief, level, shading (units of image_look.h). Photographs of an untouched gel over an hour
/// differ by 8 in the pattern and by 3 at sharp edges of the relief; contacts vary more than any training set.
constexpr std::array<LookSpread::Limits, kLookParts.size()> kLimits{{{1.5, 12.0}, {1.5, 2.0}, {1.5, 4.5}, {2.0, 4.0}}};
constexpr double kTouchedPattern = 1.8;  // limit of pattern over relief distance; beyond it the whole image differs
constexpr double kClearly = 0.8;         // factor by which a less likely explanation must reduce the distance
constexpr std::size_t kNamesInMessage = 3;

double largest(const std::array<double, kLookParts.size()>& distances) { return *std::ranges::max_element(distances); }

std::size_t index_of(LookPart part) { return static_cast<std::size_t>(part); }

struct NamedTurn {
  ImageTurn turn;
  std::string key, words;
};

/// Image that was transformed: the background, the image, or both.
struct NamedSide {
  bool background, image;
  const char* key;
  const char* words;
};
constexpr NamedSide kSides[] = {{true, true, "", "the image and its background have "},
                                {false, true, "image_", "the image, not its background, has "},
                                {true, false, "background_", "the background, not the image, has "}};

/// Returns transformations that keep the size, likely ones first.
std::vector<NamedTurn> turns_of(const FloatImage& image) {
  std::vector<NamedTurn> turns{{{.left_right = true, .top_bottom = true}, "turned_180", "been turned by 180°"},
                               {{.left_right = true}, "mirrored_left_right", "been mirrored left to right"},
                               {{.top_bottom = true}, "mirrored_top_bottom", "been mirrored top to bottom"}};
  if (image.width == image.height) {
    const char* const about = "been mirrored about a diagonal";
    turns.push_back({{.transposed = true, .left_right = true}, "turned_90", "been turned by 90°"});
    turns.push_back({{.transposed = true, .top_bottom = true}, "turned_270", "been turned by 270°"});
    turns.push_back({{.transposed = true}, "mirrored_diagonally", about});
    turns.push_back({{.transposed = true, .left_right = true, .top_bottom = true}, "mirrored_diagonally", about});
  }
  const std::size_t count = turns.size();
  const NamedTurn swap{{.swapped = true}, "red_blue_swapped", "red and blue swapped"};
  for (std::size_t i = 0; i < count; ++i) {
    NamedTurn both = turns[i];
    both.turn.swapped = true;
    both.key = swap.key + "_" + both.key;
    both.words = swap.words + " and " + both.words;
    turns.push_back(std::move(both));
  }
  turns.insert(turns.begin(), swap);
  return turns;
}

}  // namespace

TrainedLook TrainedLook::of(const std::vector<std::vector<ImageLook>>& groups, int reduction) {
  TrainedLook trained;
  trained.reduction_ = reduction;
  trained.least_change_codes_ = std::numeric_limits<double>::infinity();
  for (const auto& group : groups)
    for (const ImageLook& look : group)
      if (look.change_codes >= kLeastChangeCodes)
        trained.least_change_codes_ = std::min(trained.least_change_codes_, look.change_codes);
  if (!std::isfinite(trained.least_change_codes_)) trained.least_change_codes_ = kLeastChangeCodes;
  double count = 0.0;
  trained.relief_ = Eigen::VectorXd::Zero(kLookSizes[index_of(LookPart::relief)]);
  for (const auto& group : groups)
    for (const ImageLook& look : group) {
      trained.relief_ += look[LookPart::relief];
      ++count;
    }
  trained.relief_ /= count;
  for (std::size_t part = 0; part < kLookParts.size(); ++part) {
    std::vector<Eigen::MatrixXd> rows;
    for (const auto& group : groups) {
      std::vector<Eigen::VectorXd> told;
      for (const ImageLook& look : group)
        if (auto numbers = trained.numbers_of(part, look)) told.push_back(std::move(*numbers));
      if (told.empty()) continue;
      rows.emplace_back(static_cast<Eigen::Index>(told.size()), told.front().size());
      for (std::size_t row = 0; row < told.size(); ++row)
        rows.back().row(static_cast<Eigen::Index>(row)) = told[row].transpose();
    }
    if (!rows.empty()) trained.spreads_[part] = LookSpread::of(rows, kLimits[part]);
  }
  return trained;
}

std::optional<Eigen::VectorXd> TrainedLook::numbers_of(std::size_t part, const ImageLook& look) const {
  if (look.parts[part].size() == 0) return std::nullopt;
  if (part == index_of(LookPart::shading) && look.change_codes < least_change_codes_) return std::nullopt;
  if (part == index_of(LookPart::relief)) return roughness_of(look.parts[part] - relief_);
  return look.parts[part];
}

TrainedLook::Distances TrainedLook::distances(const ImageLook& look) const {
  Distances out{};
  for (std::size_t part = 0; part < kLookParts.size(); ++part)
    if (const auto numbers = numbers_of(part, look); numbers && spreads_[part])
      out[part] = spreads_[part]->distance(*numbers);
  return out;
}

LookComparison TrainedLook::compare(const FloatImage& background, const FloatImage& image) const {
  const Distances parts = distances(look_of(background, image));
  const double distance = largest(parts), background_distance = std::max(parts[0], parts[1]);
  if (distance <= 1.0) return {.distance = distance};
  LookComparison best;
  for (const NamedTurn& turn : turns_of(image)) {
    const FloatImage other_background = turned(background, turn.turn), other_image = turned(image, turn.turn);
    const double other_distance = largest(distances(look_of(other_background)));
    for (const NamedSide& side : kSides) {
      const double limit = best.undone ? kClearly * *best.undone : 1.0;
      if ((side.background ? other_distance : background_distance) >= limit) continue;
      const double undone = largest(
          distances(look_of(side.background ? other_background : background, side.image ? other_image : image)));
      if (undone < limit) best = {distance, side.key + turn.key, side.words + turn.words, undone};
    }
  }
  return best.undone ? best : unexplained(parts);
}

LookComparison TrainedLook::unexplained(const Distances& parts) {
  const auto of = [&](LookPart part) { return parts[index_of(part)]; };
  const double distance = largest(parts);
  if (of(LookPart::relief) > 1.0 && of(LookPart::pattern) < kTouchedPattern * of(LookPart::relief))
    return {distance, "background_touched", "something touches the gel in the background, or it is another gel", {}};
  if (of(LookPart::pattern) > 1.0 || of(LookPart::relief) > 1.0)
    return {distance, "other_lamps", "the background has other lamps, another exposure or another field of view", {}};
  if (of(LookPart::level) > 1.0)
    return {distance, "other_exposure", "the image differs from its background also where nothing touches", {}};
  return {distance, "other_shading", "what touches is shaded otherwise: other lamps, or another depth", {}};
}

std::string TrainedLook::to_text() const {
  Value::Map lines{{"format", kFormat}, {"reduction", reduction_}, {"least_change_codes", least_change_codes_}};
  Value::List relief;
  for (const double number : relief_) relief.emplace_back(std::round(100.0 * number) / 100.0);
  lines.emplace_back("mean_relief", std::move(relief));
  for (std::size_t part = 0; part < kLookParts.size(); ++part)
    if (spreads_[part]) lines.emplace_back(kLookParts[part], spreads_[part]->to_value());
  return to_yaml(lines);
}

TrainedLook TrainedLook::from_text(const std::string& text, const std::string& name) {
  TrainedLook trained;
  try {
    ConfigReader in = ConfigReader::from_text(text, name);
    in.integer("format", kFormat, kFormat);
    trained.reduction_ = in.integer("reduction", 1, NetworkConfig::kMostReduction);
    trained.least_change_codes_ = in.number("least_change_codes", Range::positive());
    const std::vector<double> relief =
        in.numbers("mean_relief", kLookSizes[index_of(LookPart::relief)], Range::between(-1e6, 1e6));
    trained.relief_ = Eigen::Map<const Eigen::VectorXd>(relief.data(), static_cast<Eigen::Index>(relief.size()));
    for (std::size_t part = 0; part < kLookParts.size(); ++part) {
      const bool needed = part != index_of(LookPart::shading);
      if (!needed && !in.has(kLookParts[part])) continue;
      trained.spreads_[part] =
          in.read<LookSpread>(kLookParts[part], part == index_of(LookPart::relief) ? kRoughnessSize : kLookSizes[part]);
    }
    in.finish();
  } catch (const ConfigError&) {
    throw DataError("{}: its statistics of the training images are damaged", name);
  }
  return trained;
}

void LookReport::add(const std::string& name, const LookComparison& comparison) {
  ++images_;
  farthest_ = std::max(farthest_, comparison.distance);
  if (comparison.deviation.empty()) return;
  Group& group = groups_[comparison.deviation];
  if (group.names.empty()) group.least = comparison.distance;
  group.meaning = comparison.meaning;
  group.names.push_back(name);
  group.least = std::min(group.least, comparison.distance);
  group.most = std::max(group.most, comparison.distance);
  if (comparison.undone) group.most_undone = std::max(group.most_undone.value_or(0.0), *comparison.undone);
}

std::size_t LookReport::unlike() const {
  std::size_t sum = 0;
  for (const auto& [deviation, group] : groups_) sum += group.names.size();
  return sum;
}

std::vector<std::string> LookReport::warnings(const std::string& what) const {
  std::vector<const Group*> sorted;
  for (const auto& [deviation, group] : groups_) sorted.push_back(&group);
  std::ranges::stable_sort(sorted, std::greater(), [](const Group* group) { return group->names.size(); });
  std::vector<std::string> lines;
  for (const Group* group : sorted) {
    std::string names;
    for (std::size_t i = 0; i < std::min(kNamesInMessage, group->names.size()); ++i)
      names += (i > 0 ? ", " : "") + group->names[i];
    if (group->names.size() > kNamesInMessage) names += ", …";
    std::string far = fmt::format("{:.1f}", group->least);
    if (fmt::format("{:.1f}", group->most) != far) far += fmt::format(" to {:.1f}", group->most);
    lines.push_back(fmt::format("{} of {} {} ({}) are unlike those of the training, at {} times its limit: {}{}",
                                group->names.size(), images_, what, names, far, group->meaning,
                                group->most_undone ? fmt::format("; undone, at {:.1f}", *group->most_undone) : ""));
  }
  return lines;
}

Value::Map LookReport::summary() const {
  Value::Map deviations;
  for (const auto& [deviation, group] : groups_) deviations.emplace_back(deviation, group.names.size());
  return {{"images", unlike()}, {"of", images_}, {"largest_distance", farthest_}, {"deviations", deviations}};
}

}  // namespace tacipc
