// Friction and range of contact of each pair of bodies, if these differ from pair to pair.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "stages/gel/press/world/setup.h"

namespace tacipc {

/// Contact of two bodies that differs from the press file.
struct ContactSpec {
  std::array<int, 2> between{};  // indices of the bodies
  std::optional<double> friction = std::nullopt, d_hat_m = std::nullopt;
};

/// Contact of a world whose pairs of bodies differ.
struct PairContact {
  double gel_friction = 0.0;  // coefficient between gels and all bodies that they touch
  std::vector<ContactSpec> pairs = {};
  double load_n = 0.0;  // largest load on a body in addition to its weight
};

/// Resolves the laws of all pairs of bodies, in metres and coefficients, and the friction settings, into `settings`.
/// Pairs of bodies that do not deform get a barrier stiff enough for the weight and load of all free bodies.
/// \param names names of the bodies: gels, then other deformable bodies, then objects
/// \param weight_n weight of all free bodies
/// \throw UsageError if the contact of a pair has a longer range than that of the gels, or has friction although the
/// press file has no such section
void set_pair_laws(const PairContact& contact, const PressConfig& config, const Scales& scales,
                   const std::vector<std::string>& names, int num_gels, int num_deformable, double weight_n,
                   StepSettings& settings);

}  // namespace tacipc
