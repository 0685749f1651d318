#include "stages/gel/press/contact/contact_laws.h"

#include <algorithm>
#include <cmath>

namespace tacipc {

ContactLaws ContactLaws::resolved(const ContactLaw& usual, int num_bodies, const std::vector<LawOverride>& overrides) {
  ContactLaws out(usual);
  if (overrides.empty()) return out;
  out.num_bodies_ = num_bodies;
  out.laws_.assign(static_cast<std::size_t>(num_bodies) * static_cast<std::size_t>(num_bodies), usual);
  std::vector<double> force(out.laws_.size(), 1.0);
  for (const LawOverride& own : overrides) {
    const auto [a, b] = own.between;
    for (const std::size_t at : {out.index(a, b), out.index(b, a)}) {
      out.laws_[at].friction = own.friction.value_or(out.laws_[at].friction);
      out.laws_[at].d_hat_m = own.d_hat_m.value_or(out.laws_[at].d_hat_m);
      force[at] = own.force.value_or(force[at]);
    }
  }
  out.reach_m_ = out.largest_friction_ = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    ContactLaw& law = out.laws_[i];
    law.stiffness = usual.stiffness * force[i] / std::pow(law.d_hat_m / usual.d_hat_m, 3);
    out.reach_m_ = std::max(out.reach_m_, law.d_hat_m);
    out.largest_friction_ = std::max(out.largest_friction_, law.friction);
  }
  return out;
}

}  // namespace tacipc
