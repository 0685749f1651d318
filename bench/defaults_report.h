// Cost of the default settings, object by object, and the gap between object and gel that remains with them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_run.h"

namespace tacipc::bench {

/// One object: presses that differ in one setting each, named gel-object-motion-route.
struct DefaultsRow {
  std::string object;
  Run shipped;               // press-default
  Run once;                  // press-once: friction updated once per step
  Run frictionless;          // press-frictionless
  Run wide;                  // press-wide: the paper's d̂
  std::optional<Run> shear;  // shear-default: sideways motion after the press
  std::optional<double> error_m;  // mean |z − z′| of `shipped`, m: z′ from press-near (a twentieth of the paper's d̂),
                                  // last frame, pressed front vertices
  std::optional<double> wide_error_m;  // mean |z − z′| of `wide`, m
};

/// Reads one row per object, in the order of the folders.
/// \throw DataError for other names, if one of the first four presses is missing, or if a near press has another gel
std::vector<DefaultsRow> read_defaults(const std::vector<std::filesystem::path>& folders);

/// Mean |z − z′| over the listed vertices whose normal force (rows of `normal_n`) is not zero, m; zero if there are
/// none.
double depth_error_m(const Positions& x, const Positions& near, const std::vector<int>& front,
                     const Positions& normal_n);

/// Table of the rows and their means, with a sentence on each column.
std::string defaults_table(const std::vector<DefaultsRow>& rows, const std::string& processor);

}  // namespace tacipc::bench
