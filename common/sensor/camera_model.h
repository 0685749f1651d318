// The sensor's camera behind its transparent layers: maps image points to rays in the gel and back.
#pragma once

#include <optional>

#include "common/base/types.h"
#include "common/sensor/layered_path.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Eight rays inside the gel.
struct CameraRays {
  Pack3 origin;        // m
  Pack3 direction;     // unit
  Pack transmittance;  // fraction of the radiance that leaves towards the camera (Fresnel); 0: no ray
};

/// Reads or sets the vector in one lane.
inline Vector3 lane_of(const Pack3& pack, int lane) { return {pack.x[lane], pack.y[lane], pack.z[lane]}; }
inline void put(Pack3& pack, int lane, const Vector3& v) {
  pack.x[lane] = v.x();
  pack.y[lane] = v.y();
  pack.z[lane] = v.z();
}

/// One ray inside the gel; fields as in CameraRays.
struct CameraRay {
  Vector3 origin;
  Vector3 direction;
  double transmittance;
};

/// Camera with its layers. Image points are (column, row) in pixels from the outer corner of pixel (0, 0), whose centre
/// is (0.5, 0.5).
class CameraModel {
 public:
  /// \param refract true: rays bend at the layers of the stack, if it has refractive indices; false: rays are straight
  CameraModel(const Camera& camera, const OpticalStack& stack, bool refract = true);

  /// Returns the ray through an image point; nothing if it points away from the gel or is totally reflected before it.
  std::optional<CameraRay> ray(double column, double row) const;
  /// Returns the rays through eight points of a row.
  /// \param columns eight columns
  CameraRays rays(const Pack& columns, double row) const;
  /// Returns the image point that shows a point of the gel: the inverse of ray(). Nothing if no image point shows it
  /// (behind the camera, or where the distortion cannot be inverted).
  std::optional<Eigen::Vector2d> project(const Vector3& point) const;
  /// Returns where the ray through an image point meets the plane z = 0: (x, y), m.
  std::optional<Eigen::Vector2d> on_plane(double column, double row) const;

  /// Returns the rotation whose columns are the camera's axes (x right, y down, z along the view) in S.
  const Matrix3& s_from_camera() const { return s_from_camera_; }
  /// Returns fx, fy, cx, cy of a pinhole or fisheye camera, pixels.
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
  LayerStack stack_;  // layers from the camera to the gel
  Matrix3 s_from_camera_;
  std::array<double, 4> intrinsics_{};
};

/// Returns the vignetting of a pixel (column x, row y), the fraction of light that remains: 1 + v2 ρ² + v4 ρ⁴, with ρ
/// the distance of its centre from the image's centre over half the diagonal.
double vignetting(const Camera& camera, int x, int y);

/// Brown's distortion of normalised image coordinates (x, y) = (tan θ cos φ, tan θ sin φ):
///   x_d = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²), y_d likewise with p1 and p2 exchanged.
Eigen::Vector2d distort(const Eigen::Vector2d& point, const std::array<double, 3>& radial,
                        const std::array<double, 2>& tangential);
/// Inverse of distort() by Newton's method to 1e-13; nothing if it does not converge.
std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& point, const std::array<double, 3>& radial,
                                         const std::array<double, 2>& tangential);

}  // namespace tacipc
