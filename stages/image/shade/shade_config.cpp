#include "stages/image/shade/shade_config.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc {

ShadeConfig ShadeConfig::read(ConfigReader& in) {
  ShadeConfig config;
  if (auto ball = in.optional_section("ball"))
    config.ball_radius_m = 1e-3 * ball->number("radius_mm", Range::positive());
  for (ConfigReader& item : in.one_or_more_sections("images")) {
    NamedFrame image{.name = item.text("name"), .frame = 0, .contact = std::nullopt};
    if (config.ball_radius_m) {
      const auto center = item.numbers("center_px", 2);
      image.contact = ContactPlace{.center = {.x_px = center[0], .y_px = center[1]},
                                   .radius_px = item.number("contact_px", Range::positive())};
    } else {
      image.frame = item.integer("frame", 0, 1000000);
    }
    config.images.push_back(image);
    const auto same = [&](const NamedFrame& other) { return other.name == config.images.back().name; };
    if (std::count_if(config.images.begin(), config.images.end(), same) > 1) item.fault("name", "is given twice");
  }
  if (config.ball_radius_m) return config;
  ConfigReader place = in.section("place");
  const auto center = place.numbers("center_px", 2);
  config.place = {
      .x_px = center[0], .y_px = center[1], .yaw_rad = place.number_or("yaw_deg", 0.0) * std::numbers::pi / 180.0};
  if (auto fit = in.optional_section("fit")) {
    PlaceFit wanted{.image = fit->text("image"), .box_px = {}, .yaw = fit->flag("yaw")};
    const auto box = fit->numbers("box_px", 4, Range::between(0.0, 1e6));
    for (std::size_t i = 0; i < 4; ++i) {
      wanted.box_px[i] = static_cast<int>(box[i]);
      if (box[i] != std::round(box[i]) || (i > 1 && box[i] < 1.0)) {
        fit->fault("box_px", "expected whole pixels, at least one wide and high");
        break;
      }
    }
    if (std::none_of(config.images.begin(), config.images.end(),
                     [&](const NamedFrame& image) { return image.name == wanted.image; }))
      fit->fault("image", "is not one of the images");
    config.fit = wanted;
  }
  return config;
}

}  // namespace tacipc
