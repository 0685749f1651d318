#include "stages/dataset/report/frames_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "common/format/html_text.h"
#include "stages/dataset/report/html.h"

namespace tacipc {
namespace {

struct Column {
  const char* heading;
  std::function<std::string(const FrameReport&)> text;  // "–" where the frame has no such number
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

/// Frames that the table shows: all, or about as many as `kMaxRows`.
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
