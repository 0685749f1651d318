// A simulator that knows the object's depth alone: everything that its frames have in common.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/image/image.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/baseline_config.h"
#include "stages/rival/baseline/change.h"
#include "stages/rival/baseline/object_depth.h"
#include "stages/rival/baseline/simulate_depth.h"

namespace tacipc {

class BaselineSimulator {
 public:
  /// `light`: the file of a model that has its light there. Kernels are scaled to the sensor's images.
  /// \pre background and light as the configuration wants them. \throw DataError, ConfigError of the light
  BaselineSimulator(const BaselineConfig& config, const Sensor& sensor, std::optional<ByteImage> background,
                    const std::optional<std::filesystem::path>& light);

  /// The mesh (m) that `seen` places. \throw UsageError if its depth would count from another sensor's front
  void take_object(const std::filesystem::path& mesh);
  bool has_object() const { return object_.has_value(); }

  SeenObject seen(Matrix4 pose) const;
  BaselineFrame frame(SeenObject object_seen) const;

  const BaselineConfig& config() const { return config_; }
  const Sensor& sensor() const { return sensor_; }
  const std::string& name() const { return name_; }

 private:
  BaselineConfig config_;  // for this camera
  Sensor sensor_;
  ObjectCamera camera_;
  Raster front_;
  std::optional<ByteImage> background_;
  std::optional<ChangeOfCodes> change_;
  std::optional<TriangleMesh> object_;
  Positions normals_;  // of its vertices, where the light wants them
  std::string name_;   // of its file
};

}  // namespace tacipc
