#include "common/mesh/mass_properties.h"

#include <Eigen/Eigenvalues>

#include "common/base/error.h"

namespace tacipc {

MassProperties mass_properties(const Positions& positions, const Triangles& triangles) {
  // Far from the origin the tetrahedra are large and cancel; about the middle of the box they do not.
  Vector3 middle = Vector3::Zero();
  if (positions.rows() > 0)
    middle = 0.5 * (positions.colwise().minCoeff() + positions.colwise().maxCoeff()).transpose();
  double volume = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Matrix3 corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = positions.row(triangles(f, k)).transpose() - middle;
    const double d = corners.col(0).dot(corners.col(1).cross(corners.col(2)));
    const Vector3 s = corners.rowwise().sum();
    volume += d / 6.0;
    first += d / 24.0 * s;
    second += d / 120.0 * (corners * corners.transpose() + s * s.transpose());
  }
  if (!(volume > 0.0))
    throw DataError(
        "the surface encloses {:.3g} m³, expected a positive volume: it must be closed and its triangles "
        "counter-clockwise seen from outside",
        volume);
  const Vector3 center = first / volume;
  return {volume, middle + center, second / volume - center * center.transpose()};
}

Matrix3 inertia_tensor(double mass_kg, const Matrix3& second_moment_m2) {
  return mass_kg * (second_moment_m2.trace() * Matrix3::Identity() - second_moment_m2);
}

void require_solid(const Matrix3& second_moment_m2) {
  if (!second_moment_m2.allFinite()) throw DataError("the second moment of the body has entries that are no numbers");
  const double size = second_moment_m2.norm();
  if (!((second_moment_m2 - second_moment_m2.transpose()).norm() <= 1e-9 * size))
    throw DataError("the second moment of the body is not symmetric");
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(second_moment_m2).eigenvalues();
  // If a body is thinner than a millionth of its length, its second moment across is mere rounding.
  if (moments[0] > 1e-12 * size) return;
  const Vector3 inertia = moments.sum() - moments.array();
  throw DataError(
      "no body has the principal moments of inertia {:.6g}, {:.6g} and {:.6g} m² per unit of mass: each must be less "
      "than the sum of the two others",
      inertia[0], inertia[1], inertia[2]);
}

}  // namespace tacipc
