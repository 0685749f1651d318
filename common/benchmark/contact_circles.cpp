#include "common/benchmark/contact_circles.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "common/base/error.h"
#include "common/base/file_name.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

std::vector<std::string> fields_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

CircleTable CircleTable::read(ConfigReader& in) {
  CircleTable table;
  table.image = in.text("image");
  table.diameter_mm = in.text("diameter_mm");
  table.x_px = in.text("x_px");
  table.y_px = in.text("y_px");
  table.radius_px = in.text("radius_px");
  table.leave_out = in.text("leave_out");
  table.calibrate_every = in.integer("calibrate_every", 2, 1000);
  table.box_radii = in.number("box_radii", Range::positive());
  table.background_radii = in.number("background_radii", Range::positive());
  const auto size = in.numbers("image_px", 2, Range::between(1.0, 1e5));
  table.image_px = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  return table;
}

std::vector<BallLabel> read_contact_circles(const std::filesystem::path& path, const CircleTable& table,
                                            double ball_radius_m) {
  std::istringstream text(read_file(path));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = fields_of(line);
  const auto column = [&](const std::string& name) {
    const auto place = std::ranges::find(header, name);
    if (place == header.end()) throw DataError("{}: has no column {}", path.string(), name);
    return static_cast<std::size_t>(place - header.begin());
  };
  const std::size_t image = column(table.image), diameter = column(table.diameter_mm), x = column(table.x_px),
                    y = column(table.y_px), radius = column(table.radius_px), leave_out = column(table.leave_out);
  std::vector<BallLabel> circles;
  std::set<std::string> names;
  for (int number = 2; std::getline(text, line); ++number) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.empty()) continue;
    if (fields.size() != header.size())
      throw DataError("{}:{}: has {} fields, the header {}", path.string(), number, fields.size(), header.size());
    const auto value = [&](std::size_t k) {
      double read = 0.0;
      const char* end = fields[k].data() + fields[k].size();
      const auto [stop, error] = std::from_chars(fields[k].data(), end, read);
      if (error != std::errc{} || stop != end || !std::isfinite(read))
        throw DataError("{}:{}: {}: '{}' is not a number", path.string(), number, header[k], fields[k]);
      return read;
    };
    constexpr double kSameBall = 1e-6;
    if (value(leave_out) != 0.0 || std::abs(0.5e-3 * value(diameter) - ball_radius_m) > kSameBall) continue;
    const std::string& name = fields[image];
    if (!is_plain_path(name)) throw DataError("{}:{}: '{}' {}", path.string(), number, name, kPlainPathRule);
    if (!names.insert(name).second) throw DataError("{}:{}: {} is given twice", path.string(), number, name);
    circles.push_back({.image = name, .x_px = value(x), .y_px = value(y), .radius_px = value(radius)});
    if (!(circles.back().radius_px > 0.0)) throw DataError("{}:{}: the radius must be positive", path.string(), number);
  }
  if (circles.empty())
    throw DataError("{}: has no row of a ball of radius {:.4f} mm that counts", path.string(), 1e3 * ball_radius_m);
  return circles;
}

}  // namespace tacipc
