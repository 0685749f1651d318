// What a dataset is made of: gels, motions, settings and limits, as its plan and the records of its samples tell.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/stage/record.h"
#include "stages/dataset/report/dataset/sample_row.h"

namespace tacipc {

/// A sensor and the mesh of its gel, in words. What the record of an older version does not have is left out.
struct GelFacts {
  std::vector<std::pair<std::string, std::string>> lines;   // name and value
  std::vector<std::pair<std::string, std::string>> checks;  // of the verdict, with their limits
};

/// From a made sample: its sensor, gel and images.
GelFacts read_gel_facts(const std::filesystem::path& sample_folder);

struct MotionFacts {
  std::string name;
  std::string words;      // what is asked for, with ranges
  std::string placement;  // where the object stands
};

struct DatasetFacts {
  std::string name;
  std::optional<std::string> seed;
  std::string sampling;
  std::vector<MotionFacts> motions;
  std::map<std::string, GelFacts> gels;  // by sensor-mesh; those of which a sample is made
  bool packed = false;                   // pack/ is there
};

/// What dataset.yaml says.
DatasetFacts read_dataset_facts(const std::string& name, const std::filesystem::path& dataset_yaml);

}  // namespace tacipc
