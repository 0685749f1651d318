#include "stages/gel/press/measure/contact_summary.h"

#include <algorithm>

#include "common/base/error.h"

namespace tacipc {

ContactSummary measure_contact(const FrontSurface& front, const Positions& front_positions, const Positions& normal_n,
                               const std::vector<ContactState>& states) {
  ContactSummary contact;
  const std::vector<double> areas = lumped_areas(front, front_positions);
  double force_n = 0.0;
  for (std::size_t v = 0; v < front.vertices.size(); ++v) {
    const double here_n = normal_n.row(static_cast<Eigen::Index>(v)).norm();
    if (!(here_n > 0.0)) continue;
    if (!(areas[v] > 0.0)) {
      throw SolverError("gel vertex {} carries {:.3g} N, but the front around it has no area", front.vertices[v],
                        here_n);
    }
    force_n += here_n;
    contact.area_m2 += areas[v];
    contact.peak_pressure_pa = std::max(contact.peak_pressure_pa, here_n / areas[v]);
  }
  if (contact.area_m2 > 0.0) contact.mean_pressure_pa = force_n / contact.area_m2;
  contact.sticking = static_cast<int>(std::count(states.begin(), states.end(), ContactState::stick));
  contact.slipping = static_cast<int>(std::count(states.begin(), states.end(), ContactState::slip));
  return contact;
}

}  // namespace tacipc
