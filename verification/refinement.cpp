#include "verification/refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/image/plot.h"
#include "common/sensor/markers.h"
#include "verification/run_case.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

const std::vector<std::string> kParameters{"mesh", "time_step", "d_hat", "speed_threshold"};

double rms(const Positions& difference) {
  return std::sqrt(difference.rowwise().squaredNorm().sum() / static_cast<double>(difference.rows()));
}

/// Displacement of points bound to the front between two frames.
Positions moved(const std::vector<Marker>& points, const Frame& from, const Frame& to) {
  return marker_positions(points, to.positions) - marker_positions(points, from.positions);
}

void append(std::string& bytes, const double* data, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(data), sizeof(double) * count);
}

/// Forces are shown in percent of the finest, fields in µm.
double shown(const RefinementCurve& curve, double difference) {
  return curve.values.empty() ? 1e6 * difference : 100.0 * difference / std::abs(curve.values.back());
}
std::string shown_unit(const RefinementCurve& curve) { return curve.values.empty() ? "µm" : "%"; }

std::vector<double> list(ConfigReader& in, const std::string& key, std::size_t count) {
  return count > 0 ? in.numbers(key, count) : std::vector<double>{};
}

}  // namespace

double RefinementStudy::scale(int level) const { return coarsest / std::pow(factor, level); }

RefinementSpec RefinementSpec::read(ConfigReader& in) {
  RefinementSpec spec;
  spec.scene.title = in.text("title");
  spec.scene.source = spec.scene.title;
  spec.scene.gel = in.read<GelSpec>("gel");
  spec.scene.material = in.read<Material>("material");
  spec.scene.object = in.read<ObjectShape>("shape");
  spec.scene.press = in.read<PressConfig>("press");
  ConfigReader front = in.section("front");
  spec.scene.sample = SampleSpec::read(in);
  spec.front_half_m = kMillimetre * front.number("half_mm", Range::positive());
  spec.front_pitch_m = kMillimetre * front.number("pitch_mm", Range::positive());
  if (spec.front_pitch_m > spec.front_half_m) front.fault("pitch_mm", "must be at most half_mm");
  for (ConfigReader& row : in.sections("refine")) {
    RefinementStudy study;
    study.parameter = row.choice("parameter", kParameters);
    study.coarsest = row.number("coarsest", Range::positive());
    study.factor = row.number("factor", Range{.low = 1.0, .open_low = true});
    study.levels = row.integer("levels", 3, 10);
    for (const RefinementStudy& other : spec.studies)
      if (other.parameter == study.parameter) row.fault("parameter", "is refined twice");
    spec.studies.push_back(study);
  }
  if (spec.studies.empty()) in.fault("refine", "nothing is refined");
  return spec;
}

const RefinementStudy& RefinementSpec::study(const std::string& parameter) const {
  std::string known;
  for (const RefinementStudy& study : studies) {
    if (study.parameter == parameter) return study;
    known += (known.empty() ? "" : ", ") + study.parameter;
  }
  throw UsageError(fmt::format("--study: '{}' is not refined (there are: {})", parameter, known));
}

CaseSpec refined(const CaseSpec& scene, const std::string& parameter, double scale) {
  CaseSpec out = scene;
  if (parameter == "mesh") {
    auto* box = std::get_if<BoxGel>(&out.gel.shape);
    if (!box) throw UsageError("refine: only the mesh of a box is refined");
    for (double* length : {&box->near_m, &box->far_m, &box->layer_m}) *length *= scale;
    for (double* growth : {&box->growth, &box->layer_growth}) *growth = std::pow(*growth, scale);
  } else if (parameter == "time_step") {
    out.press.time_step_s *= scale;
    for (Phase& phase : out.sample.motion) {
      const double steps = phase.steps / scale;
      if (std::abs(steps - std::round(steps)) > 1e-9 || steps < 0.5)
        throw UsageError(fmt::format("refine: {} steps divided by {:g} is not a whole number", phase.steps, scale));
      phase.steps = static_cast<int>(std::lround(steps));
    }
  } else if (parameter == "d_hat") {
    out.press.relative_d_hat *= scale;
  } else {
    if (!out.press.friction) throw UsageError("refine: a scene without friction has no speed_threshold");
    out.press.friction->relative_speed_threshold *= scale;
  }
  return out;
}

ParameterValue parameter_value(const CaseSpec& scene, const std::string& parameter) {
  const auto* box = std::get_if<BoxGel>(&scene.gel.shape);
  if (!box) throw UsageError("refine: the gel must be a box");
  const double diagonal = Vector3(box->width_m, box->height_m, box->thickness_m).norm();
  if (parameter == "mesh") return {box->near_m / kMillimetre, "cells under the object", "mm"};
  if (parameter == "time_step") return {1e3 * scene.press.time_step_s, "time step", "ms"};
  if (parameter == "d_hat") return {1e6 * scene.press.relative_d_hat * diagonal, "reach of the barrier d̂", "µm"};
  return {1e6 * scene.press.friction.value().relative_speed_threshold * diagonal, "sticking below ε_v", "µm/s"};
}

