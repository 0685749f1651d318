// What the settings that are shipped cost, object by object, and how near to the object the gel comes with them.
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
  Run shipped;                    // press-default
  Run once;                       // press-once: friction lagged once per step
  Run frictionless;               // press-frictionless
  Run wide;                       // press-wide: the paper's d̂
  std::optional<Run> shear;       // shear-default: dragged after the press
  std::optional<double> error_m;  // mean |z − z′| in the last frame over the front vertices that are pressed in the
  std::optional<double> wide_error_m;  // press-near (z′), a twentieth of the paper's d̂; of `shipped` and of `wide`
};

/// One row per object, in the order of the folders.
/// \throw DataError for other names, where one of the first four is missing, or where a near press has another gel
std::vector<DefaultsRow> read_defaults(const std::vector<std::filesystem::path>& folders);

/// Mean |z − z′| over the listed vertices whose normal force (rows of `normal_n`) is not zero; zero where there are
/// none.
double depth_error_m(const Positions& x, const Positions& near, const std::vector<int>& front,
                     const Positions& normal_n);

/// The rows and their means as a table with a sentence on each of its columns.
std::string defaults_table(const std::vector<DefaultsRow>& rows, const std::string& processor);

}  // namespace tacipc::bench
