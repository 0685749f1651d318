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

  /// `key: [low, high]`, both times `unit`.
  static Span read(ConfigReader& in, const std::string& key, const Range& range, double unit = 1.0);
};

/// The random numbers of one case: a function of seed, index and how many were drawn before.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t index) : seed_(seed), index_(index) {}
  double unit();                 // in (0, 1)
  double in(const Span& span);   // evenly
  double log(const Span& span);  // evenly in the logarithm; both ends > 0
  bool chance(double share) { return unit() < share; }
  int below(int count);  // 0 … count − 1

 private:
  std::uint64_t seed_, index_, counter_ = 0;
};

/// configs/studies/stress/stress.yaml
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
    double tilt_rad = 0.0;     // of the axis from the vertical, at most
    double place = 0.0;        // of the lowest point from the gel's centre, at most, in half widths
    double exact_share = 0.0;  // of cases that are exactly upright; exactly in the centre; without jitter
    int max_vertices = 0;
  } object;
  struct Motion {
    Span step_m, depth, shear_m, twist_rad, tilt_rad;
    double deep = 0.0, shallow = 0.0;  // deepest point in thicknesses, for contacts narrower than the gel is thick …
    Span twist_step_rad, tilt_step_rad;
  } motion;
  /// Instead of a motion: two such gels grip the object.
  struct Grasp {
    Span mass_kg, force_n, lift_m, shake_m, shake_hz;
    double off_center = 0.0;  // of the grip from the centre of mass, at most, in sizes of the object
    double release_share = 0.0;
  };
  std::optional<Grasp> grasp;
  struct Friction {
    double none_share = 0.0, iterated_share = 0.0;
    Span coefficient;
  } friction;
  PressConfig press;              // without friction
  double pairs_once_share = 0.0;  // of cases whose barrier counts pairs once, whatever `press` says

  static StressConfig read(ConfigReader& in);
};

/// The kinds of objects there are.
const std::vector<std::string>& stress_kinds();

}  // namespace tacipc::verify