std::string RefinementLevel::pack() const {
  const std::array<double, 5> head{static_cast<double>(gel_vertices), press_force_n, tangential_force_n,
                                   static_cast<double>(markers_m.rows()), static_cast<double>(front_m.rows())};
  std::string bytes;
  append(bytes, head.data(), head.size());
  append(bytes, markers_m.data(), static_cast<std::size_t>(markers_m.size()));
  append(bytes, front_m.data(), static_cast<std::size_t>(front_m.size()));
  return bytes;
}

std::optional<RefinementLevel> RefinementLevel::unpack(std::string_view bytes) {
  std::array<double, 5> head{};
  if (bytes.size() < sizeof(head)) return std::nullopt;
  std::memcpy(head.data(), bytes.data(), sizeof(head));
  bytes.remove_prefix(sizeof(head));
  if (!(head[3] >= 0.0) || !(head[4] >= 0.0) ||
      static_cast<double>(bytes.size()) != 3.0 * sizeof(double) * (head[3] + head[4]))
    return std::nullopt;
  RefinementLevel level{.gel_vertices = static_cast<int>(head[0]),
                        .press_force_n = head[1],
                        .tangential_force_n = head[2],
                        .markers_m = Positions(static_cast<Eigen::Index>(head[3]), 3),
                        .front_m = Positions(static_cast<Eigen::Index>(head[4]), 3)};
  for (Positions* field : {&level.markers_m, &level.front_m}) {
    const std::size_t count = sizeof(double) * field->size();
    if (count > 0) std::memcpy(field->data(), bytes.data(), count);
    bytes.remove_prefix(count);
  }
  return level;
}

RefinementLevel run_level(const RefinementSpec& spec, const CaseSpec& scene, const std::filesystem::path& shared) {
  const CaseResult result = run_case(scene, shared, [](int, int, int, double) {});
  if (result.skipped) throw DataError("{}", *result.skipped);
  if (!result.simulation) throw SolverError("{}", result.failed.value_or("no frames"));
  const Outcome outcome{result.spec, result.gel, result.object, *result.simulation};
  const auto& frames = result.simulation->frames;
  const int last = static_cast<int>(frames.size()) - 1;
  const auto pressed = static_cast<std::size_t>(find_frame(outcome, {.index = {}, .phase = "press", .depth_m = {}}));
  const Triangles front = result.gel.faces(BoundaryTag::front);
  const int across = 1 + 2 * static_cast<int>(std::lround(spec.front_half_m / spec.front_pitch_m));
  const MarkerGrid dense{.rows = across, .columns = across, .pitch_m = spec.front_pitch_m, .given = true};
  RefinementLevel level;
  level.gel_vertices = static_cast<int>(result.gel.num_vertices());
  level.press_force_n = measure(outcome, "press_force_n", last);
  level.tangential_force_n = measure(outcome, "tangential_force_n", last);
  level.markers_m = moved(bind_markers({}, result.gel.positions, front), frames[pressed], frames.back());
  level.front_m = moved(bind_markers(dense, result.gel.positions, front), frames.front(), frames.back());
  return level;
}

std::vector<RefinementCurve> compare_levels(const std::vector<RefinementLevel>& levels, double factor) {
  using Level = RefinementLevel;
  using Distance = std::function<double(const Level&, const Level&)>;
  const auto curve = [&](const char* quantity, const char* unit, const Distance& distance) {
    RefinementCurve out{.quantity = quantity, .unit = unit};
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      out.against_finest.push_back(distance(levels[k], levels.back()));
      out.against_next.push_back(distance(levels[k], levels[k + 1]));
    }
    for (std::size_t k = 0; k + 1 < out.against_next.size(); ++k)
      if (out.against_next[k] > 0.0 && out.against_next[k + 1] > 0.0)
        out.orders.push_back(std::log(out.against_next[k] / out.against_next[k + 1]) / std::log(factor));
    return out;
  };
  const auto scalar = [&](const char* quantity, double Level::*member) {
    RefinementCurve out =
        curve(quantity, "N", [=](const Level& a, const Level& b) { return std::abs(a.*member - b.*member); });
    for (const Level& level : levels) out.values.push_back(level.*member);
    return out;
  };
  return {scalar("press force", &Level::press_force_n), scalar("tangential force", &Level::tangential_force_n),
          curve("markers since the press, rms", "m",
                [](const Level& a, const Level& b) { return rms(a.markers_m - b.markers_m); }),
          curve("front face, rms", "m", [](const Level& a, const Level& b) { return rms(a.front_m - b.front_m); }),
          curve("front face, largest", "m",
                [](const Level& a, const Level& b) { return (a.front_m - b.front_m).rowwise().norm().maxCoeff(); })};
}

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
    out += "\nObserved order, from three successive levels each:\n\n";
    for (const RefinementCurve& curve : result.curves)
      out += fmt::format("- {}: {:.1f}\n", curve.quantity, fmt::join(curve.orders, ", "));
    out += '\n';
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
