#include "common/sample/body_keys.h"

#include <algorithm>
#include <cctype>
#include <numbers>

#include "common/sample/motion.h"

namespace tacipc {

std::string read_body_name(ConfigReader& in, const std::string& key) {
  std::string name = in.text(key);
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    in.fault(key, "a name has letters, digits, _ and - alone");
  return name;
}

Vector3 read_triple(ConfigReader& in, const std::string& key, double unit) {
  const auto numbers = in.numbers_or(key, {0.0, 0.0, 0.0});
  return unit * Vector3(numbers[0], numbers[1], numbers[2]);
}

Vector3 read_turn(ConfigReader& in, const std::string& key) {
  const auto degrees = in.numbers_or(key, {0.0, 0.0, 0.0}, kAnyTurn);
  return std::numbers::pi / 180.0 * Vector3(degrees[0], degrees[1], degrees[2]);
}

BodyMass read_body_mass(ConfigReader& in) {
  BodyMass body;
  if (in.has("mass_g")) {
    if (in.has("density_kg_m3")) in.fault("density_kg_m3", "give mass_g or density_kg_m3, not both");
    body.mass_kg = 1e-3 * in.number("mass_g", Range::positive());
  } else {
    body.density_kg_m3 = in.number("density_kg_m3", Range::positive());
  }
  return body;
}

}  // namespace tacipc
