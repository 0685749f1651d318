// Simulator that uses only the object's depth, with everything that its frames share.
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

/// Maps and image of one frame.
struct BaselineFrame {
  FloatImage indentation;            // m, > 0 into the gel, without texture
  FloatImage depth;                  // m along the camera's axis, with texture
  std::optional<ByteImage> tactile;  // present if the configuration shades
  double membrane_s = 0.0;           // processor time of the membrane and of the light
  double light_s = 0.0;
};

/// Simulates the frames of one object in one sensor.
class BaselineSimulator {
 public:
  /// Scales kernels to the sensor's images.
  /// \param light file of the light, for models that read one
  /// \param shadows shadows of a pyramid, for the table model
  /// \pre background, light and shadows are given as the configuration requires
  /// \throw DataError, ConfigError from reading the light
  BaselineSimulator(const BaselineConfig& config, const Sensor& sensor, std::optional<ByteImage> background,
                    const std::optional<std::filesystem::path>& light,
                    const std::optional<std::filesystem::path>& shadows = std::nullopt);

  /// Sets the mesh (m) that `seen` places.
  /// \throw UsageError if its depth would refer to the front of another sensor
  void take_object(const std::filesystem::path& mesh);
  bool has_object() const { return object_.has_value(); }

  SeenObject seen(Matrix4 pose) const;
  /// \pre the object's images have the size of the sensor's images
  BaselineFrame frame(SeenObject object_seen) const;

  const BaselineConfig& config() const { return config_; }
  const Sensor& sensor() const { return sensor_; }
  const std::string& name() const { return name_; }

 private:
  BaselineConfig config_;  // configuration scaled to this camera
  Sensor sensor_;
  ObjectCamera camera_;
  Raster front_;
  std::optional<ByteImage> background_;
  std::optional<ChangeOfCodes> change_;
  std::optional<TriangleMesh> object_;
  Positions normals_;  // vertex normals, if the light needs them
  std::string name_;   // name of the object's file
};

/// Depth (m) from channel Z of a float EXR, as render writes it.
Raster read_depth(const std::filesystem::path& path);

/// Processor time of this process, s.
double processor_s();

}  // namespace tacipc
