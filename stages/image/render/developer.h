// Development of one sensor's traced radiance to codes, with its reference.
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
  std::optional<ByteImage> reference = std::nullopt;  // a real photograph; else it is synthetic
  bool needs_rays = true;                             // else the first unit's basis images serve
};

struct UnitSummary {
  std::string name = {};
  bool real_reference = false;
  std::optional<double> exposure = std::nullopt;  // of sensors with LEDs
  double reference_mean_code = 0.0;
  double clipped_fraction = 0.0;  // largest of all frames
};

/// Develops the frames of one unit, frame 0 (the gel at rest) first.
class Developer {
 public:
  virtual ~Developer() = default;
  /// Takes the gel at rest. Called once, first. \throw DataError if no light reaches it or nothing makes a reference
  virtual void set_reference(const TraceResult& rest) = 0;
  /// Radiance of what was traced, without markers; empty where the sensor's light is known in codes only.
  virtual FloatImage radiance(const TraceResult& traced) const = 0;
  virtual TactileImage develop(const TraceResult& traced, bool with_markers, std::size_t frame) = 0;
  const UnitSummary& summary() const { return summary_; }

 protected:
  UnitSummary summary_;
};

/// By radiance, exposure and response; of a sensor with a light field, by changes of the photograph's codes.
/// \throw DataError if the configuration asks of a light field what it cannot give
std::unique_ptr<Developer> make_developer(const RenderUnit& unit, const RenderConfig& config);

}  // namespace tacipc
