// Configuration of a dataset in one file: sensors, objects, motions, sampling, splits, and the files to keep.
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
  std::string name;  // name of the sensor's file
  std::string mesh;  // name of the mesh's file
  std::filesystem::path sensor;
  std::filesystem::path mesh_config;
  std::optional<std::filesystem::path> import = std::nullopt;  // finished mesh, for kind: import

  std::string gel() const { return name + "-" + mesh; }
};

/// An object: an embossed pattern, or a mesh of the user.
struct ObjectChoice {
  std::string name;
  std::filesystem::path file;
  bool embossed = false;
  ObjectSpec spec = {};
};

/// A motion, of which each object gets `samples` samples in each sensor.
struct MotionChoice {
  std::string name;
  int samples = 1;
  std::filesystem::path press;  // press configuration
  MotionTemplate motion;
};

/// Members of an ensemble that also press every sample of its sensor.
struct EnsembleChoice {
  Ensemble ensemble;  // ensemble without the members that are not pressed
  std::filesystem::path file;
  std::optional<std::filesystem::path> mesh_config =
      std::nullopt;  // mesh of the members' gels; absent: the mesh of the sample

  /// True if members press the samples of this sensor.
  bool is_of(const SensorChoice& sensor) const;
  /// Name of the mesh of the members' gels, and of the gel of a press (DatasetEnsemble::presses).
  std::string mesh_of(const SensorChoice& sensor) const;
  std::string gel_of(const SensorChoice& sensor, const std::string& press) const;
  /// Sensor file of a member, as the make rules name it.
  static std::string sensor_file(const SensorChoice& sensor, const std::string& member);
  /// Ensemble in the form that pack reads.
  DatasetEnsemble planned(const std::vector<SensorChoice>& sensors) const;
};

/// Fractions of objects, and of poses, in validation and test; objects may also be named.
struct Splits {
  double val = 0.0;
  double test = 0.0;
  std::vector<std::string> val_objects = {};
  std::vector<std::string> test_objects = {};
};

/// Content of configs/datasets/*.yaml. Paths in it are relative to the file; here they are relative to the folder in
/// which the stage runs.
struct DatasetConfig {
  int seed = 0;
  bool low_discrepancy = true;  // true: low-discrepancy sequence; false: independent random numbers
  std::vector<SensorChoice> sensors = {};
  std::vector<ObjectChoice> objects = {};
  std::vector<MotionChoice> motions = {};
  std::filesystem::path decimate;
  std::filesystem::path render;
  DatasetMaps maps = {};
  std::optional<EnsembleChoice> ensemble = std::nullopt;
  Splits splits;
  double shard_bytes = 1e9;
  std::string pack = "full";           // profile with which a finished run packs, or none
  std::vector<std::string> keep = {};  // stages whose files remain after the dataset is packed
  int stop_after_failures = 10;        // number of successive failures that stops a run

  static DatasetConfig read(ConfigReader& in);
  /// files and folders that the configuration names; a change of one may change the plan
  std::vector<std::filesystem::path> named = {};
};

}  // namespace tacipc
