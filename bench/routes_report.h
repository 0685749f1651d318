// Compares the same samples by two routes: which converged, and the differences between their results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_run.h"
#include "common/config/config.h"

namespace tacipc::bench {

/// Limits within which two results of one sample agree.
struct RouteLimits {
  double rms_m = 0.0;      // root mean square over the gel's vertices in the last frame, m
  double force = 0.0;      // difference of the press force, relative
  double largest_m = 0.0;  // difference of one vertex, m; a sample beyond it is named on the page although it may agree

  static RouteLimits read(ConfigReader& in);
};

/// A run, or the reason for its failure.
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

/// Reads folders of presses named gel-object-pose-fast and gel-object-pose-direct; sorted by object, then pose.
/// \throw DataError for other names, or if one of the two is missing
std::vector<RoutePair> read_route_pairs(const std::vector<std::filesystem::path>& folders);

/// Counts and medians over all samples.
struct RouteSummary {
  int samples = 0, fast_converged = 0, direct_converged = 0, agree = 0;
  int agrees_at_every_vertex = 0;  // number of agreeing samples of which no vertex differs by more than the limit
  double median_largest_m = 0.0, median_rms_m = 0.0,
         median_force = 0.0;            // medians over the samples that converged by both routes
  double fast_s = 0.0, direct_s = 0.0;  // CPU seconds of the samples that converged by both routes
  bool holds() const { return agree == samples; }
};
RouteSummary summarize(const std::vector<RoutePair>& pairs, const RouteLimits& limits);

/// Page with a line per object, then each sample that failed, disagrees, or has a vertex beyond the limit.
std::string routes_page(const std::vector<RoutePair>& pairs, const RouteLimits& limits);

}  // namespace tacipc::bench
