#include "stages/dataset/report/press_curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <functional>

#include "common/format/html_text.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/html.h"

namespace tacipc {
namespace {

/// Limit of marks; more would hide the line.
constexpr std::size_t kMaxMarks = 40;

/// Curve of one number per frame, with a mark on each frame if there are few.
template <typename Number>
Curve curve_of(const std::vector<FrameReport>& frames, const char* unit, Number&& number) {
  Curve curve;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    curve.values.push_back(number(frames[i]));
    if (frames.size() <= kMaxMarks)
      curve.titles.push_back(fmt::format("frame {}: {} {}", i, number_text(curve.values.back()), unit));
  }
  return curve;
}

bool has_values(const Curve& curve) {
  return std::any_of(curve.values.begin(), curve.values.end(), [](const auto& value) { return value.has_value(); });
}

/// Frame number at a time, interpolated between two frames.
std::optional<double> frame_at(const std::vector<FrameReport>& frames, double time_s) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto before = frames[i - 1].time_s, after = frames[i].time_s;
    if (before && after && *before <= time_s && time_s <= *after && *after > *before)
      return static_cast<double>(i - 1) + (time_s - *before) / (*after - *before);
  }
  return std::nullopt;
}

Chart over_frames(const SampleReport& sample, const std::string& what) {
  Chart chart;
  chart.what = what + " over frames";
  chart.x_label = "frame";
  chart.whole_x = true;
  for (std::size_t i = 0; i < sample.frames.size(); ++i) chart.x.push_back(static_cast<double>(i));
  for (const PhaseReport& phase : sample.phases) {
    if (phase.first > 0) chart.bands.push_back({phase.name, phase.first - 1.0, static_cast<double>(phase.last)});
  }
  return chart;
}

void add_slip(Chart& chart, const SampleReport& sample) {
  for (const auto& [name, time_s] :
       {std::pair{"first slip", sample.first_slip_time_s}, std::pair{"gross slip", sample.gross_slip_time_s}}) {
    if (!time_s) continue;
    if (const auto at = frame_at(sample.frames, *time_s)) chart.places.push_back({name, *at});
  }
}

/// True for a twist, which appears in the torque, not in the forces.
bool turns(const SampleReport& sample) {
  return std::any_of(sample.phases.begin(), sample.phases.end(),
                     [](const PhaseReport& phase) { return phase.name == "twist" || phase.name == "path"; });
}

std::string force_curves(const SampleReport& sample) {
  Chart chart = over_frames(sample, "forces");
  chart.left_label = "force (N)";
  chart.left.push_back(
      curve_of(sample.frames, "N into the gel", [](const auto& f) { return std::optional(f.press_force_n); }));
  std::string caption = "<b>Forces</b>: " + curve_key(1) + "press";
  Curve tangential = curve_of(sample.frames, "N along the face", [](const auto& f) { return f.tangential_force_n; });
  if (has_values(tangential)) {
    chart.left.push_back(std::move(tangential));
    caption += ", " + curve_key(2) + "tangential";
  }
  Curve torque = curve_of(sample.frames, "N mm about z", [](const auto& f) {
    return f.torque_z_n_m ? std::optional(1e3 * *f.torque_z_n_m) : std::nullopt;
  });
  if (turns(sample) && has_values(torque)) {
    chart.right_label = "torque about z (N mm)";
    chart.right.push_back(std::move(torque));
    caption += ", " + curve_key(static_cast<int>(chart.left.size()) + 1) + "torque";
  }
  add_slip(chart, sample);
  std::string stretches;
  for (const PhaseReport& phase : sample.phases) {
    stretches += fmt::format(
        "{}{} {}", stretches.empty() ? "" : ", ", html_text(phase.name),
        phase.first == phase.last ? fmt::format("{}", phase.first) : fmt::format("{}–{}", phase.first, phase.last));
  }
  return figure(chart, caption + (stretches.empty() ? "" : "<br>Frames: " + stretches));
}

std::string contact_curves(const SampleReport& sample) {
  Chart chart = over_frames(sample, "contact area and mean pressure");
  chart.left_label = "contact area (mm²)";
  chart.right_label = "mean pressure (kPa)";
  chart.left.push_back(curve_of(sample.frames, "mm²", [](const auto& f) { return f.contact_area_mm2; }));
  chart.right.push_back(curve_of(sample.frames, "kPa", [](const auto& f) {
    return f.mean_pressure_pa ? std::optional(1e-3 * *f.mean_pressure_pa) : std::nullopt;
  }));
  if (!has_values(chart.left.front()) || !has_values(chart.right.front())) return "";
  return figure(chart, "<b>Contact</b>: " + curve_key(1) + "area, " + curve_key(2) + "mean pressure");
}

std::string ratio_curve(const SampleReport& sample) {
  if (!(sample.friction_coefficient.value_or(0.0) > 0.0)) return "";
  double largest_n = 0.0;
  for (const FrameReport& frame : sample.frames) largest_n = std::max(largest_n, frame.press_force_n);
  // The ratio is noise for a force near zero.
  const double enough_n = 0.01 * largest_n;
  Chart chart = over_frames(sample, "tangential over press force");
  chart.left_label = "tangential / press force";
  chart.left.push_back(curve_of(sample.frames, "", [&](const auto& f) -> std::optional<double> {
    if (!f.tangential_force_n || !(f.press_force_n > enough_n)) return std::nullopt;
    return *f.tangential_force_n / f.press_force_n;
  }));
  if (!has_values(chart.left.front())) return "";
  chart.limit =
      Rule{fmt::format("friction coefficient {:g}", *sample.friction_coefficient), *sample.friction_coefficient};
  add_slip(chart, sample);
  return figure(chart, "<b>Tangential over press force</b>; on the dashed line everything slips");
}

