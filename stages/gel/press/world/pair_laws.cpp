#include "stages/gel/press/world/pair_laws.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"

namespace tacipc {
namespace {

// A pair of hard bodies pushes with this times κ d̂³/h² at half of d̂ (bound by the shape of the barrier, barrier.h); it
// should bear the weight of a body on a few corners there.
constexpr double kForceAtHalf = 4.3, kCorners = 4.0;

}  // namespace

void set_pair_laws(const PairContact& contact, const PressConfig& config, const Scales& scales,
                   const std::vector<std::string>& names, std::size_t num_gels, std::size_t num_deformable,
                   double weight_n, ContactMesh& mesh, StepSettings& settings) {
  const auto count = names.size();
  std::vector<double> friction(count * count, config.coefficient_of_friction()), d_hat(count * count, scales.d_hat_m);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      if (std::min(a, b) < num_gels) friction[a * count + b] = contact.gel_friction;
    }
  }
  for (const ContactSpec& pair : contact.pairs) {
    const auto a = static_cast<std::size_t>(pair.between[0]), b = static_cast<std::size_t>(pair.between[1]);
    for (const std::size_t at : {a * count + b, b * count + a}) {
      if (pair.friction) friction[at] = *pair.friction;
      if (pair.d_hat_m) d_hat[at] = *pair.d_hat_m;
    }
    if (pair.d_hat_m && *pair.d_hat_m > scales.d_hat_m)
      throw UsageError(fmt::format("contact of {} and {}: d_hat_mm is more than that of the gels, {:.4g} mm", names[a],
                                   names[b], 1e3 * scales.d_hat_m));
  }
  const double most = *std::max_element(friction.begin(), friction.end());
  if (most > 0.0 && !config.friction)
    throw UsageError("the press file has no section friction, which says how friction between bodies is solved");
  if (most > 0.0) {
    // The press file's own coefficient may be zero.
    PressConfig with = config;
    with.friction->coefficient = most;
    settings.friction = step_settings(with, scales).friction;
  }
  const double own_n = settings.barrier_stiffness_j_m4 * std::pow(scales.d_hat_m, 3);
  mesh.laws.resize(count * count);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      PairLaw& law = mesh.laws[a * count + b];
      law.friction = most > 0.0 ? friction[a * count + b] / most : 1.0;
      law.d_hat = d_hat[a * count + b] / scales.d_hat_m;
      const bool hard = a >= num_deformable && b >= num_deformable;
      const double wanted_n = hard ? std::max(own_n, (weight_n + contact.load_n) / (kCorners * kForceAtHalf)) : own_n;
      law.stiffness = wanted_n / own_n / std::pow(law.d_hat, 3);
    }
  }
}

}  // namespace tacipc
