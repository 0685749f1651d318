// Develops one sensor's traced radiance into grey levels, with its reference.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/image/image.h"
#include "common/optics/develop.h"
#include "common/optics/trace.h"
#include "common/sensor/sensor.h"
#include "stages/image/render/render_config.h"

namespace tacipc {

/// One sensor to render with: the sensor itself (name empty) or a variant.
struct RenderUnit {
  std::string name = {};
  Sensor sensor = {};
  std::optional<ByteImage> reference = std::nullopt;  // a real photograph; absent: the reference is synthetic
  bool needs_rays = true;                             // false: the first unit's basis images serve
};

/// Summary of one unit, for the record.
struct UnitSummary {
  std::string name = {};
  bool real_reference = false;
  std::optional<double> exposure = std::nullopt;  // set for sensors with LEDs
  double reference_mean_code = 0.0;
  double clipped_fraction = 0.0;  // largest fraction of all frames
};

/// Develops the frames of one unit, frame 0 (the gel at rest) first.
class Developer {
 public:
  virtual ~Developer() = default;
  /// Takes the gel at rest; must be called first, once.
  /// \throw DataError if no light reaches it or no reference can be made
  virtual void set_reference(const TraceResult& rest) = 0;
  /// Radiance of the traced frame, without markers; empty if the sensor's light is known only in grey levels.
  virtual FloatImage radiance(const TraceResult& traced) const = 0;
  virtual TactileImage develop(const TraceResult& traced, bool with_markers, std::size_t frame) = 0;
  const UnitSummary& summary() const { return summary_; }

 protected:
  UnitSummary summary_;
};

/// Developer by radiance, exposure and response; for a sensor with a light field, by changes of the photograph's grey
/// levels.
/// \throw DataError if the configuration asks for something that a light field cannot give
std::unique_ptr<Developer> make_developer(const RenderUnit& unit, const RenderConfig& config);

}  // namespace tacipc
