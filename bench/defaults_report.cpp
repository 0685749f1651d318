#include "bench/defaults_report.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "common/base/error.h"
#include "common/sample/press_folder.h"
#include "tacipc_bench_texts.h"

namespace tacipc::bench {
namespace {

struct Found {
  Run run;
  std::filesystem::path folder;
};
using Runs = std::map<std::string, Found>;

const Run& need(const Runs& runs, const std::string& object, const std::string& which) {
  const auto found = runs.find(which);
  if (found == runs.end()) throw DataError("{}: there is no run …-{}-{}", object, object, which);
  return found->second.run;
}

DefaultsRow row_of(const std::string& object, const Runs& runs) {
  DefaultsRow row{.object = object,
                  .shipped = need(runs, object, "press-default"),
                  .once = need(runs, object, "press-once"),
                  .frictionless = need(runs, object, "press-frictionless"),
                  .wide = need(runs, object, "press-wide"),
                  .shear = std::nullopt,
                  .error_m = std::nullopt,
                  .wide_error_m = std::nullopt};
  if (const auto shear = runs.find("shear-default"); shear != runs.end()) row.shear = shear->second.run;
  const auto near = runs.find("press-near");
  if (near == runs.end()) return row;
  const Positions& last = near->second.run.last;
  for (const Run* run : {&row.shipped, &row.wide}) {
    if (run->last.rows() != last.rows())
      throw DataError("{}: {} and {} have different gels", object, run->text, near->second.run.text);
  }
  PressFolder press(near->second.folder, {{kVertices, static_cast<std::size_t>(last.rows())}});
  const std::vector<int> front = press.front_vertices();
  const Positions normal = press.contact_forces(press.extent(PressArray::contact_force, kFrames) - 1).normal;
  row.error_m = depth_error_m(row.shipped.last, last, front, normal);
  row.wide_error_m = depth_error_m(row.wide.last, last, front, normal);
  return row;
}

/// Mean over the rows that have the value.
template <typename Value>
std::optional<double> mean(const std::vector<DefaultsRow>& rows, Value&& value) {
  double sum = 0.0;
  int count = 0;
  for (const DefaultsRow& row : rows) {
    if (const std::optional<double> one = value(row)) {
      sum += *one;
      ++count;
    }
  }
  return count ? std::optional(sum / count) : std::nullopt;
}

std::string shown(const char* format, const std::optional<double>& value) {
  return value ? fmt::format(fmt::runtime(format), *value) : "";
}

std::optional<double> shear_s(const DefaultsRow& row) {
  return row.shear ? std::optional(row.shear->processor_s) : std::nullopt;
}

}  // namespace

std::vector<DefaultsRow> read_defaults(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> objects;
  std::map<std::string, Runs> found;
  for (const auto& folder : folders) {
    Run run = read_run(folder);
    const RunName name = run.name;
    if (!found.contains(name.object)) objects.push_back(name.object);
    found[name.object][name.motion + "-" + name.route] = {std::move(run), folder};
  }
  std::vector<DefaultsRow> rows;
  for (const std::string& object : objects) rows.push_back(row_of(object, found[object]));
  return rows;
}

double depth_error_m(const Positions& x, const Positions& near, const std::vector<int>& front,
                     const Positions& normal_n) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (normal_n.row(i).isZero(0.0)) continue;
    sum += std::abs(x(front[i], 2) - near(front[i], 2));
    ++count;
  }
  return count ? sum / count : 0.0;
}

std::string defaults_table(const std::vector<DefaultsRow>& rows, const std::string& processor) {
  std::string lines;
  const auto line = [&](const std::string& name, double shipped, double systems, double products, double once,
                        double frictionless, double wide, const std::optional<double>& error,
                        const std::optional<double>& wide_error, const std::optional<double>& shear) {
    lines +=
        fmt::format("| {} | {:.1f} | {:.0f} | {:.0f} | {:.1f} | {:.2f} | {:.1f} | {:.1f} | {:.2f} | {} | {} | {} |\n",
                    name, shipped, systems, products, once, shipped / once, frictionless, wide, shipped / wide,
                    shown("{:.1f}", error), shown("{:.1f}", wide_error), shown("{:.1f}", shear));
  };
  const auto micro = [](const std::optional<double>& m) { return m ? std::optional(1e6 * *m) : std::nullopt; };
  for (const DefaultsRow& row : rows) {
    line(row.object, row.shipped.processor_s, row.shipped.parts.at("linear_systems"), row.shipped.parts.at("products"),
         row.once.processor_s, row.frictionless.processor_s, row.wide.processor_s, micro(row.error_m),
         micro(row.wide_error_m), shear_s(row));
  }
  const auto time = [&](const Run DefaultsRow::*run) {
    return *mean(rows, [&](const DefaultsRow& row) { return std::optional((row.*run).processor_s); });
  };
  const auto part = [&](const char* name) {
    return *mean(rows, [&](const DefaultsRow& row) { return std::optional(row.shipped.parts.at(name)); });
  };
  if (!rows.empty()) {
    line("**mean**", time(&DefaultsRow::shipped), part("linear_systems"), part("products"), time(&DefaultsRow::once),
         time(&DefaultsRow::frictionless), time(&DefaultsRow::wide),
         micro(mean(rows, [](const DefaultsRow& row) { return row.error_m; })),
         micro(mean(rows, [](const DefaultsRow& row) { return row.wide_error_m; })), mean(rows, shear_s));
  }
  return fmt::format(kDefaultsTable, processor, rows.empty() ? 0 : rows.front().shipped.gel_vertices, lines);
}

}  // namespace tacipc::bench
