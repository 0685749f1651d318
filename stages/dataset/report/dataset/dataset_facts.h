// Facts about a dataset: gels, motions, settings and limits, from its plan and the records of its samples.
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

/// Description of a sensor and the mesh of its gel. Facts that an older record lacks are left out.
struct GelFacts {
  std::vector<std::pair<std::string, std::string>> lines;   // name and value
  std::vector<std::pair<std::string, std::string>> checks;  // checks of the verdict, with their limits
};

/// Reads the sensor, gel and images of a made sample.
GelFacts read_gel_facts(const std::filesystem::path& sample_folder);

/// Description of a motion.
struct MotionFacts {
  std::string name;
  std::string words;      // requested motion, with ranges
  std::string placement;  // placement of the object
};

/// Facts that all pages of a dataset share.
struct DatasetFacts {
  std::string name;
  std::optional<std::string> seed;
  std::string sampling;
  std::vector<MotionFacts> motions;
  std::map<std::string, GelFacts> gels;  // key: sensor-mesh; only gels with a made sample
  bool packed = false;                   // the folder pack/ exists
};

/// Reads the facts in dataset.yaml.
DatasetFacts read_dataset_facts(const std::string& name, const std::filesystem::path& dataset_yaml);

}  // namespace tacipc
