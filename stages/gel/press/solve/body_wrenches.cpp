#include "stages/gel/press/solve/body_wrenches.h"

namespace tacipc {

void add_body_wrenches(const ContactMesh& mesh, const ContactTerm& term, double weight, const Positions& x,
                       std::vector<Wrench>& between) {
  const int count = mesh.num_bodies();
  for (const int i : term.active(x)) {
    const std::span<const int> v = term.stencil(i);
    // The first side of a pair is its first vertex or its first two; the last vertex belongs to the second side.
    const int first = mesh.body_of(v[0]), second = mesh.body_of(v[3]);
    if (first == second) continue;
    const FourPoints points{x.row(v[0]), x.row(v[1]), x.row(v[2]), x.row(v[3])};
    Vector12 gradient;
    if (!term.evaluate_gradient(i, points, gradient)) continue;
    for (int k = 0; k < 4; ++k) {
      const bool of_first = mesh.body_of(v[static_cast<std::size_t>(k)]) == first;
      Wrench& on = between[static_cast<std::size_t>(of_first ? first * count + second : second * count + first)];
      const Vector3 force = -weight * gradient.segment<3>(3 * k);
      on.force_n += force;
      on.torque_n_m += points[static_cast<std::size_t>(k)].cross(force);
    }
  }
}

}  // namespace tacipc
