// The sensor's camera looking through its layers: from image points to rays in the gel, and back.
#pragma once

#include <optional>

#include "common/base/types.h"
#include "common/sensor/layered_path.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Eight rays as they run in the gel.
struct CameraRays {
  Pack3 origin;        // m
  Pack3 direction;     // unit
  Pack transmittance;  // share of the radiance that leaves towards the camera (Fresnel); 0: no ray
};

/// The vector in a lane, and the way back.
inline Vector3 lane_of(const Pack3& pack, int lane) { return {pack.x[lane], pack.y[lane], pack.z[lane]}; }
inline void put(Pack3& pack, int lane, const Vector3& v) {
  pack.x[lane] = v.x();
  pack.y[lane] = v.y();
  pack.z[lane] = v.z();
}

/// One such ray.
struct CameraRay {
  Vector3 origin;
  Vector3 direction;
  double transmittance;
};

/// Image points are (column, row) in pixels from the outer corner of pixel (0, 0), whose centre is (0.5, 0.5).
class CameraModel {
 public:
  /// With `refract` rays bend at the layers of the stack (if it has indices), else they go straight.
  CameraModel(const Camera& camera, const OpticalStack& stack, bool refract = true);

  /// Ray through an image point; nothing if it looks away from the gel or is totally reflected before.
  std::optional<CameraRay> ray(double column, double row) const;
  /// The same for eight points of a row. \pre 8 columns
  CameraRays rays(const Pack& columns, double row) const;
  /// Image point that shows a point of the gel: the inverse of `ray`. Nothing for points that no image point shows
  /// (behind the camera, or beyond what distortion leaves invertible).
  std::optional<Eigen::Vector2d> project(const Vector3& point) const;
  /// Where the ray through an image point meets the plane z = 0.
  std::optional<Eigen::Vector2d> on_plane(double column, double row) const;

  /// Rotation whose columns are the camera's axes (x right, y down, z along the view) in S.
  const Matrix3& s_from_camera() const { return s_from_camera_; }
  /// fx, fy, cx, cy of pinhole and fisheye.
  const std::array<double, 4>& intrinsics_px() const { return intrinsics_; }

 private:
  std::optional<Vector3> direction_of(double column, double row) const;
  std::optional<Eigen::Vector2d> image_of(const Vector3& direction) const;
  std::optional<CameraRay> enter(const Vector3& direction) const;
  Eigen::Vector2d plane_point(double column, double row) const;
  Vector3 towards(const Vector3& point) const;

  Camera camera_;
  bool refract_;
  double gel_thickness_m_;
  double back_z_m_;
  LayerStack stack_;  // from the camera to the gel
  Matrix3 s_from_camera_;
  std::array<double, 4> intrinsics_{};
};

/// Share of the light that the lens leaves a pixel (column x, row y): 1 + v2 ρ² + v4 ρ⁴, ρ the distance of its centre
/// from the image's over half the diagonal.
double vignetting(const Camera& camera, int x, int y);

/// Brown's distortion of normalised image coordinates (x, y) = (tan θ cos φ, tan θ sin φ):
///   x_d = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²), y_d alike with p1 and p2 exchanged.
Eigen::Vector2d distort(const Eigen::Vector2d& point, const std::array<double, 3>& radial,
                        const std::array<double, 2>& tangential);
/// Its inverse by Newton's method to 1e-13; nothing where it does not converge.
std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& point, const std::array<double, 3>& radial,
                                         const std::array<double, 2>& tangential);

}  // namespace tacipc
