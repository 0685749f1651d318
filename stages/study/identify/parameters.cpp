#include "stages/study/identify/parameters.h"

#include <cmath>

namespace tacipc {

double Unknown::u_of(double value) const { return prior.logarithmic ? std::log(value) : value; }
double Unknown::value_of(double u) const { return prior.logarithmic ? std::exp(u) : u; }
double Unknown::u_low() const { return u_of(prior.low); }
double Unknown::u_high() const { return u_of(prior.high); }

Unknowns::Unknowns(const IdentifySpec& spec) {
  for (const MechanicsParameter& p : spec.parameters) all_.push_back({.name = p.name, .prior = p.prior});
  for (const auto& [part, time] : spec.relaxation)
    for (const MechanicsParameter& p : {part, time}) all_.push_back({.name = p.name, .prior = p.prior});
  const auto normal = [](double mean, double sigma) {
    return Prior{.mean = mean, .sigma = sigma, .low = -HUGE_VAL, .high = HUGE_VAL};
  };
  for (const Measurement& m : spec.measurements) {
    const auto add = [&](const std::string& name, const Prior& prior) {
      all_.push_back({.name = name, .measurement = m.name, .prior = prior});
    };
    if (m.depth_zero_mm) add("depth_zero_mm", *m.depth_zero_mm);
    if (!m.markers) continue;
    add("depth_mm", m.markers->depth_mm);
    add("travel_mm", m.markers->travel_mm);
    add("contact_x_px", normal(m.markers->contact_px.x(), m.markers->contact_sigma_px));
    add("contact_y_px", normal(m.markers->contact_px.y(), m.markers->contact_sigma_px));
    for (const std::string field : {"press", "shear"}) {
      add(field + "_shift_x_px", normal(0.0, m.markers->shift_sigma_px));
      add(field + "_shift_y_px", normal(0.0, m.markers->shift_sigma_px));
      add(field + "_scale", normal(0.0, m.markers->scale_sigma));
    }
  }
}

std::optional<Eigen::Index> Unknowns::find(const std::string& name, const std::string& measurement) const {
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].name == name && all_[i].measurement == measurement) return static_cast<Eigen::Index>(i);
  return std::nullopt;
}

double Unknowns::value(const Eigen::VectorXd& u, const std::string& name, const std::string& measurement,
                       double held) const {
  const auto i = find(name, measurement);
  return i ? (*this)[*i].value_of(u[*i]) : held;
}

Eigen::VectorXd Unknowns::prior_mean() const {
  Eigen::VectorXd u(size());
  for (Eigen::Index i = 0; i < size(); ++i) u[i] = (*this)[i].u_mean();
  return u;
}

bool Unknowns::within_bounds(const Eigen::VectorXd& u) const {
  for (Eigen::Index i = 0; i < size(); ++i)
    if (!(u[i] >= (*this)[i].u_low() && u[i] <= (*this)[i].u_high())) return false;
  return true;
}

}  // namespace tacipc
