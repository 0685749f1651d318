// Makes the inputs of the stages of a benchmark or an identification from its single file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/benchmark/benchmark_cases.h"
#include "common/benchmark/identify_spec.h"
#include "common/benchmark/marker_benchmark.h"

namespace tacipc {

/// Name and content of each file. `folder` is the folder of the benchmark's file; paths in that file are relative to
/// it.
using CaseFiles = std::vector<std::pair<std::string, std::string>>;

/// Files of a photograph benchmark: cases.mk (variables for Make), ball/ and <object>/ {indenter.yaml, motion.yaml,
/// shade.yaml}, and metrics.yaml. A benchmark of circles also gets labels.txt and background.yaml, and ball/ has its
/// only press.
CaseFiles case_files(const BenchmarkCases& cases, const std::string& folder);

/// Files of an identification of a sensor's mechanics: `<measurement>/indenter.yaml`, `motion_<run>.yaml`, and
/// `cases.mk` with the variables for Make.
CaseFiles identify_files(const IdentifySpec& spec, const std::string& folder);

/// Files of a marker benchmark: cases.mk, motion_<µm>.yaml per depth, and <name>/{indenter.yaml, friction.yaml} for the
/// base and each simulated variant. The text of friction.yaml is appended to the press configuration, which has no
/// section friction. Make writes the thickness into a copy of the sensor.
CaseFiles marker_files(const MarkerBenchmark& benchmark, const std::string& folder);

}  // namespace tacipc
