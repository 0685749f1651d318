// The first page of a dataset: what is in it, how it is spread, what failed, what it cost, what its checks prove.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/dataset/report/dataset/dataset_facts.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/dataset/tally.h"

namespace tacipc {

/// Costs of what is not a sample: gels, objects, shards.
struct OtherCost {
  std::string stage;
  CostColumn costs;
};

struct Overview {
  const DatasetFacts& facts;
  const DatasetTally& tally;
  const std::vector<OtherCost>& others;
  const std::vector<SampleShot>& shots;  // samples that have pages
  std::filesystem::path dataset;         // its folder
  std::filesystem::path folder;          // where the page will lie
};

std::string overview_page(const Overview& overview);

/// Parts of it, for a file each: the plots; counts, failures, and seconds and memory as tables.
std::string coverage_section(const DatasetTally& tally);
std::string counts_section(const DatasetTally& tally);
std::string failures_section(const Overview& overview);
std::string costs_section(const DatasetTally& tally, const std::vector<OtherCost>& others);

}  // namespace tacipc
