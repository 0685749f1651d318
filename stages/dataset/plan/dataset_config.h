// A dataset as one file: sensors, objects, motions, how samples are drawn and split, what is kept.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/dataset_maps.h"
#include "common/sample/ensemble.h"
#include "common/sample/object.h"
#include "stages/dataset/plan/motion_template.h"

namespace tacipc {

/// A sensor and the mesh of its gel.
struct SensorChoice {
  std::string name;  // of the sensor's file
  std::string mesh;  // of the mesh's file
  std::filesystem::path sensor;
  std::filesystem::path mesh_config;
  std::optional<std::filesystem::path> import = std::nullopt;  // a finished mesh, for kind: import

  std::string gel() const { return name + "-" + mesh; }
};

/// An object: an embossed pattern or a mesh of the user's.
struct ObjectChoice {
  std::string name;
  std::filesystem::path file;
  bool embossed = false;
  ObjectSpec spec = {};
};

/// A motion of which each object makes `samples` in each sensor.
struct MotionChoice {
  std::string name;
  int samples = 1;
  std::filesystem::path press;  // numerics
  MotionTemplate motion;
};

/// Members of an ensemble that press every sample of its sensor, too.
struct EnsembleChoice {
  Ensemble ensemble;  // no more members than are pressed
  std::filesystem::path file;
  std::optional<std::filesystem::path> mesh_config = std::nullopt;  // of the gels of members; absent: the sample's

  /// Whether samples of this sensor are pressed by members.
  bool is_of(const SensorChoice& sensor) const;
  /// Name of the mesh of the members' gels, and of the gel of a press (DatasetEnsemble::presses).
  std::string mesh_of(const SensorChoice& sensor) const;
  std::string gel_of(const SensorChoice& sensor, const std::string& press) const;
  /// Its sensor file, as the make rules name it.
  static std::string sensor_file(const SensorChoice& sensor, const std::string& member);
  /// What pack has to know of it.
  DatasetEnsemble planned(const std::vector<SensorChoice>& sensors) const;
};

/// Shares of objects, and of poses, that validation and test have; objects may also be named.
struct Splits {
  double val = 0.0;
  double test = 0.0;
  std::vector<std::string> val_objects = {};
  std::vector<std::string> test_objects = {};
};

/// configs/datasets/*.yaml. Paths in it are relative to the file; here they are as seen from where the stage runs.
struct DatasetConfig {
  int seed = 0;
  bool low_discrepancy = true;  // else independent random numbers
  std::vector<SensorChoice> sensors = {};
  std::vector<ObjectChoice> objects = {};
  std::vector<MotionChoice> motions = {};
  std::filesystem::path decimate;
  std::filesystem::path render;
  DatasetMaps maps = {};
  std::optional<EnsembleChoice> ensemble = std::nullopt;
  Splits splits;
  double shard_bytes = 1e9;
  std::string pack = "full";           // profile that a finished run packs with, or none
  std::vector<std::string> keep = {};  // stages whose files stay once the dataset is packed
  int stop_after_failures = 10;        // in a row

  static DatasetConfig read(ConfigReader& in);
  /// Files and folders that the configuration names: when one changes, the plan may be another.
  std::vector<std::filesystem::path> named = {};
};

}  // namespace tacipc
