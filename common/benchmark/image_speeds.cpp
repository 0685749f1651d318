#include "common/benchmark/image_speeds.h"

#include <fmt/core.h>

#include "common/format/csv.h"

namespace tacipc {

std::string ImageSpeed::total() const {
  return fmt::format("{:.0f}", image_ms()) + (simulation_ms > 0.0 ? fmt::format(" + press {:.0f}", simulation_ms) : "");
}

std::string to_csv(const std::vector<ImageSpeed>& speeds) {
  std::string text =
      csv_line({"method", "width_px", "height_px", "simulation_ms", "object_ms", "membrane_ms", "light_ms"});
  for (const ImageSpeed& s : speeds)
    text += csv_line({s.method, fmt::format("{}", s.width_px), fmt::format("{}", s.height_px),
                      fmt::format("{}", s.simulation_ms), fmt::format("{}", s.object_ms),
                      fmt::format("{}", s.membrane_ms), fmt::format("{}", s.light_ms)});
  return text;
}

std::vector<ImageSpeed> read_image_speeds(const std::filesystem::path& file) {
  std::vector<ImageSpeed> speeds;
  CsvReader csv(file);
  while (csv.next())
    speeds.push_back({.method = csv["method"],
                      .width_px = static_cast<int>(csv.number("width_px")),
                      .height_px = static_cast<int>(csv.number("height_px")),
                      .simulation_ms = csv.number("simulation_ms"),
                      .object_ms = csv.number("object_ms"),
                      .membrane_ms = csv.number("membrane_ms"),
                      .light_ms = csv.number("light_ms")});
  return speeds;
}

}  // namespace tacipc
