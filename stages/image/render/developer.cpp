#include "stages/image/render/developer.h"

#include <algorithm>
#include <cstdint>

#include "common/base/error.h"
#include "common/optics/seen_membrane.h"
#include "common/sensor/light_field.h"

namespace tacipc {
namespace {

double mean_of(const ByteImage& image) {
  std::uint64_t sum = 0;
  for (const std::uint8_t code : image.pixels) sum += code;
  return static_cast<double>(sum) / static_cast<double>(image.pixels.size());
}

const std::string& name_of(const RenderUnit& unit) { return unit.name.empty() ? unit.sensor.name : unit.name; }

class RadianceDeveloper : public Developer {
 public:
  RadianceDeveloper(const RenderUnit& unit, const RenderConfig& config) : unit_(unit), config_(config) {}

  void set_reference(const TraceResult& rest) override {
    const Sensor& sensor = unit_.sensor;
    signal_ = camera_signal(radiance(rest), sensor.camera, sensor.response);
    exposure_ = solve_exposure(signal_, sensor.response);
    codes_ = encode(signal_, exposure_, sensor.response);
    reference_ = unit_.reference
                     ? *unit_.reference
                     : synthetic_reference(signal_, exposure_, sensor.response, noise(), config_.noise_seed);
    summary_ = {.name = unit_.name,
                .real_reference = unit_.reference.has_value(),
                .exposure = exposure_,
                .reference_mean_code = mean_of(reference_)};
  }

  FloatImage radiance(const TraceResult& traced) const override { return color_image(traced, unit_.sensor, false); }

  TactileImage develop(const TraceResult& traced, bool with_markers, std::size_t frame) override {
    const Sensor& sensor = unit_.sensor;
    FloatImage signal = camera_signal(color_image(traced, sensor, with_markers), sensor.camera, sensor.response);
    // Fresh noise is added to the reference's, which frame 0 already has.
    if (config_.noise_in_every_frame && (frame > 0 || config_.transfer == Transfer::none))
      signal = add_noise(signal, exposure_, noise(), config_.noise_seed, kFrameStreams + frame);
    TactileImage out = [&] {
      if (config_.transfer == Transfer::linear)
        return transfer_ratio(reference_, signal, signal_, exposure_, sensor.response);
      const FloatImage codes = encode(signal, exposure_, sensor.response, last_);
      if (!with_markers) last_ = {std::move(signal), codes};
      return config_.transfer == Transfer::none ? quantise(codes) : transfer_noise(reference_, codes, codes_);
    }();
    summary_.clipped_fraction = std::max(summary_.clipped_fraction, out.clipped_fraction);
    return out;
  }

 private:
  static constexpr std::uint64_t kFrameStreams = 1000;  // one stream of random numbers per frame

  const SensorNoise& noise() const {
    if (!unit_.sensor.noise) {
      throw DataError("{}: the sensor has neither a reference_image nor a section noise to make one with",
                      name_of(unit_));
    }
    return *unit_.sensor.noise;
  }

  const RenderUnit& unit_;
  const RenderConfig& config_;
  FloatImage signal_, codes_;
  Encoded last_;  // state of the image without markers, made before the one with markers
  ByteImage reference_;
  double exposure_ = 0.0;
};

/// Developer by changes: tactile = clamp(round(reference + change − change at rest), 0, 255). It transfers the noise,
/// as in the calibration of the light field.
class ChangeDeveloper : public Developer {
 public:
  ChangeDeveloper(const RenderUnit& unit, const RenderConfig& config) : unit_(unit), refract_(config.trace.refract) {
    if (config.transfer != Transfer::encoded || config.noise_in_every_frame)
      throw DataError(
          "{}: a light_field changes a photograph's codes: transfer must be encoded, noise.every_frame false",
          name_of(unit));
  }

  void set_reference(const TraceResult& rest) override {
    change_ = change_of(rest);
    summary_ = {.name = unit_.name, .real_reference = true, .reference_mean_code = mean_of(unit_.reference.value())};
  }

  FloatImage radiance(const TraceResult&) const override { return {}; }

  TactileImage develop(const TraceResult& traced, bool, std::size_t) override {
    TactileImage out = transfer_noise(unit_.reference.value(), change_of(traced), change_);
    summary_.clipped_fraction = std::max(summary_.clipped_fraction, out.clipped_fraction);
    return out;
  }

 private:
  FloatImage change_of(const TraceResult& traced) const {
    return code_change(unit_.sensor.light_field.value(), view_of(traced, unit_.sensor, refract_));
  }

  const RenderUnit& unit_;
  bool refract_;
  FloatImage change_;
};

}  // namespace

std::unique_ptr<Developer> make_developer(const RenderUnit& unit, const RenderConfig& config) {
  if (unit.sensor.light_field) return std::make_unique<ChangeDeveloper>(unit, config);
  return std::make_unique<RadianceDeveloper>(unit, config);
}

}  // namespace tacipc
