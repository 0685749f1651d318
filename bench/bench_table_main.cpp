// Puts the presses of the benchmark together: tables, a plot, the cost model.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/cost_model.h"
#include "bench/element_study.h"
#include "bench/machine.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/image/plot.h"
#include "common/stage/stage.h"

using namespace tacipc;
using namespace tacipc::bench;

namespace {

const StageSpec kTable{.name = "bench_table",
                       .summary = "Put presses of the benchmark together as tables, a plot and the cost model.",
                       .inputs = {{"--press", "folder of a press, named gel-object-motion-route[-how]", true, true}}};

constexpr const char* kFast = "fast";
constexpr const char* kDirect = "direct";
constexpr const char* kPlain = "plain";
constexpr const char* kAveraged = "averaged";

const Run* find(const std::vector<Run>& runs, const std::string& text) {
  const auto found = std::ranges::find_if(runs, [&](const Run& run) { return run.text == text; });
  return found == runs.end() ? nullptr : &*found;
}

std::string routes_table(const std::vector<Run>& runs) {
  std::string out =
      "| Scene | Gel vertices | Route | CPU s | Speed-up | Whole-gel iterations | Patch iterations | Linear systems | "
      "Products each | Peak memory, MB | Force, N | Difference: largest, rms, force "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
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
                       run.newton(), run.patch(), systems,
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

std::string runs_table(const std::vector<Run>& runs) {
  std::string out =
      "| Scene | Gel vertices | Run | Wall s | CPU s | Wall time over one process, one thread "
      "|\n|---|---|---|---|---|---|\n";
  for (const Run& run : runs) {
    if (run.name.how.empty()) continue;
    const Run* plain = find(runs, run.name.with_route(run.name.route));
    out += fmt::format("| {} {} | {} | {} | {:.1f} | {:.1f} | {} |\n", run.name.object, run.name.motion,
                       run.gel_vertices, run.name.how, run.wall_s, run.processor_s,
                       plain ? fmt::format("{:.2f} ×", run.wall_s / plain->wall_s) : "");
  }
  return out;
}

/// The page docs/performance.md: the routes beside each other, where the time goes, threads and processes, the cost
/// model. `processor`: what it was measured on.
std::string bench_page(const std::vector<Run>& runs, const CostModel& model, const std::string& processor) {
  return "# Cost of a press\n\nMade by `make -f Makefile.data bench-press` on " + processor +
         ", one process and one thread unless noted. *press*: 0.5 mm in five frames into the MC-Tac gel, friction 0.5 "
         "with one lag per step, d̂ 10⁻³, κ 10⁵; *shear*: then 1 mm sideways in twenty frames; *settled*: friction "
         "renewed until it is consistent with its own contact forces; *tight*: a tenth of the tolerances; *thin*: a "
         "fifth of d̂, κ × 125; *stiff*: κ × 10, that of the paper. Gels are the paper's mesh with its lengths scaled, "
         "the scenes are `configs/studies/speed/*.yaml`; `BENCH_GELS=` and the other variables of "
         "`pipelines/verification/bench.mk` select what is measured.\n\n## Shipped settings\n\n<!-- defaults -->\nNot "
         "made in this run.\n<!-- end of defaults -->\n\n## Routes\n\n" +
         routes_table(runs) +
         "\n*fast* is the default solver with the paper's linear tetrahedra. *direct* factorises every linear system "
         "instead (CHOLMOD, METIS, one symbolic analysis) and is otherwise the same. *plain* is textbook projected "
         "Newton: factorised, for the whole gel in every iteration, with the projected Hessian of contact "
         "(`newton.contact_hessian: positive`). *averaged* is *fast* with volumes averaged over clusters, the default "
         "element of this gel. *Difference*: of gel vertices in the last frame, and of the press force, from *direct*. "
         "*Products each*: iterations of conjugate gradients per linear system. *Speed-up*: 2 × *direct* is half its "
         "CPU seconds.\n\n![CPU seconds over vertices](performance/bench_press.svg)\n"
         "\n## Time by part\n\nShares of the wall time.\n\n" +
         parts_table(runs) + element_section(runs) + "\n## Threads and processes\n\n" + runs_table(runs) +
         fmt::format(
             "\n## Cost model\n\n`configs/studies/speed/cost_model.yaml`: seconds of a frame = c (vertices / "
             "1000)^{:.2f} (1 + touching / 100)^{:.2f}, c = {:.3g} s while pressing and {:.3g} s while dragging, "
             "{:.2f} times that with averaged volumes; fitted to {} presses, largest error a factor of {:.2f}.\n",
             model.vertices_exponent, model.contacts_exponent, model.press_s, model.motion_s, model.averaged_factor,
             model.runs, model.largest_ratio);
}

/// Processor seconds of presses over vertices, a curve for each object and route.
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
