// Reads and writes the file of a light field: section `light_field`, lengths in mm, weights in 8-bit levels.
#include <algorithm>
#include <array>
#include <functional>

#include "common/base/units.h"
#include "common/sensor/light_field.h"

namespace tacipc {
namespace {

constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};

Value rows_to_value(const LightField& light, int first) {
  Value::Map map;
  for (int c = 0; c < 3; ++c) {
    const auto codes = light.weights.col(c).segment(first, light.geometry.num_field_terms());
    map.emplace_back(kChannels[c], Value::List(codes.begin(), codes.end()));
  }
  return map;
}

void read_rows(ConfigReader in, const LightGeometry& geometry, std::vector<std::array<double, 3>>& rows) {
  const auto terms = static_cast<std::size_t>(geometry.num_field_terms());
  std::vector<std::array<double, 3>> of_field(terms);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto values = in.numbers(kChannels[c], terms);
    for (std::size_t f = 0; f < terms; ++f) of_field[f][c] = values[f];
  }
  rows.insert(rows.end(), of_field.begin(), of_field.end());
}

std::string monomial_key(int power_x, int power_y) {
  return "nx" + std::to_string(power_x) + "_ny" + std::to_string(power_y);
}

std::string bin_key(int azimuth, int band) {
  return "azimuth" + std::to_string(azimuth) + "_band" + std::to_string(band);
}

}  // namespace

DomeBins read_dome_bins(ConfigReader& in) {
  DomeBins bins;
  bins.azimuths = in.integer("azimuths", 3, 360);
  const auto bands = static_cast<std::size_t>(in.integer("bands", 1, 90));
  bins.elevation_tan = in.numbers("elevation_tan", bands, Range::non_negative());
  const auto& edges = bins.elevation_tan;
  if (std::ranges::adjacent_find(edges, std::greater_equal<>{}) != edges.end())
    in.fault("elevation_tan", "expected the bands' lower edges, ascending");
  return bins;
}

LightField LightField::read(ConfigReader& file) {
  ConfigReader in = file.section("light_field");
  LightField light;
  LightGeometry& geometry = light.geometry;
  geometry.field_half_width_m = 1e-3 * in.number("field_half_width_mm", Range::positive());
  geometry.field_degree = in.integer_or("field_degree", 1, 0, 4);
  geometry.shadow_softness = in.number("shadow_softness", Range::positive());
  light.blur_px = in.number("blur_px", Range::between(0.0, 100.0));
  std::vector<std::array<double, 3>> rows;
  for (ConfigReader& lamp : in.sections("lamps")) {
    geometry.lamps_m.push_back(1e-3 * lamp.vector3("position_mm"));
    if (!(geometry.lamps_m.back().z() < 0.0))
      lamp.fault("position_mm", "a lamp must lie behind the front face (z < 0)");
    geometry.lamp_half_width_rad.push_back(kDegree * lamp.number_or("half_width_deg", 0.0, Range::between(0.0, 90.0)));
    read_rows(lamp.section("linear_codes"), geometry, rows);
    read_rows(lamp.section("quadratic_codes"), geometry, rows);
  }
  if (auto dome = in.optional_section("dome")) {
    geometry.dome = read_dome_bins(*dome);
    for (int k = 0; k < geometry.dome.azimuths; ++k)
      for (int band = 0; band < geometry.dome.bands(); ++band)
        read_rows(dome->section(bin_key(k, band)), geometry, rows);
  }
  if (auto environment = in.optional_section("environment")) {
    geometry.environment_degree = environment->integer("degree", 0, 8);
    for (int degree = 1; degree <= geometry.environment_degree; ++degree)
      for (int y = 0; y <= degree; ++y) read_rows(environment->section(monomial_key(degree - y, y)), geometry, rows);
    geometry.environment_depth = environment->has("depth");
    if (geometry.environment_depth) read_rows(environment->section("depth"), geometry, rows);
  }
  if (rows.empty()) in.fault("lamps", "give lamps, an environment or both");
  light.weights.resize(rows.size(), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) light.weights(i, c) = rows[i][c];
  return light;
}

Value LightField::to_value() const {
  Value::Map out{{"field_half_width_mm", 1e3 * geometry.field_half_width_m},
                 {"field_degree", geometry.field_degree},
                 {"shadow_softness", geometry.shadow_softness},
                 {"blur_px", blur_px}};
  const int terms = geometry.num_field_terms();
  int row = 0;
  const auto& widths = geometry.lamp_half_width_rad;
  Value::List lamps;
  for (std::size_t l = 0; l < geometry.lamps_m.size(); ++l) {
    const Vector3& at = geometry.lamps_m[l];
    Value::Map lamp{{"position_mm", Value::List{1e3 * at.x(), 1e3 * at.y(), 1e3 * at.z()}}};
    if (!widths.empty() && widths[l] > 0.0) lamp.emplace_back("half_width_deg", widths[l] / kDegree);
    lamp.emplace_back("linear_codes", rows_to_value(*this, row));
    lamp.emplace_back("quadratic_codes", rows_to_value(*this, row + terms));
    lamps.push_back(std::move(lamp));
    row += 2 * terms;
  }
  if (!lamps.empty()) out.emplace_back("lamps", std::move(lamps));
  if (geometry.dome.size() > 0) {
    Value::Map dome{{"azimuths", geometry.dome.azimuths},
                    {"bands", geometry.dome.bands()},
                    {"elevation_tan", geometry.dome.elevation_tan}};
    for (int k = 0; k < geometry.dome.azimuths; ++k)
      for (int band = 0; band < geometry.dome.bands(); ++band, row += terms)
        dome.emplace_back(bin_key(k, band), rows_to_value(*this, row));
    out.emplace_back("dome", std::move(dome));
  }
  if (geometry.environment_degree > 0 || geometry.environment_depth) {
    Value::Map environment{{"degree", geometry.environment_degree}};
    for (int degree = 1; degree <= geometry.environment_degree; ++degree)
      for (int y = 0; y <= degree; ++y, row += terms)
        environment.emplace_back(monomial_key(degree - y, y), rows_to_value(*this, row));
    if (geometry.environment_depth) environment.emplace_back("depth", rows_to_value(*this, row));
    out.emplace_back("environment", std::move(environment));
  }
  return Value::Map{{"light_field", std::move(out)}};
}

}  // namespace tacipc
