#include "stages/study/identify/force_model.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

/// Root of an ascending function in [0, high], to the last bits.
/// \pre `f(0) <= 0 <= f(high)`
template <typename F>
double root_of(double high, F&& f) {
  double low = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double yielding_force_n(const Curve& force_per_pa, double modulus_pa, double compliance_mm_per_n, double way_mm) {
  if (!(way_mm > 0.0)) return 0.0;
  const auto force = [&](double mm) { return modulus_pa * force_per_pa.at(mm); };
  if (compliance_mm_per_n <= 0.0) return force(way_mm);
  return force(root_of(way_mm, [&](double mm) { return mm + compliance_mm_per_n * force(mm) - way_mm; }));
}

}  // namespace

double pressed_force_n(const Curve& force_per_pa, const Mounting& mounting, double depth_mm) {
  return yielding_force_n(force_per_pa, mounting.modulus_pa, mounting.compliance_mm_per_n, depth_mm);
}

double sheared_force_n(const Curve& force_per_pa, const Mounting& mounting, double travel_mm) {
  return yielding_force_n(force_per_pa, mounting.modulus_pa, mounting.shear_compliance_mm_per_n, travel_mm);
}

std::vector<double> relaxing_force_n(const Curve& force_per_pa, const Mounting& mounting,
                                     const std::vector<Relaxation>& relaxation, double depth_mm, double ramp_s,
                                     const std::vector<double>& times_s) {
  double long_term = 1.0;
  for (const Relaxation& term : relaxation) long_term -= term.part;
  std::vector<double> memory(relaxation.size(), 0.0), out;
  double t = 0.0, elastic = 0.0;
  const auto advance = [&](double to) {
    const double dt = to - t;
    double kept = 0.0, stiffness = 1.0;  // F(to) = kept + stiffness · E f(δ); kept depends on the previous step
    std::vector<double> decay(memory.size()), gain(memory.size());
    for (std::size_t i = 0; i < memory.size(); ++i) {
      const double x = dt / relaxation[i].time_s;
      decay[i] = std::exp(-x);
      gain[i] = relaxation[i].part / long_term * -std::expm1(-x) / x;
      kept += decay[i] * memory[i] - gain[i] * elastic;
      stiffness += gain[i];
    }
    const double way = std::max(0.0, depth_mm) * std::min(to / ramp_s, 1.0);
    const auto total = [&](double mm) { return kept + stiffness * mounting.modulus_pa * force_per_pa.at(mm); };
    const double depth =
        mounting.compliance_mm_per_n > 0.0
            ? root_of(way, [&](double mm) { return mm + mounting.compliance_mm_per_n * total(mm) - way; })
            : way;
    const double now = mounting.modulus_pa * force_per_pa.at(depth);
    for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = decay[i] * memory[i] + gain[i] * (now - elastic);
    elastic = now;
    t = to;
  };
  for (const double time : times_s) {
    while (t < time) {
      double step = std::max(ramp_s / 40.0, t / 20.0);
      if (t < ramp_s) step = std::min(step, ramp_s - t);
      advance(t + step >= time * (1.0 - 1e-12) ? time : t + step);
    }
    double force = elastic;
    for (const double m : memory) force += m;
    out.push_back(force);
  }
  return out;
}

}  // namespace tacipc
