#include "stages/dataset/report/motion.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "common/sample/motion.h"

namespace tacipc {
namespace {

std::string phase_text(const Record& phase) {
  const std::string kind = phase.text("kind").value_or("motion");
  std::string words = kind;
  const auto add = [&](const char* before, const char* key, const char* after) {
    const auto range = phase.range(key);
    if (!range) return;
    const auto [low, high] = *range;
    words += before + (low == high ? fmt::format("{:g}", low) : fmt::format("{:g} to {:g}", low, high)) + after;
  };
  add(" ", "depth_mm", " mm");
  // A load, also on a free object, is a list of three forces; a press has one number.
  const bool vector = kind == name_of(PhaseKind::load) || kind == name_of(PhaseKind::free);
  if (const auto load = vector ? phase.numbers("force_n", 3) : std::nullopt)
    words += fmt::format(" ({:g}, {:g}, {:g}) N", (*load)[0], (*load)[1], (*load)[2]);
  else
    add(" until ", "force_n", " N");
  add(" ", "distance_mm", " mm");
  add(" ", "angle_deg", "°");
  add(" towards ", "direction_deg", "°");
  if (const auto file = phase.text("file")) words += " along " + *file;
  return words;
}

}  // namespace

std::string motion_text(const Record& sample) {
  if (sample.has("bodies")) return fmt::format("scene of {} phases", sample.one_or_many("motion").size());
  std::string words;
  for (const Record& phase : sample.one_or_many("motion")) words += (words.empty() ? "" : ", ") + phase_text(phase);
  return words;
}

std::optional<double> asked_depth_mm(const Record& sample) {
  for (const Record& phase : sample.one_or_many("motion")) {
    if (const auto depth_mm = phase.number("depth_mm")) return depth_mm;
  }
  return std::nullopt;
}

std::vector<PhaseReport> phases_of(const std::vector<std::string>& frame_names, const Record& sample) {
  const int frames = static_cast<int>(frame_names.size());
  std::vector<std::int64_t> cuts;  // last frames of the requested phases
  std::int64_t end = 0;
  for (const Record& phase : sample.one_or_many("motion")) cuts.push_back(end += phase.count("steps").value_or(frames));
  if (end != frames - 1) cuts.clear();
  std::vector<PhaseReport> phases;
  for (int i = 0; i < frames; ++i) {
    const std::string& name = frame_names[static_cast<std::size_t>(i)];
    if (name.empty()) return {};
    const bool cut = std::find(cuts.begin(), cuts.end(), i - 1) != cuts.end();
    if (phases.empty() || cut || phases.back().name != name)
      phases.push_back({name, i, i});
    else
      phases.back().last = i;
  }
  return phases;
}

std::vector<int> chosen_frames(const std::vector<PhaseReport>& phases, int frames, int max_count) {
  assert(frames >= 1 && max_count >= 1);
  std::vector<int> ends;
  for (const PhaseReport& phase : phases) {
    if (phase.name != name_of(PhaseKind::reference) && phase.name != name_of(PhaseKind::approach))
      ends.push_back(phase.last);
  }
  if (ends.empty() || ends.back() != frames - 1) ends.push_back(frames - 1);
  const int count = static_cast<int>(ends.size());
  if (count <= max_count) return ends;
  std::vector<int> chosen;
  for (int i = 1; i <= max_count; ++i) chosen.push_back(ends[static_cast<std::size_t>(i * count / max_count - 1)]);
  return chosen;
}

}  // namespace tacipc
