#include "verification/refinement_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/image/plot.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

/// Forces are shown in percent of the finest, fields in µm.
double shown(const RefinementCurve& curve, double difference) {
  return curve.values.empty() ? 1e6 * difference : 100.0 * difference / std::abs(curve.values.back());
}
std::string shown_unit(const RefinementCurve& curve) { return curve.values.empty() ? "µm" : "%"; }

std::vector<double> list(ConfigReader& in, const std::string& key, std::size_t count) {
  return count > 0 ? in.numbers(key, count) : std::vector<double>{};
}

}  // namespace

RefinementResult describe(const RefinementSpec& spec, const RefinementStudy& study,
                          const std::vector<CaseSpec>& scenes) {
  RefinementResult result{.study = study.parameter, .title = spec.scene.title, .factor = study.factor};
  for (const CaseSpec& scene : scenes) {
    const ParameterValue value = parameter_value(scene, study.parameter);
    result.parameter = value.name;
    result.unit = value.unit;
    result.parameter_values.push_back(value.value);
  }
  return result;
}

Value to_value(const RefinementResult& result) {
  Value::List curves;
  for (const RefinementCurve& curve : result.curves) {
    Value::Map line{{"quantity", curve.quantity}, {"unit", curve.unit}};
    if (!curve.values.empty()) line.emplace_back("values", curve.values);
    line.emplace_back("against_finest", curve.against_finest);
    line.emplace_back("against_next", curve.against_next);
    Value::List orders;
    for (const double order : curve.orders) orders.emplace_back(Value::Map{{"order", order}});
    line.emplace_back("orders", std::move(orders));
    curves.emplace_back(std::move(line));
  }
  const std::vector<double> vertices(result.gel_vertices.begin(), result.gel_vertices.end());
  return Value::Map{{"study", result.study},
                    {"title", result.title},
                    {"parameter", result.parameter},
                    {"unit", result.unit},
                    {"factor", result.factor},
                    {"levels", result.parameter_values.size()},
                    {"parameter_values", result.parameter_values},
                    {"gel_vertices", vertices},
                    {"curves", std::move(curves)}};
}

RefinementResult read_refinement(const std::filesystem::path& folder) {
  RefinementResult result{.study = folder.filename().string(), .failed = why_no_record(folder, "refinement")};
  if (result.failed) return result;
  ConfigReader in = ConfigReader::from_file(folder / "result.yaml");
  result.study = in.text("study");
  result.title = in.text("title");
  result.parameter = in.text("parameter");
  result.unit = in.text("unit");
  result.factor = in.number("factor", Range{.low = 1.0, .open_low = true});
  const auto levels = static_cast<std::size_t>(in.integer("levels", 3));
  result.parameter_values = in.numbers("parameter_values", levels, Range::positive());
  for (const double count : in.numbers("gel_vertices", levels)) result.gel_vertices.push_back(static_cast<int>(count));
  for (ConfigReader& row : in.sections("curves")) {
    RefinementCurve curve{.quantity = row.text("quantity"), .unit = row.text("unit")};
    curve.values = list(row, "values", row.has("values") ? levels : 0);
    curve.against_finest = list(row, "against_finest", levels - 1);
    curve.against_next = list(row, "against_next", levels - 1);
    for (ConfigReader& order : row.sections("orders")) curve.orders.push_back(order.number("order"));
    result.curves.push_back(std::move(curve));
  }
  in.finish();
  return result;
}

std::vector<std::string> not_converging(const RefinementResult& result) {
  std::vector<std::string> names;
  for (const RefinementCurve& curve : result.curves)
    if (!(curve.against_next.back() < curve.against_next.front())) names.push_back(curve.quantity);
  return names;
}

bool holds(const std::vector<RefinementResult>& results) {
  return std::ranges::all_of(results, [](const RefinementResult& r) { return !r.failed && not_converging(r).empty(); });
}

