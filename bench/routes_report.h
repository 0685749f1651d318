// The same samples by two routes: which converged, and the differences between their results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_run.h"
#include "common/config/config.h"

namespace tacipc::bench {

/// Largest differences with which two results of one sample agree.
struct RouteLimits {
  double rms_m = 0.0;      // over the gel's vertices in the last frame
  double force = 0.0;      // of the press force, relative
  double largest_m = 0.0;  // of a vertex: beyond it a sample is named on the page, though it may agree

  static RouteLimits read(ConfigReader& in);
};

/// A run, or why there is none.
struct RouteRun {
  std::optional<Run> run;
  std::string failure;
};

/// One sample by both routes.
struct RoutePair {
  std::string object, pose;
  RouteRun fast, direct;

  bool both() const { return fast.run && direct.run; }
  std::optional<Difference> route_difference() const {
    return both() ? difference(*fast.run, *direct.run) : std::nullopt;
  }
  bool agrees(const RouteLimits& limits) const;
  bool agrees_at_every_vertex(const RouteLimits& limits) const;
};

/// From folders of presses that are named gel-object-pose-fast and gel-object-pose-direct; by object, then pose.
/// \throw DataError for other names, or where one of two is missing
std::vector<RoutePair> read_route_pairs(const std::vector<std::filesystem::path>& folders);

struct RouteSummary {
  int samples = 0, fast_converged = 0, direct_converged = 0, agree = 0;
  int agrees_at_every_vertex = 0;  // of those that agree: no vertex differs by more than the limit
  double median_largest_m = 0.0, median_rms_m = 0.0, median_force = 0.0;  // of those that converged in both
  double fast_s = 0.0, direct_s = 0.0;                                    // CPU seconds of those
  bool holds() const { return agree == samples; }
};
RouteSummary summarize(const std::vector<RoutePair>& pairs, const RouteLimits& limits);

/// A line per object, then each sample that failed, does not agree or has a vertex elsewhere.
std::string routes_page(const std::vector<RoutePair>& pairs, const RouteLimits& limits);

}  // namespace tacipc::bench
