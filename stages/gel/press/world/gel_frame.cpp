#include "stages/gel/press/world/gel_frame.h"

#include "stages/gel/press/contact/intersection_check.h"
#include "stages/gel/press/energy/elasticity.h"

namespace tacipc {
namespace {

Positions rotated(const Positions& rows, const Matrix3& rotation) { return rows * rotation.transpose(); }

Matrix3 axes_to_gel(const Matrix4& world_from_gel) { return world_from_gel.topLeftCorner<3, 3>().transpose(); }

}  // namespace

Vector3 contact_force_on(const SolvedGel& part, const StepForces& forces) {
  const Eigen::Index n = part.gel.num_vertices(), first = part.first_row;
  if (forces.normal.rows() == 0) return Vector3::Zero();
  return (forces.normal.middleRows(first, n) + forces.friction.middleRows(first, n)).colwise().sum();
}

Positions positions_in_gel(const SolvedGel& part, const std::optional<Matrix4>& world_from_gel, const Positions& x) {
  const auto own = x.middleRows(part.first_row, part.gel.num_vertices());
  if (!world_from_gel) return own;
  const Vector3 origin = world_from_gel->topRightCorner<3, 1>();
  return rotated(own.rowwise() - origin.transpose(), axes_to_gel(*world_from_gel));
}

Frame gel_frame(const SolvedGel& part, const std::optional<Matrix4>& world_from_gel, Positions positions_m,
                const StepForces& forces) {
  const Eigen::Index n = part.gel.num_vertices();
  const auto own = [&](const Positions& rows) -> Positions {
    if (!world_from_gel) return rows.middleRows(part.first_row, n);
    return rotated(rows.middleRows(part.first_row, n), axes_to_gel(*world_from_gel));
  };
  Frame frame;
  frame.positions = std::move(positions_m);
  const Positions normal = own(forces.normal), friction = own(forces.friction), contact = normal + friction;
  frame.normal_force_n = on_front(part.front, normal);
  frame.friction_force_n = on_front(part.front, friction);
  for (const int v : part.front.vertices)
    frame.contact_state.push_back(forces.contact_state[static_cast<std::size_t>(part.first_row + v)]);
  for (Eigen::Index v = 0; v < n; ++v) {
    const Vector3 force = contact.row(v), arm = frame.positions.row(v);
    frame.force_n += force;
    frame.torque_n_m += arm.cross(force);
  }
  frame.balance =
      balance_of(frame.positions, {.contact = contact, .inertia = own(forces.body), .mount = own(forces.mount)});
  frame.stand_off_m = forces.stand_off_m;
  frame.min_volume_ratio = min_volume_ratio(frame.positions, part.gel.tets, part.rest_tets);
  frame.inverted_tets = static_cast<int>(count_inverted_tets(frame.positions, part.gel.tets));
  return frame;
}

void add_object(Frame& frame, const std::optional<Matrix4>& world_from_gel, const Matrix4& world_from_object,
                const Vector3& velocity_m_s, const Vector3& spin_rad_s) {
  if (!world_from_gel) {
    frame.gel_from_object = world_from_object;
    frame.object_velocity_m_s = velocity_m_s;
    frame.object_spin_rad_s = spin_rad_s;
    return;
  }
  const Matrix3 to_gel = axes_to_gel(*world_from_gel);
  frame.gel_from_object = world_from_gel->inverse() * world_from_object;
  frame.object_velocity_m_s = to_gel * velocity_m_s;
  frame.object_spin_rad_s = to_gel * spin_rad_s;
}

}  // namespace tacipc
