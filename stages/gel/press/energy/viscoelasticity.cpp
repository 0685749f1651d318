#include "stages/gel/press/energy/viscoelasticity.h"

#include <cmath>
#include <utility>

namespace tacipc {

double Viscoelasticity::Member::decay(double h_s) const { return std::exp(-h_s / time_s); }

double Viscoelasticity::Member::mean_decay(double h_s) const {
  const double part = h_s / time_s;
  return -std::expm1(-part) / part;
}

Viscoelasticity::Viscoelasticity(const std::vector<Relaxation>& series, TetStress stress) : stress_(std::move(stress)) {
  double lasting = 1.0;  // g∞
  for (const Relaxation& member : series) lasting -= member.part;
  for (const Relaxation& member : series) series_.push_back({member.part / lasting, member.time_s});
}

double Viscoelasticity::elastic_factor(double h_s) const {
  double factor = 1.0;
  for (const Member& member : series_) factor += member.ratio * member.mean_decay(h_s);
  return factor;
}

std::shared_ptr<const ViscousMemory> Viscoelasticity::memory(const History& history, const SymmetricRows& start_pa,
                                                             double h_s) const {
  SymmetricRows held = (1.0 - elastic_factor(h_s)) * start_pa;
  for (std::size_t i = 0; i < history.size(); ++i) held += series_[i].decay(h_s) * history[i];
  return std::make_shared<ViscousMemory>(stress_.body(), std::move(held));
}

void Viscoelasticity::advance(History& history, const SymmetricRows& change_pa, double h_s) const {
  history.resize(series_.size(), SymmetricRows::Zero(change_pa.rows(), 6));
  for (std::size_t i = 0; i < series_.size(); ++i) {
    const Member& member = series_[i];
    history[i] = member.decay(h_s) * history[i] + member.ratio * member.mean_decay(h_s) * change_pa;
  }
}

}  // namespace tacipc
