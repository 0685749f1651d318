// Friction and reach of contact of each pair of bodies, where these differ from pair to pair.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "stages/gel/press/world/setup.h"

namespace tacipc {

/// Contact of two bodies that differs from the press file.
struct ContactSpec {
  std::array<int, 2> between{};  // numbers of bodies
  std::optional<double> friction = std::nullopt, d_hat_m = std::nullopt;
};

/// Contact of a world whose pairs of bodies differ.
struct PairContact {
  double gel_friction = 0.0;  // coefficient of gels with all bodies they touch
  std::vector<ContactSpec> pairs = {};
  double load_n = 0.0;  // the largest load on a body, besides its weight
};

/// Resolves the laws of all pairs of bodies, in metres and coefficients, and how friction is solved, into `settings`.
/// Pairs of bodies of which none deforms get a barrier stiff enough for the weight and load of all free bodies.
/// \param names of the bodies: gels, then other deformable ones, then objects \param weight_n of all free bodies
/// \throw UsageError if a pair reaches farther than the gels do, or has friction and the press file has no such section
void set_pair_laws(const PairContact& contact, const PressConfig& config, const Scales& scales,
                   const std::vector<std::string>& names, int num_gels, int num_deformable, double weight_n,
                   StepSettings& settings);

}  // namespace tacipc