std::string found(const std::vector<RefinementResult>& results) {
  std::vector<std::string> changes, parts;
  for (const RefinementResult& result : results) {
    if (result.failed) {
      parts.push_back(fmt::format("{} failed: {}", result.study, *result.failed));
      continue;
    }
    double change = 0.0;
    for (const RefinementCurve& curve : result.curves)
      if (!curve.values.empty()) change = std::max(change, shown(curve, curve.against_next.back()));
    changes.push_back(fmt::format("{:.2f} % ({})", change, result.parameter));
    if (const auto names = not_converging(result); !names.empty())
      parts.push_back(fmt::format("no convergence in the {}: {}", result.parameter, fmt::join(names, ", ")));
  }
  if (!changes.empty())
    parts.insert(parts.begin(), fmt::format("the last refinement changes the forces by {}", fmt::join(changes, ", ")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string refinement_tables(const std::vector<RefinementResult>& results, const std::string& plots) {
  std::string title;
  for (const RefinementResult& result : results)
    if (title.empty()) title = result.title;
  std::string out = fmt::format(
      "# Refinement\n\nWritten by `make -f Makefile.data refinement`; discussion: "
      "[refinement](../refinement.md).\n\n{}: the last frame with one number refined, all others held.\n\n",
      title);
  for (const RefinementResult& result : results) {
    if (result.failed) {
      out += fmt::format("## {}\n\n**failed**: {}\n\n", result.study, *result.failed);
      continue;
    }
    out += fmt::format("## {}\n\n| {} ({}) | Vertices |", result.parameter, result.parameter, result.unit);
    std::string line = "|---|---|";
    for (const RefinementCurve& curve : result.curves) {
      if (!curve.values.empty()) out += fmt::format(" {} |", curve.quantity);
      out += fmt::format(" {}{} |", curve.values.empty() ? curve.quantity + ", " : "", "against the finest");
      line += curve.values.empty() ? "---|" : "---|---|";
    }
    out += "\n" + line + "\n";
    for (std::size_t k = 0; k < result.parameter_values.size(); ++k) {
      out += fmt::format("| {:.4g} | {} |", result.parameter_values[k], result.gel_vertices[k]);
      for (const RefinementCurve& curve : result.curves) {
        if (!curve.values.empty()) out += fmt::format(" {:.5f} {} |", curve.values[k], curve.unit);
        out += k < curve.against_finest.size()
                   ? fmt::format(" {:.3g} {} |", shown(curve, curve.against_finest[k]), shown_unit(curve))
                   : " – |";
      }
      out += '\n';
    }
    out += "\nObserved order, from three successive levels each: ";
    for (const RefinementCurve& curve : result.curves) {
      out += curve.quantity + " ";
      for (std::size_t i = 0; i < curve.orders.size(); ++i)
        out += fmt::format("{}{:.1f}", i ? ", " : "", curve.orders[i]);
      out += &curve == &result.curves.back() ? ".\n\n" : "; ";
    }
    if (const auto names = not_converging(result); !names.empty())
      out += fmt::format("**Missed**: the last level changes more than the second: {}.\n\n", fmt::join(names, "; "));
    out += fmt::format("![{}]({}/refinement_{}.svg)\n\n", result.parameter, plots, result.study);
  }
  return out;
}

std::string refinement_svg(const RefinementResult& result) {
  Plot plot{.title = fmt::format("Change by refining: {}", result.parameter),
            .x_label = fmt::format("{} ({})", result.parameter, result.unit),
            .y_label = "difference from the next finer level",
            .logarithmic = true};
  for (const RefinementCurve& curve : result.curves) {
    PlotCurve line{.label = fmt::format("{} ({})", curve.quantity, shown_unit(curve))};
    for (std::size_t k = 0; k < curve.against_next.size(); ++k)
      line.points.emplace_back(result.parameter_values[k], shown(curve, curve.against_next[k]));
    if (curve.quantity.find("largest") == std::string::npos) plot.curves.push_back(std::move(line));
  }
  return to_svg(plot);
}

}  // namespace tacipc::verify
