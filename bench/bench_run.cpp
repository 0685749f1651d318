#include "bench/bench_run.h"

#include <cmath>
#include <sstream>

#include "common/base/error.h"
#include "common/config/config.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"

namespace tacipc::bench {

RunName parse_run_name(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream in(name);
  for (std::string part; std::getline(in, part, '-');) parts.push_back(part);
  if (parts.size() < 4 || parts.size() > 5)
    throw DataError("{}: the name of a run is gel-object-motion-route or gel-object-motion-route-how", name);
  return {parts[0], parts[1], parts[2], parts[3], parts.size() == 5 ? parts[4] : ""};
}

int Run::sum(int Frame::*count) const {
  int total = 0;
  for (const Frame& frame : frames) total += frame.*count;
  return total;
}

Run read_run(const std::filesystem::path& folder) {
  Run run;
  const Record record = Record::from_file(folder / "press.yaml");
  run.text = record.required_text("name");
  run.name = parse_run_name(run.text);
  const auto summary = summary_of<PressSummary>(record);
  run.gel_vertices = summary.required(&PressSummary::gel_vertices);
  run.press_force_n = summary.required(&PressSummary::press_force_n);
  using Lines = PressFrameLines;
  for (const auto& line : summary.sections(&PressSummary::per_frame)) {
    const std::string phase = line.required(&Lines::phase);
    if (phase == name_of(PhaseKind::reference)) continue;
    run.frames.push_back({.press = phase == name_of(PhaseKind::press),
                          .contacts = line.required(&Lines::sticking) + line.required(&Lines::slipping),
                          .newton = line.required(&Lines::newton_iterations),
                          .patch = line.required(&Lines::patch_iterations)});
  }
  ConfigReader timings = ConfigReader::from_file(folder / "press.timings.yaml");
  run.threads = timings.integer("threads", 1);
  run.processor_s = timings.number("processor_s");
  run.wall_s = timings.number("wall_s");
  run.peak_memory_mb = timings.number("peak_memory_mb");
  for (const char* part : {"search_s", "step_limits_s", "line_search_s", "elastic_s", "contact_s", "linear_s",
                           "patches_s", "linear_systems", "products"})
    run.parts[part] = timings.number(part);

  PressFolder press(folder, {{kVertices, static_cast<std::size_t>(run.gel_vertices)}});
  run.last = press.positions(press.extent(PressArray::positions, kFrames) - 1);
  return run;
}

std::optional<Difference> difference(const Run& run, const Run& from) {
  if (run.last.rows() != from.last.rows()) return std::nullopt;
  const Eigen::VectorXd distance = (run.last - from.last).rowwise().norm();
  return Difference{.largest_m = distance.maxCoeff(),
                    .rms_m = std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size())),
                    .force = run.press_force_n / from.press_force_n - 1.0};
}

}  // namespace tacipc::bench
