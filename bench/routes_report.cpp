#include "bench/routes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "tacipc_bench_texts.h"
#include "verification/stage_record.h"

namespace tacipc::bench {
namespace {

std::string line(const std::string& object, const std::vector<RoutePair>& pairs, const RouteLimits& limits) {
  const RouteSummary sum = summarize(pairs, limits);
  int fast_newton = 0, direct_newton = 0;
  Difference worst;
  for (const RoutePair& pair : pairs) {
    if (const auto d = pair.route_difference()) {
      worst.largest_m = std::max(worst.largest_m, d->largest_m);
      worst.rms_m = std::max(worst.rms_m, d->rms_m);
      worst.force = std::max(worst.force, std::abs(d->force));
      fast_newton += pair.fast.run->sum(&Frame::newton);
      direct_newton += pair.direct.run->sum(&Frame::newton);
    }
  }
  return fmt::format("| {} | {} of {} | {} of {} | {} of {} | {:.2g} | {:.2g} | {:.2g} | {} / {} | {:.0f} / {:.0f} |\n",
                     object, sum.fast_converged, sum.samples, sum.direct_converged, sum.samples, sum.agree, sum.samples,
                     1e6 * worst.largest_m, 1e6 * worst.rms_m, 100.0 * worst.force, fast_newton, direct_newton,
                     sum.fast_s, sum.direct_s);
}

}  // namespace

RouteLimits RouteLimits::read(ConfigReader& in) {
  RouteLimits limits;
  limits.largest_m = 1e-3 * in.number("largest_mm", Range::positive());
  limits.rms_m = 1e-3 * in.number("rms_mm", Range::positive());
  limits.force = 1e-2 * in.number("force_percent", Range::positive());
  return limits;
}

bool RoutePair::agrees(const RouteLimits& limits) const {
  const auto d = route_difference();
  return d && d->rms_m <= limits.rms_m && std::abs(d->force) <= limits.force;
}

bool RoutePair::agrees_at_every_vertex(const RouteLimits& limits) const {
  return agrees(limits) && route_difference()->largest_m <= limits.largest_m;
}

std::vector<RoutePair> read_route_pairs(const std::vector<std::filesystem::path>& folders) {
  std::map<std::pair<std::string, std::string>, std::map<std::string, RouteRun>> found;
  for (const auto& folder : folders) {
    const RunName name = parse_run_name(folder.lexically_normal().filename().string());
    RouteRun one;
    if (const auto failure = verify::why_no_record(folder, "press")) {
      one.failure = *failure;
    } else {
      one.run = read_run(folder);
    }
    found[{name.object, name.motion}][name.route] = std::move(one);
  }
  std::vector<RoutePair> pairs;
  for (auto& [of, routes] : found) {
    if (routes.size() != 2 || !routes.contains("fast") || !routes.contains("direct"))
      throw DataError("{}, {}: a sample needs one run named fast and one named direct", of.first, of.second);
    pairs.push_back({of.first, of.second, std::move(routes["fast"]), std::move(routes["direct"])});
  }
  return pairs;
}

RouteSummary summarize(const std::vector<RoutePair>& pairs, const RouteLimits& limits) {
  RouteSummary sum;
  std::vector<double> largest, rms, force;
  for (const RoutePair& pair : pairs) {
    ++sum.samples;
    sum.fast_converged += pair.fast.run ? 1 : 0;
    sum.direct_converged += pair.direct.run ? 1 : 0;
    sum.agree += pair.agrees(limits) ? 1 : 0;
    sum.agrees_at_every_vertex += pair.agrees_at_every_vertex(limits) ? 1 : 0;
    if (const auto d = pair.route_difference()) {
      largest.push_back(d->largest_m);
      rms.push_back(d->rms_m);
      force.push_back(std::abs(d->force));
      sum.fast_s += pair.fast.run->processor_s;
      sum.direct_s += pair.direct.run->processor_s;
    }
  }
  if (largest.empty()) return sum;
  sum.median_largest_m = upper_median(std::move(largest));
  sum.median_rms_m = upper_median(std::move(rms));
  sum.median_force = upper_median(std::move(force));
  return sum;
}

std::string routes_page(const std::vector<RoutePair>& pairs, const RouteLimits& limits) {
  const RouteSummary sum = summarize(pairs, limits);
  std::string rows;
  for (auto first = pairs.begin(); first != pairs.end();) {
    const auto last = std::find_if(first, pairs.end(), [&](const RoutePair& p) { return p.object != first->object; });
    rows += line(first->object, {first, last}, limits);
    first = last;
  }
  std::string out =
      fmt::format(kRoutesPage, sum.samples, sum.fast_converged, sum.direct_converged, sum.agree, 1e6 * limits.rms_m,
                  100.0 * limits.force, sum.agrees_at_every_vertex, 1e6 * limits.largest_m, 1e6 * sum.median_rms_m,
                  1e6 * sum.median_largest_m, 100.0 * sum.median_force, sum.fast_s, sum.direct_s, rows);
  std::string exceptions;
  for (const RoutePair& pair : pairs) {
    if (pair.agrees_at_every_vertex(limits)) continue;
    const std::string name = fmt::format("- {}, {}: ", pair.object, pair.pose);
    if (const auto d = pair.route_difference()) {
      exceptions += fmt::format("{}{:.2g} µm largest, {:.2g} µm rms, {:+.2g} % of the force\n", name,
                                1e6 * d->largest_m, 1e6 * d->rms_m, 100.0 * d->force);
    } else if (pair.both()) {
      exceptions += name + "on different gels\n";
    } else {
      if (!pair.fast.run) exceptions += fmt::format("{}by the default route: {}\n", name, pair.fast.failure);
      if (!pair.direct.run) exceptions += fmt::format("{}by factorisation: {}\n", name, pair.direct.failure);
    }
  }
  if (!exceptions.empty()) out += "\n## Samples that failed, or in which a vertex differs by more\n\n" + exceptions;
  return out;
}

}  // namespace tacipc::bench
