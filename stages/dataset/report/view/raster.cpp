#include "stages/dataset/report/view/raster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tacipc {
namespace {

constexpr int kSamples = 3;              // samples per pixel along each side
constexpr double kNear = 0.02;           // fraction of the distance to the target
constexpr double kPictureMargin = 1.04;  // size of the picture over that of its content

}  // namespace

Viewpoint viewpoint_of(const std::vector<Vector3>& points, const Vector3& back, double aspect) {
  Viewpoint view;
  view.back = back.normalized();
  view.right = Vector3::UnitZ().cross(view.back).normalized();
  view.up = view.back.cross(view.right);
  Vector3 low = points.front(), high = points.front();
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  view.target_m = 0.5 * (low + high);
  const double wide = view.zoom / aspect;  // factor on x that puts the picture's sides at ±1
  // Near points look larger. Centring the view allows a nearer camera, which changes the centre slightly, so this
  // repeats.
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    view.distance_m = 1e-6;
    for (const Vector3& p : points) {
      const Vector3 d = p - view.target_m;
      const double across = std::max(wide * std::abs(d.dot(view.right)), view.zoom * std::abs(d.dot(view.up)));
      view.distance_m = std::max(view.distance_m, d.dot(view.back) + kPictureMargin * across);
    }
    if (round + 1 == kRounds) break;
    Eigen::Vector2d least = Eigen::Vector2d::Constant(1e9), most = -least;
    for (const Vector3& p : points) {
      const Vector3 d = p - view.target_m;
      const Eigen::Vector2d seen =
          Eigen::Vector2d(d.dot(view.right), d.dot(view.up)) / (view.distance_m - d.dot(view.back));
      least = least.cwiseMin(seen);
      most = most.cwiseMax(seen);
    }
    const Eigen::Vector2d middle = 0.5 * view.distance_m * (least + most);
    view.target_m += middle.x() * view.right + middle.y() * view.up;
  }
  return view;
}

Raster::Raster(int width, int height, const Viewpoint& from)
    : width_(kSamples * width),
      height_(kSamples * height),
      from_(from),
      fragments_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

const Raster::Fragment& Raster::at(int x, int y) const {
  return fragments_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
}

void Raster::draw(const TriangleMesh& mesh, const Matrix4& world_from_mesh, const Color& color, int body) {
  const Vector3 light =
      Vector3(-0.45, 0.75, 0.6).normalized();  // direction in the camera's axes: from above on the left
  Matrix3 axes;
  axes << from_.right.transpose(), from_.up.transpose(), from_.back.transpose();
  const Vector3 eye = from_.target_m + from_.distance_m * from_.back;
  Positions seen(mesh.positions.rows(), 3);
  for (Eigen::Index v = 0; v < seen.rows(); ++v) {
    const Vector3 world = world_from_mesh.topLeftCorner<3, 3>() * mesh.positions.row(v).transpose() +
                          world_from_mesh.topRightCorner<3, 1>();
    seen.row(v) = (axes * (world - eye)).transpose();
  }
  const double near = -kNear * from_.distance_m;  // z points to the eye
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const std::array<Vector3, 3> corners{seen.row(mesh.triangles(t, 0)), seen.row(mesh.triangles(t, 1)),
                                         seen.row(mesh.triangles(t, 2))};
    Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (normal.norm() < 1e-18) continue;
    normal.normalize();
    if (normal.dot(corners[0]) > 0.0) normal = -normal;  // both sides of an open surface are visible
    const double shade = 0.68 + 0.34 * std::max(0.0, normal.dot(light)) + 0.06 * normal.z();
    Fragment surface{.body = body, .normal = normal.cast<float>()};
    for (int c = 0; c < 3; ++c)
      surface.color[c] = static_cast<float>(std::min(255.0, shade * color[static_cast<std::size_t>(c)]));
    // Part of the triangle in front of the eye, with three or four corners.
    std::vector<Vector3> kept;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 &a = corners[i], &b = corners[(i + 1) % 3];
      if (a.z() <= near) kept.push_back(a);
      if ((a.z() <= near) != (b.z() <= near)) kept.push_back(a + (near - a.z()) / (b.z() - a.z()) * (b - a));
    }
    for (std::size_t i = 2; i < kept.size(); ++i) fill(kept[0], kept[i - 1], kept[i], surface);
  }
}

void Raster::fill(const Vector3& a, const Vector3& b, const Vector3& c, const Fragment& surface) {
  // Pixel coordinates, and 1 / depth, which is linear in them.
  const auto place = [&](const Vector3& p) {
    const double scale = 0.5 * height_ * from_.zoom / -p.z();
    return Vector3(0.5 * width_ + scale * p.x(), 0.5 * height_ - scale * p.y(), -1.0 / p.z());
  };
  const Vector3 p = place(a), q = place(b), r = place(c);
  const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
  const double area = cross(q.x() - p.x(), q.y() - p.y(), r.x() - p.x(), r.y() - p.y());
  if (std::abs(area) < 1e-12) return;
  const auto clamped = [](double value, int end) { return static_cast<int>(std::clamp(value, 0.0, double(end))); };
  const int left = clamped(std::min({p.x(), q.x(), r.x()}), width_),
            right = clamped(std::max({p.x(), q.x(), r.x()}) + 1.0, width_),
            top = clamped(std::min({p.y(), q.y(), r.y()}), height_),
            bottom = clamped(std::max({p.y(), q.y(), r.y()}) + 1.0, height_);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double px = x + 0.5 - p.x(), py = y + 0.5 - p.y();
      const double of_r = cross(q.x() - p.x(), q.y() - p.y(), px, py) / area,
                   of_q = cross(px, py, r.x() - p.x(), r.y() - p.y()) / area, of_p = 1.0 - of_q - of_r;
      if (of_p < 0.0 || of_q < 0.0 || of_r < 0.0) continue;
      const double nearness = of_p * p.z() + of_q * q.z() + of_r * r.z();
      Fragment& here =
          fragments_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      if (nearness <= here.nearness) continue;
      here = surface;
      here.nearness = nearness;
    }
  }
}

bool Raster::line_between(const Fragment& a, const Fragment& b) const {
  if (a.body != b.body) return true;
  if (a.body < 0) return false;
  constexpr float kEdge = 0.8f;     // cosine: facets of round shapes stay smooth
  constexpr double kBehind = 0.03;  // relative depth step between one part of a body and another behind it
  return a.normal.dot(b.normal) < kEdge ||
         std::abs(a.nearness - b.nearness) > kBehind * std::max(a.nearness, b.nearness);
}

ByteImage Raster::picture() const {
  constexpr float kLine = 0.42f;
  ByteImage samples(width_, height_, 3);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Fragment& here = at(x, y);
      // Half of a line lies on each side of an edge, but none on the background.
      const bool line =
          here.body >= 0 &&
          ((x > 0 && line_between(here, at(x - 1, y))) || (x + 1 < width_ && line_between(here, at(x + 1, y))) ||
           (y > 0 && line_between(here, at(x, y - 1))) || (y + 1 < height_ && line_between(here, at(x, y + 1))));
      for (int c = 0; c < 3; ++c)
        samples.at(x, y, c) = static_cast<std::uint8_t>(std::lround(here.color[c] * (line ? kLine : 1.0f)));
    }
  }
  return fitted_picture(samples, width_ / kSamples, height_ / kSamples);
}

}  // namespace tacipc
