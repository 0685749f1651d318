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

namespace tacipc {

struct BaselineFrame {
  FloatImage indentation;            // m, > 0 into the gel, without texture
  FloatImage depth;                  // m along the camera's axis, with texture
  std::optional<ByteImage> tactile;  // where the configuration shades
  double membrane_s = 0.0;           // processor time of membrane and light
  double light_s = 0.0;
};

class BaselineSimulator {
 public:
  /// `light`: the file of a model that has its light there; `shadows`: of a pyramid under a table. Kernels are scaled
  /// to the sensor's images. \pre background, light and shadows as the configuration wants them. \throw DataError,
  /// ConfigError of the light
  BaselineSimulator(const BaselineConfig& config, const Sensor& sensor, std::optional<ByteImage> background,
                    const std::optional<std::filesystem::path>& light,
                    const std::optional<std::filesystem::path>& shadows = std::nullopt);

  /// The mesh (m) that `seen` places. \throw UsageError if its depth would count from another sensor's front
  void take_object(const std::filesystem::path& mesh);
  bool has_object() const { return object_.has_value(); }

  SeenObject seen(Matrix4 pose) const;
  /// \pre of the size of the sensor's images
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

/// Depth (m) of a float EXR as render writes it: channel Z.
Raster read_depth(const std::filesystem::path& path);

/// Processor time of this process, s.
double processor_s();

}  // namespace tacipc
