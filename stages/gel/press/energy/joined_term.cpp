#include "stages/gel/press/energy/joined_term.h"

#include <utility>

namespace tacipc {

JoinedTerm::JoinedTerm(std::vector<std::shared_ptr<const EnergyTerm>> parts) : parts_(std::move(parts)), first_{0} {
  for (const auto& part : parts_) first_.push_back(first_.back() + part->num_stencils());
}

JoinedTerm::Place JoinedTerm::find(int i) const {
  std::size_t part = 0;
  while (i >= first_[part + 1]) ++part;
  return {part, i - first_[part]};
}

double JoinedTerm::value(const Positions& x) const {
  double sum = 0.0;
  for (const auto& part : parts_) sum += part->value(x);
  return sum;
}

std::vector<std::shared_ptr<const EnergyTerm>> parts_of(const std::shared_ptr<const EnergyTerm>& term) {
  if (!term) return {};
  if (const auto* joined = dynamic_cast<const JoinedTerm*>(term.get())) return joined->parts();
  return {term};
}

}  // namespace tacipc
