// One press of the benchmark, read from its folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"

namespace tacipc::bench {

/// Name of a run, gel-object-motion-route[-how], such as 24k-coin-press-direct. Runs are compared by its parts.
struct RunName {
  std::string gel, object, motion, route, how;
  /// Name of the same press by another route, without `how`.
  std::string with_route(const std::string& other) const { return gel + "-" + object + "-" + motion + "-" + other; }
};

/// Splits a name.
/// \throw DataError if the number of parts is wrong
RunName parse_run_name(const std::string& name);

/// Counts of one saved frame.
struct Frame {
  bool press = false;  // true: frame of the press; false: of the motion after it
  int contacts = 0;    // front vertices in contact
  int newton = 0;      // Newton iterations of the whole gel
  int patch = 0;       // Newton iterations of patches
};

/// One finished press with its timings.
struct Run {
  std::string text;  // the whole name
  RunName name;
  int gel_vertices = 0;
  int threads = 1;
  double press_force_n = 0.0;
  std::vector<Frame> frames;  // frames without frame 0
  double processor_s = 0.0, wall_s = 0.0, peak_memory_mb = 0.0;
  std::map<std::string, double> parts;  // seconds and counts by the names of the timings of `press`
  Positions last;                       // last vertex positions of the gel, m

  /// Sum over all frames.
  int sum(int Frame::*count) const;
};

/// Reads a run.
/// \throw DataError, ConfigError if the folder does not hold a finished press with its timings
Run read_run(const std::filesystem::path& folder);

/// Differences between two results of one scene.
struct Difference {
  double largest_m = 0.0, rms_m = 0.0, force = 0.0;  // lengths in m; force: relative
};
/// \return nothing if the gels differ
std::optional<Difference> difference(const Run& run, const Run& from);

}  // namespace tacipc::bench
