// Draws solid bodies as a picture: the nearest surface of each pixel in flat shades, with lines along edges and
// outlines.
#pragma once

#include <vector>

#include "common/base/types.h"
#include "common/image/image.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/dataset/report/sheet.h"

namespace tacipc {

/// Pinhole camera in the world. Image right and up, and `back` towards the eye, are orthonormal.
struct Viewpoint {
  Vector3 right = Vector3::UnitX(), up = Vector3::UnitZ(), back = -Vector3::UnitY();
  Vector3 target_m = Vector3::Zero();
  double distance_m = 1.0;  // distance of the eye from the target, along `back`
  double zoom = 4.5;        // half a picture's height lies under the angle atan(1 / zoom)
};

/// Camera that looks along −`back` with z up, as near as possible with all `points` (m) in a picture of this `aspect`
/// (width over height).
/// \pre points are not empty, `back` is not upright
Viewpoint viewpoint_of(const std::vector<Vector3>& points, const Vector3& back, double aspect);

/// Picture under construction, with a depth test per sample.
class Raster {
 public:
  /// Starts with a white picture.
  /// \pre width, height ≥ 1
  Raster(int width, int height, const Viewpoint& from);

  /// Draws a mesh. Lines separate surfaces of different `body`. Parts behind the eye are cut off.
  void draw(const TriangleMesh& mesh, const Matrix4& world_from_mesh, const Color& color, int body);

  /// Picture in the requested size; every pixel is the mean of 3 × 3 samples.
  ByteImage picture() const;

 private:
  struct Fragment {
    double nearness = 0.0;  // 1 / depth; 0: empty
    int body = -1;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // normal in the camera's axes
    Eigen::Vector3f color = Eigen::Vector3f::Constant(255.0f);
  };
  void fill(const Vector3& a, const Vector3& b, const Vector3& c, const Fragment& surface);
  bool line_between(const Fragment& a, const Fragment& b) const;
  const Fragment& at(int x, int y) const;

  int width_, height_;  // size in samples
  Viewpoint from_;
  std::vector<Fragment> fragments_;
};

}  // namespace tacipc
