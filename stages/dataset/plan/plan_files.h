// Writes the files of a plan for make and for the stages.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stages/dataset/plan/choices.h"
#include "stages/dataset/plan/sample_plan.h"

namespace tacipc {

/// Name and content of each file of the plan except dataset.yaml: samples.csv; dataset.mk (gels, objects and settings);
/// blocks/NNN.mk (the samples of one folder); inputs.mk and inputs.txt (prerequisites of the plan); paths/*.csv.
std::vector<std::pair<std::string, std::string>> plan_files(const DatasetConfig& config,
                                                            const std::vector<Choice>& choices,
                                                            const std::vector<PlannedSample>& samples);

/// Writes choices/, objects/<object>/object.yaml, and sample.yaml in the folder of each sample below `dataset`. Files
/// with the same bytes are not rewritten, so that make redoes only changed results.
/// \return number of samples written
int write_dataset_files(const DatasetConfig& config, const std::vector<Choice>& choices,
                        const std::vector<PlannedSample>& samples, const std::filesystem::path& dataset);

}  // namespace tacipc
