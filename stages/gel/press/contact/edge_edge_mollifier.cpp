#include "stages/gel/press/contact/edge_edge_mollifier.h"

#include <Eigen/Geometry>

namespace tacipc {

double edge_cross_squared_norm(const FourPoints& x) { return (x[1] - x[0]).cross(x[3] - x[2]).squaredNorm(); }

Vector12 edge_cross_squared_norm_gradient(const FourPoints& x) {
  const Vector3 u = x[1] - x[0];
  const Vector3 v = x[3] - x[2];
  const Vector3 n = u.cross(v);
  const Vector3 c_u = 2 * v.cross(n);
  const Vector3 c_v = 2 * n.cross(u);
  Vector12 gradient;
  gradient << -c_u, c_u, -c_v, c_v;
  return gradient;
}

Matrix12 edge_cross_squared_norm_hessian(const FourPoints& x) {
  const Vector3 u = x[1] - x[0];
  const Vector3 v = x[3] - x[2];
  const Matrix3 I = Matrix3::Identity();
  const Matrix3 uu = 2 * (v.squaredNorm() * I - v * v.transpose());
  const Matrix3 uv = 4 * u * v.transpose() - 2 * v * u.transpose() - 2 * u.dot(v) * I;
  const Matrix3 vv = 2 * (u.squaredNorm() * I - u * u.transpose());
  Matrix12 hessian;
  hessian << uu, -uu, uv, -uv,                   //
      -uu, uu, -uv, uv,                          //
      uv.transpose(), -uv.transpose(), vv, -vv,  //
      -uv.transpose(), uv.transpose(), -vv, vv;
  return hessian;
}

double edge_edge_mollifier_threshold(const FourPoints& x_rest) {
  return kMollifiedSine2 * (x_rest[1] - x_rest[0]).squaredNorm() * (x_rest[3] - x_rest[2]).squaredNorm();
}

double edge_edge_mollifier(double c, double epsilon) {
  if (c >= epsilon) return 1;
  const double ratio = c / epsilon;
  return ratio * (2 - ratio);
}

double edge_edge_mollifier_d1(double c, double epsilon) { return c < epsilon ? 2 * (1 - c / epsilon) / epsilon : 0; }

double edge_edge_mollifier_d2(double c, double epsilon) { return c < epsilon ? -2 / (epsilon * epsilon) : 0; }

EdgeEdgeMollifier edge_edge_mollifier(const FourPoints& x, double epsilon) {
  const double c = edge_cross_squared_norm(x);
  if (c >= epsilon) return {.value = 1, .gradient = Vector12::Zero(), .hessian = Matrix12::Zero()};
  const Vector12 g = edge_cross_squared_norm_gradient(x);
  const double m1 = edge_edge_mollifier_d1(c, epsilon);
  const double m2 = edge_edge_mollifier_d2(c, epsilon);
  return {.value = edge_edge_mollifier(c, epsilon),
          .gradient = m1 * g,
          .hessian = m2 * g * g.transpose() + m1 * edge_cross_squared_norm_hessian(x)};
}

}  // namespace tacipc
