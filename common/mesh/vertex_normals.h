// Smooth normals of a triangulated surface.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Returns unit vertex normals: triangle normals weighted by the angle at the vertex (Thürmer and Wüthrich 1998), so
/// that the triangulation of a flat region does not tilt them. Zero for a vertex without a triangle of positive area.
Positions vertex_normals(const Positions& positions, const Triangles& triangles);

}  // namespace tacipc
