#include "common/sensor/camera_model.h"

#include <Eigen/Geometry>
#include <cmath>

namespace tacipc {
namespace {

/// Returns θ_d = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶).
double distorted_angle(double angle, const std::array<double, 3>& k) {
  const double t = angle * angle;
  return angle * (1.0 + t * (k[0] + t * (k[1] + t * k[2])));
}

std::optional<double> undistorted_angle(double distorted, const std::array<double, 3>& k) {
  double angle = distorted;
  for (int step = 0; step < 50; ++step) {
    const double t = angle * angle;
    const double slope = 1.0 + t * (3.0 * k[0] + t * (5.0 * k[1] + t * 7.0 * k[2]));
    if (!(slope > 1e-3)) return std::nullopt;
    const double change = (distorted - distorted_angle(angle, k)) / slope;
    angle += change;
    if (std::abs(change) <= 1e-14 * (1.0 + angle)) return angle;
  }
  return std::nullopt;
}

Matrix3 rotation_of(const Vector3& angles) {
  return (Eigen::AngleAxisd(angles.z(), Vector3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vector3::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Vector3::UnitX()))
      .toRotationMatrix();
}

}  // namespace

double vignetting(const Camera& camera, int x, int y) {
  const double half_width = 0.5 * camera.width_px, half_height = 0.5 * camera.height_px;
  const double dx = x + 0.5 - half_width, dy = y + 0.5 - half_height;
  const double rr = (dx * dx + dy * dy) / (half_width * half_width + half_height * half_height);
  return 1.0 + rr * (camera.vignetting[0] + rr * camera.vignetting[1]);
}

Eigen::Vector2d distort(const Eigen::Vector2d& point, const std::array<double, 3>& radial,
                        const std::array<double, 2>& tangential) {
  const double x = point.x(), y = point.y(), rr = point.squaredNorm();
  const double scale = 1.0 + rr * (radial[0] + rr * (radial[1] + rr * radial[2]));
  return {x * scale + 2.0 * tangential[0] * x * y + tangential[1] * (rr + 2.0 * x * x),
          y * scale + tangential[0] * (rr + 2.0 * y * y) + 2.0 * tangential[1] * x * y};
}

std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& point, const std::array<double, 3>& radial,
                                         const std::array<double, 2>& tangential) {
  Eigen::Vector2d guess = point;
  for (int step = 0; step < 50; ++step) {
    const double x = guess.x(), y = guess.y(), rr = guess.squaredNorm();
    const double scale = 1.0 + rr * (radial[0] + rr * (radial[1] + rr * radial[2]));
    const double slope = 2.0 * (radial[0] + rr * (2.0 * radial[1] + rr * 3.0 * radial[2]));  // d(scale) / d(r²)
    Eigen::Matrix2d jacobian;
    jacobian << scale + slope * x * x + 2.0 * tangential[0] * y + 6.0 * tangential[1] * x,
        slope * x * y + 2.0 * tangential[0] * x + 2.0 * tangential[1] * y,
        slope * x * y + 2.0 * tangential[0] * x + 2.0 * tangential[1] * y,
        scale + slope * y * y + 6.0 * tangential[0] * y + 2.0 * tangential[1] * x;
    if (!(jacobian.determinant() > 1e-3)) return std::nullopt;  // the mapping folds over
    const Eigen::Vector2d change = jacobian.inverse() * (point - distort(guess, radial, tangential));
    guess += change;
    if (change.norm() <= 1e-14 * (1.0 + guess.norm())) return guess;
  }
  return std::nullopt;
}

CameraModel::CameraModel(const Camera& camera, const OpticalStack& stack, bool refract)
    : camera_(camera),
      refract_(refract && stack.refracts()),
      gel_thickness_m_(stack.gel_thickness_m),
      back_z_m_(-stack.gel_thickness_m),
      s_from_camera_(rotation_of(camera.rotation_rad)) {
  if (refract_) stack_ = stack.from(camera.position_m.z());
  if (camera.model == Camera::Model::rectified) return;
  if (camera.intrinsics_px) {
    intrinsics_ = *camera.intrinsics_px;
    return;
  }
  // The focal length at which the left and right edges show ± half the field of view in the plane z = 0; the pixel
  // aspect ratio follows from the field of view.
  const Vector3 edge = towards({camera.position_m.x() + 0.5 * camera.window_width_m, camera.position_m.y(), 0.0});
  const double tangent = edge.x() / edge.z();
  const double reach = camera.model == Camera::Model::fisheye ? distorted_angle(std::atan(tangent), camera.radial)
                                                              : distort({tangent, 0.0}, camera.radial, {}).x();
  const double fx = 0.5 * camera.width_px / reach;
  const double aspect = (camera.window_width_m * camera.height_px) / (camera.window_height_m * camera.width_px);
  intrinsics_ = {fx, fx * aspect, 0.5 * camera.width_px, 0.5 * camera.height_px};
}

