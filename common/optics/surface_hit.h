// The place where a ray meets the membrane, in double precision.
#pragma once

#include "common/optics/membrane.h"

namespace tacipc {

struct Ray {
  Vector3 origin;
  Vector3 direction;  // unit
};

struct SurfaceHit {
  Vector3 point;  // m
  int triangle;
  Vector3 weights;        // barycentric coordinates in the triangle
  Vector3 inner_normal;   // unit, interpolated vertex normals, towards the inside of the gel
  Vector3 shadow_origin;  // where rays to the lights start
  double indentation;     // m, rest z minus deformed z of the material there
  bool from_inside;       // the ray comes out of the gel; else it met the outer side of a fold, which no light reaches
};

/// The point of `triangle` that `ray` meets. Rays to the lights start at the smooth surface that the vertex normals
/// describe rather than at the flat triangle (Hanika, Hacking the Shadow Terminator, 2021): each vertex's tangent plane
/// lifts the point by what it lies below that plane, weighted by the barycentric coordinates. Without this a curved
/// surface darkens triangle by triangle where light grazes it. Another 1e-7 m along the triangle's normal keeps the
/// rays off the triangle they start from.
SurfaceHit surface_hit(const Membrane& membrane, int triangle, const Ray& ray);

/// True if the line of the ray passes through the closed boundary of the membrane (its winding number about the line is
/// not zero) and not within 1e-8 m of it: then the ray must meet the membrane, for the loop cannot be spanned
/// otherwise.
bool inside_outline(const Membrane& membrane, const Ray& ray);

}  // namespace tacipc
