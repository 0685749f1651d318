// Volume, centre of mass and second moment of a solid of uniform density, from its surface.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Volume, centre of mass and second moment of the solid inside a closed surface with outward triangles.
struct MassProperties {
  double volume_m3 = 0.0;
  Vector3 center_m = Vector3::Zero();
  Matrix3 second_moment_m2 = Matrix3::Zero();  // S = (1/V) ∫ (x − c)(x − c)ᵀ dV
};

/// Computes V = Σ d/6, ∫x = Σ d s/24, ∫xxᵀ = Σ d/120 (aaᵀ + bbᵀ + ccᵀ + ssᵀ) over the triangles (a, b, c), with d = a ·
/// (b × c) and s = a + b + c: each triangle counts as the tetrahedron that it spans with the origin, negative if it
/// faces inwards. Exact for the mesh. For an open surface the result depends on the origin and is meaningless.
/// \throw DataError if the volume is not positive
MassProperties mass_properties(const Positions& positions, const Triangles& triangles);

/// Returns the inertia tensor about the centre, m (tr(S) I − S), in kg m².
Matrix3 inertia_tensor(double mass_kg, const Matrix3& second_moment_m2);

/// Checks that a solid with this second moment exists: finite, symmetric, and each principal moment of inertia less
/// than the sum of the two others, I₁ + I₂ − I₃ = 2 m S₃ > 0. Equality is a body without thickness.
/// \throw DataError otherwise
void require_solid(const Matrix3& second_moment_m2);

}  // namespace tacipc