/// Returns the direction at the camera of light from a point, by the layered path or straight.
Vector3 CameraModel::towards(const Vector3& point) const {
  const Vector3 offset = point - camera_.position_m;
  if (!refract_) return offset.normalized();
  const auto path = layered_path<double>(stack_, gel_thickness_m_ + point.z(), offset.head<2>().squaredNorm());
  const double lateral = path.sine_over_lateral / stack_.ior[0];
  return {lateral * offset.x(), lateral * offset.y(), path.cosine_first};
}

std::optional<Vector3> CameraModel::direction_of(double column, double row) const {
  Eigen::Vector2d point((column - intrinsics_[2]) / intrinsics_[0], (row - intrinsics_[3]) / intrinsics_[1]);
  if (camera_.model == Camera::Model::fisheye) {
    const double distorted = point.norm();
    const auto angle = undistorted_angle(distorted, camera_.radial);
    if (!angle) return std::nullopt;
    const double scale = distorted > 1e-12 ? std::sin(*angle) / distorted : 1.0;
    return s_from_camera_ * Vector3(scale * point.x(), scale * point.y(), std::cos(*angle));
  }
  if (camera_.radial != std::array<double, 3>{} || camera_.tangential != std::array<double, 2>{}) {
    const auto straight = undistort(point, camera_.radial, camera_.tangential);
    if (!straight) return std::nullopt;
    point = *straight;
  }
  return s_from_camera_ * Vector3(point.x(), point.y(), 1.0).normalized();
}

std::optional<Eigen::Vector2d> CameraModel::image_of(const Vector3& direction) const {
  const Vector3 d = s_from_camera_.transpose() * direction;
  const double sine = d.head<2>().norm();
  Eigen::Vector2d point;
  if (camera_.model == Camera::Model::fisheye) {
    const double angle = std::atan2(sine, d.z());
    point = sine > 1e-300 ? Eigen::Vector2d(d.head<2>() * (distorted_angle(angle, camera_.radial) / sine))
                          : Eigen::Vector2d::Zero();
  } else {
    if (d.z() <= 0.0) return std::nullopt;
    point = distort(d.head<2>() / d.z(), camera_.radial, camera_.tangential);
  }
  return Eigen::Vector2d(intrinsics_[0] * point.x() + intrinsics_[2], intrinsics_[1] * point.y() + intrinsics_[3]);
}

std::optional<CameraRay> CameraModel::enter(const Vector3& direction) const {
  if (direction.z() <= 0.0) return std::nullopt;
  if (!refract_) return CameraRay{camera_.position_m, direction, 1.0};
  const double p2 = stack_.ior[0] * stack_.ior[0] * direction.head<2>().squaredNorm();
  double reach = 0.0, transmittance = 1.0, before = stack_.ior[0] * direction.z();
  for (int i = 0; i < stack_.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double n = stack_.ior[k], squared = n * n - p2;
    if (squared <= 0.0) return std::nullopt;
    const double n_cosine = std::sqrt(squared);
    if (i > 0 && n != stack_.ior[k - 1]) {
      const double a = stack_.ior[k - 1], rs = (before - n_cosine) / (before + n_cosine);
      const double rp = (n * n * before - a * a * n_cosine) / (n * n * before + a * a * n_cosine);
      transmittance *= 1.0 - 0.5 * (rs * rs + rp * rp);
    }
    if (i + 1 < stack_.count) reach += stack_.thickness_m[k] / n_cosine;
    before = n_cosine;
  }
  const double n = stack_.ior[stack_.count - 1], scale = stack_.ior[0];
  CameraRay ray;
  ray.direction = Vector3(scale * direction.x() / n, scale * direction.y() / n, before / n);
  ray.origin = Vector3(camera_.position_m.x() + reach * scale * direction.x(),
                       camera_.position_m.y() + reach * scale * direction.y(), back_z_m_);
  ray.transmittance = transmittance;
  return ray;
}

Eigen::Vector2d CameraModel::plane_point(double column, double row) const {
  return camera_.position_m.head<2>() + s_from_camera_.topLeftCorner<2, 2>() *
                                            Eigen::Vector2d((column / camera_.width_px - 0.5) * camera_.window_width_m,
                                                            (row / camera_.height_px - 0.5) * camera_.window_height_m);
}

