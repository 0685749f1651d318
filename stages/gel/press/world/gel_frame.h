// The frame of one gel out of several that are solved as one body.
#pragma once

#include <optional>
#include <vector>

#include "stages/gel/press/energy/tet_energy.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// Parts of one gel that stay constant.
struct SolvedGel {
  const TetMesh& gel;  // undeformed, in its own frame S
  const FrontSurface& front;
  const std::vector<RestTet>& rest_tets;
  Eigen::Index first_row = 0;  // of the whole's positions and forces
};

/// Σ contact forces on it, normal and friction, in the world; zero where there is no force yet.
Vector3 contact_force_on(const SolvedGel& part, const StepForces& forces);

/// Positions of the gel's vertices in its own frame, of `x` in the world. \param world_from_gel absent: its frame is
/// the world
Positions positions_in_gel(const SolvedGel& part, const std::optional<Matrix4>& world_from_gel, const Positions& x);

/// Forces, their balance and volumes, in its own frame. Object, time and solver are left out.
/// \param world_from_gel absent: its frame is the world \param positions_m of its vertices in its own frame
Frame gel_frame(const SolvedGel& part, const std::optional<Matrix4>& world_from_gel, Positions positions_m,
                const StepForces& forces);

/// Adds an object's pose and motion, given in the world, as the gel sees them: velocities in the world, along its axes.
void add_object(Frame& frame, const std::optional<Matrix4>& world_from_gel, const Matrix4& world_from_object,
                const Vector3& velocity_m_s, const Vector3& spin_rad_s);

}  // namespace tacipc
