#include "stages/gel/press/world/pair_laws.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"

namespace tacipc {
namespace {

// The force of a pair of rigid bodies is this times κ d̂³/h² at a gap of half of d̂ (from the shape of the barrier,
// barrier.h); it should support the weight of a body on a few corners.
constexpr double kForceAtHalf = 4.3, kCorners = 4.0;

}  // namespace

void set_pair_laws(const PairContact& contact, const PressConfig& config, const Scales& scales,
                   const std::vector<std::string>& names, int num_gels, int num_deformable, double weight_n,
                   StepSettings& settings) {
  const int count = static_cast<int>(names.size());
  std::vector<LawOverride> overrides;
  for (int gel = 0; gel < num_gels; ++gel) {
    for (int b = 0; b < count; ++b) overrides.push_back({.between = {gel, b}, .friction = contact.gel_friction});
  }
  for (const ContactSpec& pair : contact.pairs) {
    if (pair.d_hat_m && *pair.d_hat_m > scales.d_hat_m)
      throw UsageError(fmt::format("contact of {} and {}: d_hat_mm is more than that of the gels, {:.4g} mm",
                                   names[static_cast<std::size_t>(pair.between[0])],
                                   names[static_cast<std::size_t>(pair.between[1])], 1e3 * scales.d_hat_m));
    overrides.push_back({.between = pair.between, .friction = pair.friction, .d_hat_m = pair.d_hat_m});
  }
  const double own_n = settings.barrier_stiffness_j_m4 * std::pow(scales.d_hat_m, 3);
  const double hard_force = std::max(own_n, (weight_n + contact.load_n) / (kCorners * kForceAtHalf)) / own_n;
  for (int a = num_deformable; a < count; ++a) {
    for (int b = a; b < count; ++b) overrides.push_back({.between = {a, b}, .force = hard_force});
  }
  settings.laws = ContactLaws::resolved({config.coefficient_of_friction(), scales.d_hat_m}, count, overrides);
  const bool has_friction = settings.laws.largest_friction() > 0.0;
  if (has_friction && !config.friction)
    throw UsageError("the press file has no section friction, which says how friction between bodies is solved");
  settings.friction.reset();
  if (has_friction) settings.friction = friction_settings(*config.friction, scales);
}

}  // namespace tacipc
