// Inputs of the stages of a benchmark or of an identification, from its one file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/benchmark/benchmark_cases.h"
#include "common/benchmark/identify_spec.h"
#include "common/benchmark/marker_benchmark.h"

namespace tacipc {

/// Name and content of each file. `folder` is that of the benchmark's file: paths in it are relative to there.
using CaseFiles = std::vector<std::pair<std::string, std::string>>;

/// Of a photograph benchmark: cases.mk (variables for Make), ball/ and <object>/ {indenter.yaml, motion.yaml,
/// shade.yaml}, metrics.yaml; with circles labels.txt and background.yaml, and no press but that of ball/.
CaseFiles case_files(const BenchmarkCases& cases, const std::string& folder);

/// Of the identification of a sensor's mechanics: `<measurement>/indenter.yaml`, `motion_<run>.yaml`, and `cases.mk`
/// with what a makefile has to know.
CaseFiles identify_files(const IdentifySpec& spec, const std::string& folder);

/// Of a marker benchmark: cases.mk, motion_<µm>.yaml per depth, and for the base and each variant that is simulated
/// <name>/{indenter.yaml, friction.yaml}, the latter to follow the press configuration, which has no section friction.
/// Make puts thickness into a copy of the sensor.
CaseFiles marker_files(const MarkerBenchmark& benchmark, const std::string& folder);

}  // namespace tacipc