std::string balance_curve(const SampleReport& sample) {
  Chart chart = over_frames(sample, "force balance");
  chart.left_label = "imbalance / contact force";
  chart.logarithmic = true;
  chart.left.push_back(
      curve_of(sample.frames, "of the contact force", [](const auto& f) { return f.balance_relative; }));
  if (!has_values(chart.left.front())) return "";
  if (sample.balance_limit) chart.limit = Rule{"limit", *sample.balance_limit};
  std::string caption = "<b>Force balance</b>: what contact, inertia and mount leave over";
  const auto worst = std::max_element(sample.frames.begin(), sample.frames.end(), [](const auto& a, const auto& b) {
    return a.balance_n.value_or(0.0) < b.balance_n.value_or(0.0);
  });
  if (worst->balance_n) {
    caption += fmt::format(", at most {} N (frame {})", number_text(worst->balance_n), worst - sample.frames.begin());
  }
  return figure(chart, caption);
}

struct Column {
  const char* heading;
  std::function<std::string(const FrameReport&)> text;  // "–" if the frame has no such number
};

std::vector<Column> columns() {
  const auto number = [](auto member, double scale) {
    return [=](const FrameReport& frame) { return number_text(frame.*member, scale); };
  };
  const auto count = [](auto member) { return [=](const FrameReport& frame) { return count_text(frame.*member); }; };
  using F = FrameReport;
  return {{"phase", [](const F& f) { return f.phase.empty() ? std::string("–") : html_text(f.phase); }},
          {"time s", number(&F::time_s, 1)},
          {"depth mm", number(&F::depth_m, 1e3)},
          {"press force N", number(&F::press_force_n, 1)},
          {"tangential force N", number(&F::tangential_force_n, 1)},
          {"torque about z N mm", number(&F::torque_z_n_m, 1e3)},
          {"imbalance N", number(&F::balance_n, 1)},
          {"contact area mm²", number(&F::contact_area_mm2, 1)},
          {"mean pressure kPa", number(&F::mean_pressure_pa, 1e-3)},
          {"peak pressure kPa", number(&F::peak_pressure_pa, 1e-3)},
          {"sticking vertices", count(&F::sticking)},
          {"slipping vertices", count(&F::slipping)},
          {"steps in between", count(&F::substeps)},
          {"Newton iterations", count(&F::newton_iterations)},
          {"smallest distance µm", number(&F::min_gap_m, 1e6)},
          {"smallest volume ratio", number(&F::min_volume_ratio, 1)}};
}

/// Frames of the table: all, or about `kMaxRows`.
std::vector<int> rows(const SampleReport& sample) {
  constexpr int kMaxRows = 40;
  const int frames = static_cast<int>(sample.frames.size()), stride = (frames + kMaxRows - 1) / kMaxRows;
  std::vector<int> shown{frames - 1};
  for (int i = 0; i < frames; i += stride) shown.push_back(i);
  for (const int frame : chosen_frames(sample.phases, frames, kMaxRows)) shown.push_back(frame);
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  return shown;
}

}  // namespace

std::string press_curve_svg(const std::vector<FrameReport>& frames) {
  assert(!frames.empty());
  Chart chart{.what = "press force over indentation depth",
              .x_label = "indentation depth (mm)",
              .left_label = "press force (N)"};
  Curve curve;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameReport& frame = frames[i];
    chart.x.push_back(1e3 * frame.depth_m.value());
    curve.values.push_back(frame.press_force_n);
    if (frames.size() <= kMaxMarks) {
      curve.titles.push_back(fmt::format("frame {}: {} mm, {} N, {} Newton iterations", i,
                                         number_text(frame.depth_m, 1e3), number_text(frame.press_force_n),
                                         frame.newton_iterations));
    }
  }
  chart.left.push_back(std::move(curve));
  return chart_svg(chart);
}

std::string frame_curves(const SampleReport& sample) {
  if (sample.frames.empty()) return "";
  return force_curves(sample) + contact_curves(sample) + ratio_curve(sample) + balance_curve(sample);
}

std::string frames_table(const SampleReport& sample) {
  if (sample.frames.empty()) return "";
  std::vector<Column> present;
  for (Column& column : columns()) {
    const auto has = [&](const FrameReport& frame) { return column.text(frame) != "–"; };
    if (std::any_of(sample.frames.begin(), sample.frames.end(), has)) present.push_back(std::move(column));
  }
  const std::vector<int> shown = rows(sample);
  std::string summary = "Numbers per frame";
  if (shown.size() < sample.frames.size())
    summary += fmt::format(" ({} of {}; press.yaml has all)", shown.size(), sample.frames.size());
  std::string table =
      "<details><summary>" + summary + "</summary><div class=\"scroll\"><table>\n<thead><tr><th>frame</th>";
  for (const Column& column : present) table += fmt::format("<th>{}</th>", column.heading);
  table += "</tr></thead>\n<tbody>\n";
  for (const int i : shown) {
    table += fmt::format("<tr><td>{}</td>", i);
    for (const Column& column : present)
      table += "<td>" + column.text(sample.frames[static_cast<std::size_t>(i)]) + "</td>";
    table += "</tr>\n";
  }
  return table + "</tbody></table></div></details>\n";
}

}  // namespace tacipc
