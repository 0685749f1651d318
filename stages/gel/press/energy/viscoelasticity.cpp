#include "stages/gel/press/energy/viscoelasticity.h"

#include <cmath>
#include <utility>

namespace tacipc {

double Viscoelasticity::Member::decay(double h_s) const { return std::exp(-h_s / time_s); }

double Viscoelasticity::Member::mean_decay(double h_s) const {
  const double part = h_s / time_s;
  return -std::expm1(-part) / part;
}

double Viscoelasticity::Relaxing::elastic_factor(double h_s) const {
  double factor = 1.0;
  for (const Member& member : series) factor += member.ratio * member.mean_decay(h_s);
  return factor;
}

Viscoelasticity::Viscoelasticity(const std::vector<Body>& bodies) : num_bodies_(bodies.size()) {
  Eigen::Index count = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b];
    if (body.series.empty()) continue;
    double lasting = 1.0;  // long-term fraction g∞
    for (const Relaxation& member : body.series) lasting -= member.part;
    Relaxing& relaxing = relaxing_.emplace_back(Relaxing{b, {}, *body.stress, count, body.stress->body()->tets.rows()});
    for (const Relaxation& member : body.series) relaxing.series.push_back({member.part / lasting, member.time_s});
    count += relaxing.num_rows;
  }
  if (relaxing_.size() == 1) {
    body_ = relaxing_.front().stress.body();
    return;
  }
  RestBody all{Tetrahedra(count, 4), {}};
  for (const Relaxing& part : relaxing_) {
    const RestBody& body = *part.stress.body();
    all.tets.middleRows(part.first_row, part.num_rows) = body.tets;
    all.rest.insert(all.rest.end(), body.rest.begin(), body.rest.end());
  }
  body_ = std::make_shared<const RestBody>(std::move(all));
}

SymmetricRows Viscoelasticity::stress(const Positions& x) const {
  if (relaxing_.size() == 1) return relaxing_.front().stress(x);
  SymmetricRows out(body_->tets.rows(), 6);
  for (const Relaxing& part : relaxing_) out.middleRows(part.first_row, part.num_rows) = part.stress(x);
  return out;
}

std::vector<double> Viscoelasticity::elastic_factors(double h_s) const {
  std::vector<double> factors(num_bodies_, 1.0);
  for (const Relaxing& part : relaxing_) factors[part.body] = part.elastic_factor(h_s);
  return factors;
}

std::shared_ptr<const ViscousMemory> Viscoelasticity::memory(const History& history, const SymmetricRows& start_pa,
                                                             double h_s) const {
  SymmetricRows held(start_pa.rows(), 6);
  auto member_history = history.begin();
  for (const Relaxing& part : relaxing_) {
    auto own = held.middleRows(part.first_row, part.num_rows);
    own = (1.0 - part.elastic_factor(h_s)) * start_pa.middleRows(part.first_row, part.num_rows);
    if (history.empty()) continue;
    for (const Member& member : part.series) own += member.decay(h_s) * *member_history++;
  }
  return std::make_shared<ViscousMemory>(body_, std::move(held));
}

SymmetricRows Viscoelasticity::remembered(const History& history, std::size_t body) const {
  SymmetricRows sum(0, 6);
  if (history.empty()) return sum;
  auto member_history = history.begin();
  for (const Relaxing& part : relaxing_) {
    if (part.body == body) sum.setZero(part.num_rows, 6);
    for (std::size_t i = 0; i < part.series.size(); ++i, ++member_history)
      if (part.body == body) sum += *member_history;
  }
  return sum;
}

void Viscoelasticity::advance(History& history, const SymmetricRows& change_pa, double h_s) const {
  const bool first = history.empty();
  std::size_t i = 0;
  for (const Relaxing& part : relaxing_) {
    for (const Member& member : part.series) {
      if (first) history.push_back(SymmetricRows::Zero(part.num_rows, 6));
      history[i] = member.decay(h_s) * history[i] +
                   member.ratio * member.mean_decay(h_s) * change_pa.middleRows(part.first_row, part.num_rows);
      ++i;
    }
  }
}

}  // namespace tacipc
