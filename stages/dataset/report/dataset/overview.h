// Writes the first page of a dataset: contents, distributions, failures, costs, and the meaning of its checks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/dataset/report/dataset/dataset_facts.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/dataset/tally.h"

namespace tacipc {

/// Costs of everything but samples: gels, objects, shards.
struct OtherCost {
  std::string stage;
  CostColumn costs;
};

/// Inputs of the first page.
struct Overview {
  const DatasetFacts& facts;
  const DatasetTally& tally;
  const std::vector<OtherCost>& others;
  const std::vector<SampleShot>& shots;  // samples that have pages
  std::filesystem::path dataset;         // folder of the dataset
  std::filesystem::path folder;          // final folder of the page
};

std::string overview_page(const Overview& overview);

/// Parts of the page, for a file each: the plots; counts, failures, and seconds and memory as tables.
std::string coverage_section(const DatasetTally& tally);
std::string counts_section(const DatasetTally& tally);
std::string failures_section(const Overview& overview);
std::string costs_section(const DatasetTally& tally, const std::vector<OtherCost>& others);

}  // namespace tacipc
