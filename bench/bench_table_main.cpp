// Combines the presses of the benchmark into tables, a plot, and the cost model.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/cost_model.h"
#include "bench/element_study.h"
#include "bench/machine.h"
#include "bench_table_texts.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/image/plot.h"
#include "common/stage/stage.h"

using namespace tacipc;
using namespace tacipc::bench;

namespace {

const StageSpec kTable{
    .name = "bench_table",
    .summary = "Put presses of the benchmark together as tables, a plot and the cost model.",
    .inputs = {InputSpec::several("--press", "folder of a press, named gel-object-motion-route[-how]")}};

constexpr const char* kFast = "fast";
constexpr const char* kDirect = "direct";
constexpr const char* kPlain = "plain";
constexpr const char* kAveraged = "averaged";

const Run* find(const std::vector<Run>& runs, const std::string& text) {
  const auto found = std::ranges::find_if(runs, [&](const Run& run) { return run.text == text; });
  return found == runs.end() ? nullptr : &*found;
}

std::string route_rows(const std::vector<Run>& runs) {
  std::string out;
  for (const Run& run : runs) {
    if (!run.name.how.empty()) continue;
    const Run* direct = run.name.route == kFast ? find(runs, run.name.with_route(kDirect)) : nullptr;
    const Run* plain = run.name.route == kFast ? find(runs, run.name.with_route(kPlain)) : nullptr;
    std::string difference_text, times;
    const auto less_than = [&](const Run* other, const char* route) {
      if (other)
        times += fmt::format("{}{:.1f} × *{}*", times.empty() ? "" : ", ", other->processor_s / run.processor_s, route);
    };
    less_than(direct, kDirect);
    less_than(plain, kPlain);
    if (direct) {
      if (const auto d = difference(run, *direct))
        difference_text =
            fmt::format("{:.2g} µm, {:.2g} µm, {:+.3f} %", 1e6 * d->largest_m, 1e6 * d->rms_m, 100.0 * d->force);
    }
    const double systems = run.parts.at("linear_systems"), products = run.parts.at("products");
    out += fmt::format("| {} {} | {} | {} | {:.1f} | {} | {} | {} | {:.0f} | {} | {:.0f} | {:.4f} | {} |\n",
                       run.name.object, run.name.motion, run.gel_vertices, run.name.route, run.processor_s, times,
                       run.sum(&Frame::newton), run.sum(&Frame::patch), systems,
                       products > 0 ? fmt::format("{:.0f}", products / systems) : "factor", run.peak_memory_mb,
                       run.press_force_n, difference_text);
  }
  return out;
}

std::string parts_table(const std::vector<Run>& runs) {
  static constexpr std::pair<const char*, const char*> kParts[] = {
      {"search_s", "Broad phase"},       {"step_limits_s", "Step limits"},  {"line_search_s", "Line search"},
      {"elastic_s", "Elastic assembly"}, {"contact_s", "Contact assembly"}, {"linear_s", "Linear systems"},
      {"patches_s", "Patches"}};
  std::string out = "| Scene | Gel vertices | Route |", rule = "|---|---|---|";
  for (const auto& [key, title] : kParts) {
    out += fmt::format(" {} |", title);
    rule += "---|";
  }
  out += " Else |\n" + rule + "---|\n";
  for (const Run& run : runs) {
    if (!run.name.how.empty()) continue;
    out += fmt::format("| {} {} | {} | {} |", run.name.object, run.name.motion, run.gel_vertices, run.name.route);
    double rest = 1.0;
    for (const auto& [key, title] : kParts) {
      const double share = run.parts.at(key) / run.wall_s;
      rest -= share;
      out += fmt::format(" {:.0f} % |", 100.0 * share);
    }
    out += fmt::format(" {:.0f} % |\n", 100.0 * rest);
  }
  return out;
}

std::string run_rows(const std::vector<Run>& runs) {
  std::string out;
  for (const Run& run : runs) {
    if (run.name.how.empty()) continue;
    const Run* plain = find(runs, run.name.with_route(run.name.route));
    out += fmt::format("| {} {} | {} | {} | {:.1f} | {:.1f} | {} |\n", run.name.object, run.name.motion,
                       run.gel_vertices, run.name.how, run.wall_s, run.processor_s,
                       plain ? fmt::format("{:.2f} ×", run.wall_s / plain->wall_s) : "");
  }
  return out;
}

/// The page docs/performance.md: comparison of routes, parts of the time, threads and processes, cost model.
/// `processor` is the processor that measured.
std::string bench_page(const std::vector<Run>& runs, const CostModel& model, const std::string& processor) {
  return fmt::format(kPressPage, processor, route_rows(runs), parts_table(runs), element_section(runs), run_rows(runs),
                     model.vertices_exponent, model.contacts_exponent, model.press_s, model.motion_s,
                     model.averaged_factor, model.runs, model.largest_ratio);
}

/// Plot of processor seconds of presses over vertices, a curve for each object and route.
std::string bench_svg(const std::vector<Run>& runs) {
  std::map<std::string, PlotCurve> curves;
  for (const Run& run : runs) {
    if (!run.name.how.empty() || run.name.motion != "press" || run.name.route == kAveraged) continue;
    const std::string label = run.name.object + ", " + run.name.route;
    auto& curve = curves[label];
    curve.label = label;
    curve.dots = run.name.route != kFast;
    curve.points.emplace_back(run.gel_vertices, run.processor_s);
  }
  Plot plot{.title = "One press of 0.5 mm", .x_label = "gel vertices", .y_label = "CPU seconds", .logarithmic = true};
  for (auto& [label, curve] : curves) {
    std::ranges::sort(curve.points, [](const auto& a, const auto& b) { return a.x() < b.x(); });
    plot.curves.push_back(std::move(curve));
  }
  return to_svg(plot);
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTable, argc, argv, [](Stage& stage) {
    std::vector<Run> runs, usual;
    for (const auto& folder : stage.inputs("--press")) {
      runs.push_back(read_run(folder));
      const auto& name = runs.back().name;
      if ((name.motion == "press" || name.motion == "shear") && (name.route == "fast" || name.route == "averaged") &&
          name.how.empty())
        usual.push_back(runs.back());
    }
    if (usual.size() < 5) throw DataError("{} presses by the default route: the cost model needs five", usual.size());
    const CostModel model = fit_cost_model(usual);
    write_file(stage.output("performance.md"), bench_page(runs, model, processor()));
    write_file(stage.output("bench_press.svg"), bench_svg(runs));
    write_file(stage.output("bench_elements.svg"), element_svg(runs));
    write_file(stage.output("cost_model.yaml"), to_yaml_text(model));
    stage.summarize({{"presses", runs.size()}, {"largest_ratio", model.largest_ratio}});
  });
}
