// Ranges from which the stress campaign draws its cases, and the random numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "stages/gel/press/world/press_config.h"

namespace tacipc::verify {

/// A range to draw from.
struct Span {
  double low = 0.0, high = 0.0;

  /// Reads `key: [low, high]`; both values are multiplied by `unit`.
  static Span read(ConfigReader& in, const std::string& key, const Range& range, double unit = 1.0);
};

/// Random numbers of one case. Each number is a function of the seed, the index and the count of earlier draws.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t index) : seed_(seed), index_(index) {}
  double unit();                 // uniform in (0, 1)
  double in(const Span& span);   // uniform in a span
  double log(const Span& span);  // uniform in the logarithm; both ends > 0
  bool chance(double share) { return unit() < share; }
  int below(int count);  // 0 … count − 1

 private:
  std::uint64_t seed_, index_, counter_ = 0;
};

/// Content of configs/studies/stress/stress.yaml.
struct StressConfig {
  struct Gel {
    double disc_share = 0.0;
    Span thickness_m, width_thicknesses, vertices, growth, jitter;
  } gel;
  struct Body {
    double stvk_hencky_share = 0.0;
    double density_kg_m3 = 0.0;
    Span youngs_modulus_pa, poissons_ratio;
  } material;
  struct Object {
    std::vector<std::string> kinds;
    Span size_m, half_angle_rad, edges_over_gel;
    double tilt_rad = 0.0;  // largest tilt of the axis from the vertical, rad
    double place = 0.0;     // largest distance of the lowest point from the gel's centre, in half widths
    double exact_share =
        0.0;  // fraction of cases that are exactly upright; also of those exactly central, and of those without jitter
    int max_vertices = 0;
  } object;
  struct Motion {
    Span step_m, depth, shear_m, twist_rad, tilt_rad;
    double deep = 0.0,
           shallow =
               0.0;  // deepest point, in thicknesses, for contacts narrower than the gel is thick and for wider ones
    Span twist_step_rad, tilt_step_rad;
  } motion;
  /// Grasp instead of a motion: two such gels grip the object.
  struct Grasp {
    Span mass_kg, force_n, lift_m, shake_m, shake_hz;
    double off_center = 0.0;  // largest distance of the grip from the centre of mass, in object sizes
    double release_share = 0.0;
  };
  std::optional<Grasp> grasp;
  struct Friction {
    double none_share = 0.0, iterated_share = 0.0;
    Span coefficient;
  } friction;
  PressConfig press;              // press settings, without friction
  double pairs_once_share = 0.0;  // fraction of cases whose barrier counts each pair once, regardless of `press`

  static StressConfig read(ConfigReader& in);
};

/// All kinds of objects.
const std::vector<std::string>& stress_kinds();

}  // namespace tacipc::verify
