// Intersection of a ray with the membrane, in double precision.
#pragma once

#include "common/optics/membrane.h"

namespace tacipc {

/// A ray.
struct Ray {
  Vector3 origin;
  Vector3 direction;  // unit
};

/// An intersection point and its surroundings.
struct SurfaceHit {
  Vector3 point;  // m
  int triangle;
  Vector3 weights;        // barycentric coordinates in the triangle
  Vector3 inner_normal;   // unit, interpolated from vertex normals, towards the inside of the gel
  Vector3 shadow_origin;  // origin of rays to the lights
  double indentation;     // m, rest z minus deformed z of the material point
  bool from_inside;  // the ray comes out of the gel; false: it met the outer side of a fold, which no light reaches
};

/// Returns the point of `triangle` that `ray` meets. Rays to the lights start at the smooth surface that the vertex
/// normals describe instead of the flat triangle (Hanika, Hacking the Shadow Terminator, 2021). Each vertex's tangent
/// plane lifts the point by its distance below that plane, weighted by the barycentric coordinates. Without this, a
/// curved surface at grazing light darkens triangle by triangle. A further offset of 1e-7 m along the triangle's normal
/// keeps the rays off their own triangle.
SurfaceHit surface_hit(const Membrane& membrane, int triangle, const Ray& ray);

/// Returns whether the ray must meet the membrane: its line passes through the closed boundary (the boundary's winding
/// number about the line is not zero), not within 1e-8 m of it. The loop cannot be spanned otherwise.
bool inside_outline(const Membrane& membrane, const Ray& ray);

}  // namespace tacipc