std::optional<CameraRay> CameraModel::ray(double column, double row) const {
  if (camera_.model == Camera::Model::rectified) {
    const CameraRays eight = rays(Pack{} + column, row);
    return CameraRay{lane_of(eight.origin, 0), lane_of(eight.direction, 0), eight.transmittance[0]};
  }
  const auto direction = direction_of(column, row);
  return direction ? enter(*direction) : std::nullopt;
}

namespace {

/// Refracts rays from the camera through points of the plane z = 0 at the layers.
TACIPC_CLONES void refract_to_plane(const LayerStack& stack, double gel_thickness_m, const Pack& px, const Pack& py,
                                    const double* camera, CameraRays& out) {
  const Pack dx = px - camera[0], dy = py - camera[1];
  const auto path = layered_path<Pack>(stack, Pack{} + gel_thickness_m, dx * dx + dy * dy);
  const Pack scale = path.sine_over_lateral / stack.ior[stack.count - 1];
  out.direction = {scale * dx, scale * dy, path.cosine_last};
  const Pack back = gel_thickness_m / path.cosine_last;
  out.origin = {px - back * out.direction.x, py - back * out.direction.y, Pack{} - gel_thickness_m};
  out.transmittance = path.transmittance;
}

}  // namespace

CameraRays CameraModel::rays(const Pack& columns, double row) const {
  CameraRays out{};
  if (camera_.model == Camera::Model::rectified) {
    Pack px, py;
    for (int l = 0; l < kLanes; ++l) {
      const Eigen::Vector2d point = plane_point(columns[l], row);
      px[l] = point.x();
      py[l] = point.y();
    }
    if (refract_) {
      refract_to_plane(stack_, gel_thickness_m_, px, py, camera_.position_m.data(), out);
      return out;
    }
    const double h = -camera_.position_m.z();
    const Pack dx = px - camera_.position_m.x(), dy = py - camera_.position_m.y();
    for (int l = 0; l < kLanes; ++l) {
      const double inverse = 1.0 / std::sqrt(dx[l] * dx[l] + dy[l] * dy[l] + h * h);
      put(out.direction, l, {inverse * dx[l], inverse * dy[l], inverse * h});
    }
    out.origin = {Pack{} + camera_.position_m.x(), Pack{} + camera_.position_m.y(), Pack{} + camera_.position_m.z()};
    out.transmittance = Pack{} + 1.0;
    return out;
  }
  for (int l = 0; l < kLanes; ++l) {
    const auto one = ray(columns[l], row);
    const CameraRay r = one.value_or(CameraRay{camera_.position_m, -Vector3::UnitZ(), 0.0});
    put(out.origin, l, r.origin);
    put(out.direction, l, r.direction);
    out.transmittance[l] = r.transmittance;
  }
  return out;
}

std::optional<Eigen::Vector2d> CameraModel::project(const Vector3& point) const {
  if (refract_ ? gel_thickness_m_ + point.z() <= 0.0 : point.z() <= camera_.position_m.z()) return std::nullopt;
  if (camera_.model != Camera::Model::rectified) return image_of(towards(point));
  // Continue along the ray in the gel to the plane z = 0, whose points are the pixels.
  Eigen::Vector2d slope = (point - camera_.position_m).head<2>() / (point.z() - camera_.position_m.z());
  if (refract_) {
    const Vector3 offset = point - camera_.position_m;
    const auto path = layered_path<double>(stack_, gel_thickness_m_ + point.z(), offset.head<2>().squaredNorm());
    slope = offset.head<2>() * path.sine_over_lateral / (stack_.ior[stack_.count - 1] * path.cosine_last);
  }
  const Eigen::Vector2d at_plane = point.head<2>() - point.z() * slope;
  const Eigen::Vector2d from_center =
      s_from_camera_.topLeftCorner<2, 2>().transpose() * (at_plane - camera_.position_m.head<2>());
  return Eigen::Vector2d((from_center.x() / camera_.window_width_m + 0.5) * camera_.width_px,
                         (from_center.y() / camera_.window_height_m + 0.5) * camera_.height_px);
}

std::optional<Eigen::Vector2d> CameraModel::on_plane(double column, double row) const {
  if (camera_.model == Camera::Model::rectified) return plane_point(column, row);
  const auto r = ray(column, row);
  if (!r) return std::nullopt;
  return Eigen::Vector2d((r->origin - r->direction * (r->origin.z() / r->direction.z())).head<2>());
}

}  // namespace tacipc
