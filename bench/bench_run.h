// One press of the benchmark as it left its folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"

namespace tacipc::bench {

/// What a run is compared by: its name is gel-object-motion-route[-how], e.g. 24k-coin-press-direct.
struct RunName {
  std::string gel, object, motion, route, how;
  /// The same press by another route, run plainly.
  std::string with_route(const std::string& other) const { return gel + "-" + object + "-" + motion + "-" + other; }
};

/// \throw DataError for a name with another number of parts
RunName parse_run_name(const std::string& name);

struct Frame {
  bool press = false;  // of the press, else of what comes after it
  int contacts = 0;    // front vertices that touch
  int newton = 0;      // iterations of the whole gel,
  int patch = 0;       // and of patches
};

struct Run {
  std::string text;  // the whole name
  RunName name;
  int gel_vertices = 0;
  int threads = 1;
  double press_force_n = 0.0;
  std::vector<Frame> frames;  // without frame 0
  double processor_s = 0.0, wall_s = 0.0, peak_memory_mb = 0.0;
  std::map<std::string, double> parts;  // seconds and counts, as press names them
  Positions last;                       // of the gel, m

  /// Over all frames.
  int sum(int Frame::*count) const;
};

/// \throw DataError, ConfigError where the folder does not hold a finished press with its timings
Run read_run(const std::filesystem::path& folder);

/// Differences between two results of one scene, m.
struct Difference {
  double largest_m = 0.0, rms_m = 0.0, force = 0.0;  // force: relative
};
/// Nothing where the gels differ.
std::optional<Difference> difference(const Run& run, const Run& from);

}  // namespace tacipc::bench
