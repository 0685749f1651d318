#include "common/benchmark/identify_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/benchmark/benchmark_cases.h"

namespace tacipc {
namespace {

std::vector<double> ascending(ConfigReader& in, const std::string& key, std::size_t least, const Range& range) {
  std::vector<double> values = in.any_numbers(key, range);
  if (values.size() < least) in.fault(key, fmt::format("needs at least {} values", least));
  if (!std::ranges::is_sorted(values, std::less_equal<>())) in.fault(key, "must ascend");
  return values;
}

/// Returns the range in which a parameter has a meaning.
Range natural_range(const std::string& name) {
  if (name == kPoisson) return {.low = 0.0, .high = 0.5, .open_low = true, .open_high = true};
  if (name == kModulus || name == kThickness || name == kFriction) return Range::positive();
  return Range::non_negative();
}

MechanicsParameter read_parameter(ConfigReader& parameters, const std::string& name) {
  ConfigReader in = parameters.section(name);
  MechanicsParameter out{.name = name, .prior = Prior::read(in, natural_range(name))};
  if (name == kPoisson || name == kThickness || name == kFriction) {
    out.nodes = ascending(in, "nodes", 2, natural_range(name));
    if (!out.nodes.empty()) {
      if (in.has("bounds") && (out.prior.low < out.nodes.front() || out.prior.high > out.nodes.back()))
        in.fault("bounds", "must lie between the first node and the last: beyond them nothing is simulated");
      out.prior.low = std::max(out.prior.low, out.nodes.front());
      out.prior.high = std::min(out.prior.high, out.nodes.back());
      if (!(out.prior.low <= out.prior.mean && out.prior.mean <= out.prior.high))
        in.fault("mean", "must lie between the first node and the last");
    }
  }
  return out;
}

void read_relaxation(ConfigReader& parameters, IdentifySpec& out) {
  // If the fractions could sum to 1, the long-term modulus could be zero.
  std::vector<ConfigReader> terms = parameters.sections("relaxation");
  for (ConfigReader& term : terms) {
    const std::string index = std::to_string(out.relaxation.size());
    const Range parts = Range::between(0.0, 0.95 / static_cast<double>(terms.size()));
    MechanicsParameter g{.name = "relaxation_" + index + "_part", .prior = term.read<Prior>("part", parts)};
    MechanicsParameter tau{.name = "relaxation_" + index + "_time_s",
                           .prior = term.read<Prior>("time_s", Range::positive())};
    out.relaxation.emplace_back(std::move(g), std::move(tau));
  }
}

void read_columns(ConfigReader& in, Measurement& out) {
  ConfigReader columns = in.section("columns");
  auto factors = in.optional_section("factors");
  for (MeasuredColumn* one : {&out.at, &out.force}) {
    one->column = columns.text(one->quantity);
    if (factors) one->factor = factors->optional_number(one->quantity).value_or(1.0);
  }
}

MarkerMeasurement read_markers(ConfigReader& in) {
  MarkerMeasurement out;
  ConfigReader fields = in.section("fields");
  out.press_file = plain(fields, "press");
  out.shear_file = plain(fields, "shear");
  out.contact_px = pair_of(fields, "contact_px");
  out.contact_sigma_px = fields.number("contact_sigma_px", Range::positive());
  out.shift_sigma_px = fields.number("shift_sigma_px", Range::positive());
  out.scale_sigma = fields.number("scale_sigma", Range::positive());
  out.sigma_px = fields.number("sigma_px", Range::positive());
  return out;
}

/// Reads changes as words that need no quoting in Make and the shell.
std::vector<std::string> read_changes(ConfigReader& in) {
  std::vector<std::string> changes = in.texts("changes");
  for (const std::string& change : changes)
    if (change.find_first_of(" \t'\"$#\\") != std::string::npos)
      in.fault("changes", fmt::format("'{}' has a blank, a quote, $, # or a backslash in it", change));
  return changes;
}

Measurement read_measurement(ConfigReader& in) {
  Measurement out;
  out.name = in.file_name("name");
  const std::vector<std::string> kinds{"press", "shear", "relaxation", "markers"};
  const std::string kind = in.choice("kind", kinds);
  out.kind = static_cast<MeasurementKind>(std::ranges::find(kinds, kind) - kinds.begin());
  if (auto ball = in.optional_section("ball")) {
    out.ball_radius_mm = ball->number("radius_mm", Range::positive());
    out.edge_mm = ball->number("edge_mm", Range::positive());
    if (in.has("mesh")) in.fault("mesh", "there is a ball already");
  } else {
    ConfigReader mesh = in.section("mesh");
    out.mesh = plain(mesh, "file");
    out.unit = mesh.choice_or("unit", "mm", {"m", "cm", "mm", "um"});
    out.edge_radius_mm = mesh.number("edge_radius_mm", Range::positive());
    out.edge_mm = mesh.number("spacing_mm", Range::positive());
    if (out.kind == MeasurementKind::markers) in.fault("mesh", "markers need a ball");
  }
  out.center_mm = pair_of(in, "center_mm", {0.0, 0.0});
  out.file = plain(in, "file");
  if (out.kind == MeasurementKind::markers) {
    out.markers = read_markers(in);
    out.markers->depth_mm = in.read<Prior>("depth_mm", Range::positive());
    out.markers->travel_mm = in.read<Prior>("travel_mm", Range::positive());
  } else {
    const std::vector<std::string> first{"depth_mm", "travel_mm", "time_s"};
    out.at.quantity = first[static_cast<std::size_t>(out.kind)];
    out.force.quantity = "force_n";
    read_columns(in, out);
    ConfigReader sigma = in.section("sigma");
    out.sigma_relative = sigma.number_or("relative", 0.0, Range::non_negative());
    out.sigma_n = sigma.number("force_n", Range::positive());
    if (auto zero = in.optional_section("depth_zero_mm")) out.depth_zero_mm = Prior::read(*zero, Range::any());
  }
  ConfigReader simulate = in.section("simulate");
  out.press_frames = simulate.integer("press_frames", 2, 10000);
  if (out.sheared()) {
    out.depths_mm = ascending(simulate, "depths_mm", 2, Range::positive());
    out.travel_mm = simulate.number("travel_mm", Range::positive());
    out.shear_frames = simulate.integer("shear_frames", 2, 10000);
    out.direction_deg = simulate.number_or("direction_deg", 0.0);
  } else {
    out.depths_mm = {simulate.number("to_mm", Range::positive())};
  }
  if (out.markers && !out.depths_mm.empty()) {
    const auto within = [&](Prior& prior, const char* key, double low, double high) {
      prior.low = std::max(prior.low, low);
      prior.high = std::min(prior.high, high);
      if (!(prior.low <= prior.mean && prior.mean <= prior.high))
        in.fault(key, fmt::format("its mean lies beyond what is simulated, {:g} to {:g} mm", low, high));
    };
    within(out.markers->depth_mm, "depth_mm", out.depths_mm.front(), out.depths_mm.back());
    within(out.markers->travel_mm, "travel_mm", 0.0, out.travel_mm);
  }
  const double deepest = out.depths_mm.empty() ? 0.0 : out.depths_mm.back();
  if (out.kind == MeasurementKind::press) {
    out.fit_to_mm = in.optional_number("fit_to_mm", Range::positive());
    out.predict_mm = in.any_numbers("predict_mm", Range::positive());
    for (const double depth : out.predict_mm)
      if (depth > deepest) in.fault("predict_mm", "is deeper than simulate.to_mm");
  } else if (out.kind != MeasurementKind::markers) {
    const double least = out.sheared() && !out.depths_mm.empty() ? out.depths_mm.front() : 0.0;
    out.depth_mm = in.number("depth_mm", Range::between(least, deepest));
    if (out.kind == MeasurementKind::relaxation) out.ramp_s = in.number("ramp_s", Range::positive());
  }
  return out;
}

/// Refuses equal names: folders are named after nodes and checks, and their subfolders after runs.
void refuse_same_names(ConfigReader& in, const IdentifySpec& spec) {
  std::set<std::string> folders, runs;
  const auto single = [&](const std::string& key, std::set<std::string>& names, const std::string& name) {
    if (name.find('/') != std::string::npos || name.starts_with('.'))
      in.fault(key, fmt::format("'{}' is no name of a folder", name));
    if (!names.insert(name).second) in.fault(key, fmt::format("two folders would be called {}", name));
  };
  for (const RunNode& node : spec.nodes()) folders.insert(node.name);
  for (const ModelCheck& check : spec.checks) single("checks", folders, check.name);
  for (const Measurement& m : spec.measurements)
    for (const double depth : m.depths_mm) single("measurements", runs, run_name(m, depth));
}

}  // namespace

Prior Prior::read(ConfigReader& in, const Range& natural) {
  Prior out{.low = natural.low, .high = natural.high};
  out.mean = in.number("mean", Range{.low = natural.low, .high = natural.high});
  if (in.has("factor")) {
    out.logarithmic = true;
    out.sigma = std::log(in.number("factor", {.low = 1.0, .open_low = true}));
    if (!(out.mean > 0.0)) in.fault("mean", "must be positive where a factor is given");
    if (in.has("sigma")) in.fault("sigma", "there is a factor already");
  } else {
    out.sigma = in.number("sigma", Range::positive());
  }
  if (in.has("bounds")) {
    const auto bounds = in.numbers("bounds", 2, natural);
    out.low = bounds[0];
    out.high = bounds[1];
    if (!(out.low < out.high && out.low <= out.mean && out.mean <= out.high))
      in.fault("bounds", "must be the least and the largest value, with the mean between them");
  }
  return out;
}

IdentifySpec IdentifySpec::read(ConfigReader& in) {
  IdentifySpec out;
  out.title = plain(in, "title");
  out.sensor = plain(in, "sensor");
  out.mesh = plain(in, "mesh");
  out.press = plain(in, "press");
  out.changes = read_changes(in);
  out.seed = in.integer_or("seed", 1, 0);
  out.draws = in.integer_or("draws", 4000, 100, 1000000);
  out.members = in.integer_or("members", 8, 2, 1000);
  ConfigReader parameters = in.section("parameters");
  for (const char* name : {kModulus, kPoisson, kThickness, kFriction, kMount, kShearMount})
    if (parameters.has(name)) out.parameters.push_back(read_parameter(parameters, name));
  read_relaxation(parameters, out);
  for (ConfigReader& item : in.one_or_more_sections("measurements")) {
    Measurement measurement = read_measurement(item);
    if (std::ranges::any_of(out.measurements, [&](const Measurement& m) { return m.name == measurement.name; }))
      item.fault("name", "is given twice");
    if (measurement.kind == MeasurementKind::relaxation && out.relaxation.empty())
      item.fault("kind", "parameters.relaxation has no term to fit to it");
    out.measurements.push_back(std::move(measurement));
  }
  for (ConfigReader& item : in.sections("checks")) {
    ModelCheck check{.name = item.file_name("name"),
                     .mesh = item.text_or("mesh", ""),
                     .press = item.text_or("press", ""),
                     .changes = read_changes(item)};
    if (check.mesh.empty() && check.press.empty() && check.changes.empty())
      item.fault("name", "needs a mesh, a press or changes");
    out.checks.push_back(std::move(check));
  }
  if (!out.checks.empty() &&
      std::ranges::none_of(out.measurements, [](const Measurement& m) { return m.kind == MeasurementKind::press; }))
    in.fault("checks", "need a measurement of kind press");
  refuse_same_names(in, out);
  if (out.parameters.empty() && out.relaxation.empty()) in.fault("parameters", "names nothing to identify");
  return out;
}

const MechanicsParameter* IdentifySpec::find(const std::string& name) const {
  for (const MechanicsParameter& parameter : parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

std::vector<const MechanicsParameter*> IdentifySpec::axes() const {
  std::vector<const MechanicsParameter*> out;
  for (const char* name : {kPoisson, kThickness, kFriction})
    if (const MechanicsParameter* parameter = find(name)) out.push_back(parameter);
  return out;
}

std::vector<RunNode> IdentifySpec::nodes() const {
  std::vector<RunNode> out{{}};
  for (const MechanicsParameter* axis : axes()) {
    std::vector<RunNode> longer;
    for (const RunNode& node : out)
      for (const double value : axis->nodes) {
        longer.push_back(node);
        longer.back().values.push_back(value);
      }
    out = std::move(longer);
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i].name = fmt::format("n{:02}", i);
  return out;
}

RunNode IdentifySpec::middle() const {
  std::vector<double> values;
  for (const MechanicsParameter* axis : axes()) values.push_back(axis->nodes[(axis->nodes.size() - 1) / 2]);
  for (const RunNode& node : nodes())
    if (node.values == values) return node;
  return {};
}

std::string run_name(const Measurement& measurement, double depth_mm) {
  if (!measurement.sheared()) return measurement.name;
  return fmt::format("{}_{:04}um", measurement.name, std::lround(1e3 * depth_mm));
}

}  // namespace tacipc
