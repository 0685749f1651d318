#include "stages/dataset/report/verdict.h"

#include <functional>

#include "stages/dataset/report/html.h"
#include "stages/dataset/report/sample.h"

namespace tacipc {
namespace {

struct Extreme {
  double value;
  std::optional<int> frame;
};

/// Worst value of a summary's number and the frames' own, with its frame.
template <typename Number, typename Worse>
std::optional<Extreme> extreme(std::optional<double> in_summary, const std::vector<FrameReport>& frames,
                               Number&& number, Worse&& worse) {
  std::optional<Extreme> found;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::optional<double> value = number(frames[i]);
    if (value && (!found || worse(*value, found->value))) found = Extreme{*value, static_cast<int>(i)};
  }
  if (in_summary && (!found || worse(*in_summary, found->value))) found = Extreme{*in_summary, std::nullopt};
  return found;
}

std::string with_unit(double value, double scale, const char* unit) { return number_text(value, scale) + unit; }

CheckReport at_most(int count, const char* name, int limit) {
  return {name, count_text(count), count_text(limit), std::nullopt, count <= limit};
}

CheckReport above(const char* name, const Extreme& smallest, double limit, double scale, const char* unit) {
  const std::string text = limit == 0.0 ? "0" : with_unit(limit, scale, unit);
  return {name, with_unit(smallest.value, scale, unit), "above " + text, smallest.frame, smallest.value > limit};
}

}  // namespace

CountLimits count_limits(const RecordLines<PressSummary>& summary) {
  const auto limits = summary.section(&PressSummary::limits);
  return {.intersections = limits.find(&PressLimits::intersections).value_or(0),
          .inverted_tets = limits.find(&PressLimits::inverted_tets).value_or(0)};
}

std::vector<CheckReport> checks_of(const RecordLines<PressSummary>& summary, const std::vector<FrameReport>& frames) {
  using Lines = PressSummary;
  const bool converged = summary.required(&Lines::converged);
  std::vector<CheckReport> checks;
  checks.push_back({"Newton's method", converged ? "converged" : "did not converge", "converged in every frame",
                    std::nullopt, converged});
  const auto limits = summary.section(&Lines::limits);
  const CountLimits counts = count_limits(summary);
  checks.push_back(
      at_most(summary.required(&Lines::intersections), "triangle pairs that intersect", counts.intersections));
  checks.push_back(
      at_most(summary.required(&Lines::inverted_tets), "tetrahedra that are inverted", counts.inverted_tets));
  if (const auto gap = extreme(
          summary.find(&Lines::min_distance_m), frames, [](const FrameReport& f) { return f.min_gap_m; },
          std::less<>()))
    checks.push_back(
        above("smallest distance", *gap, limits.find(&PressLimits::smallest_distance_m).value_or(0.0), 1e6, " µm"));
  const auto ratio = extreme(
      summary.required(&Lines::min_volume_ratio), frames,
      [](const FrameReport& f) { return std::optional(f.min_volume_ratio); }, std::less<>());
  checks.push_back(
      above("smallest volume ratio", *ratio, limits.find(&PressLimits::volume_ratio).value_or(0.0), 1, ""));
  const auto balance = extreme(
      summary.find(&Lines::max_balance_relative), frames, [](const FrameReport& f) { return f.balance_relative; },
      std::greater<>());
  if (const auto limit = limits.find(&PressLimits::balance_relative); balance && limit) {
    std::string text = with_unit(*limit, 100, " %");
    if (const auto smallest_n = limits.find(&PressLimits::smallest_contact_n))
      text += ", or " + with_unit(*limit * *smallest_n, 1e6, " µN");
    checks.push_back({"force imbalance", with_unit(balance->value, 100, " % of the contact force"), text,
                      balance->frame, balance->value <= *limit});
  }
  const auto pose = extreme(
      summary.find(&Lines::max_pose_error_m), frames, [](const FrameReport& f) { return f.pose_error_m; },
      std::greater<>());
  if (const auto limit = limits.find(&PressLimits::pose_error_m); pose && limit) {
    checks.push_back({"distance from the asked pose", with_unit(pose->value, 1e9, " nm"), with_unit(*limit, 1e9, " nm"),
                      pose->frame, pose->value <= *limit});
  }
  return checks;
}

FailedCheck read_failed_check(const Record& failed) {
  FailedCheck result{.message = failed.text("message").value_or(""), .check = std::nullopt};
  if (const auto name = failed.text("check")) {
    const auto as_written = [&](const char* key) { return failed.text(key).value_or("–"); };
    result.check = CheckReport{*name, as_written("value"), as_written("limit"), failed.count("frame"), false};
  }
  return result;
}

}  // namespace tacipc
