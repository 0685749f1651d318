#include "stages/report/verdict.h"

#include <fmt/core.h>

#include <functional>

#include "stages/report/html.h"
#include "stages/report/sample.h"

namespace tacipc {
namespace {

struct Extreme {
  double value;
  std::optional<int> frame;
};

/// The worst of a summary's number and the frames' own, with the frame where it occurred.
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

CheckReport none_allowed(const Record& summary, const char* key, const char* name) {
  const int count = summary.required_count(key);
  return {name, count_text(count), "0", std::nullopt, count == 0};
}

}  // namespace

std::vector<CheckReport> checks_of(const Record& summary, const std::vector<FrameReport>& frames) {
  const bool converged = summary.required_flag("converged");
  std::vector<CheckReport> checks;
  checks.push_back({"Newton's method", converged ? "converged" : "did not converge", "converged in every frame",
                    std::nullopt, converged});
  checks.push_back(none_allowed(summary, "intersections", "triangle pairs that intersect"));
  checks.push_back(none_allowed(summary, "inverted_tets", "tetrahedra that are inverted"));
  const auto gap = extreme(
      summary.required_number("min_distance_m"), frames,
      [](const FrameReport& f) { return std::optional(f.min_gap_m); }, std::less<>());
  checks.push_back({"smallest distance", with_unit(gap->value, 1e6, " µm"), "above 0", gap->frame, gap->value > 0});
  const auto ratio = extreme(
      summary.required_number("min_volume_ratio"), frames,
      [](const FrameReport& f) { return std::optional(f.min_volume_ratio); }, std::less<>());
  checks.push_back(
      {"smallest volume ratio", with_unit(ratio->value, 1, ""), "above 0", ratio->frame, ratio->value > 0});
  const auto balance = extreme(
      summary.number("max_balance_relative"), frames, [](const FrameReport& f) { return f.balance_relative; },
      std::greater<>());
  if (balance) {
    checks.push_back({"force imbalance", with_unit(balance->value, 100, " % of the contact force"),
                      with_unit(kMaxBalanceRelative, 100, " %, or 1e-5 N"), balance->frame,
                      balance->value <= kMaxBalanceRelative});
  }
  const auto pose = extreme(
      summary.number("max_pose_error_m"), frames, [](const FrameReport& f) { return f.pose_error_m; },
      std::greater<>());
  if (pose) {
    checks.push_back({"distance from the asked pose", with_unit(pose->value, 1e9, " nm"),
                      with_unit(kMaxPoseErrorM, 1e9, " nm"), pose->frame, pose->value <= kMaxPoseErrorM});
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
