// Frame of one gel out of several that are solved together.
#pragma once

#include <optional>
#include <vector>

#include "stages/gel/press/energy/tet_energy.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// Constant data of one gel.
struct SolvedGel {
  const TetMesh& gel;  // undeformed, in its own frame S
  const FrontSurface& front;
  const std::vector<RestTet>& rest_tets;
  Eigen::Index first_row = 0;  // first of its rows in the positions and forces of the whole
};

/// Σ contact forces on the gel, normal and friction, in the world; zero before the first step.
Vector3 contact_force_on(const SolvedGel& part, const StepForces& forces);

/// Positions of the gel's vertices in its own frame.
/// \param x positions in the world
/// \param world_from_gel absent: its frame is the world
Positions positions_in_gel(const SolvedGel& part, const std::optional<Matrix4>& world_from_gel, const Positions& x);

/// Frame with forces, their balance and volumes, in the gel's own frame; object, time and solver are not set.
/// \param world_from_gel absent: its frame is the world
/// \param positions_m vertices in the gel's own frame
Frame gel_frame(const SolvedGel& part, const std::optional<Matrix4>& world_from_gel, Positions positions_m,
                const StepForces& forces);

/// Adds pose and motion of an object, given in the world, to the frame. Velocities are relative to the world, along the
/// gel's axes.
void add_object(Frame& frame, const std::optional<Matrix4>& world_from_gel, const Matrix4& world_from_object,
                const Vector3& velocity_m_s, const Vector3& spin_rad_s);

}  // namespace tacipc
