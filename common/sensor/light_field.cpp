#include "common/sensor/light_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/units.h"
#include "common/sensor/membrane_view.h"

namespace tacipc {
namespace {

/// Interpolates the membrane's height at fractional pixels (bilinear).
/// \return false outside the image
bool height_at(const MembraneView& view, double x, double y, double& z) {
  if (!(x >= 0.0 && y >= 0.0 && x <= view.width - 1 && y <= view.height - 1)) return false;
  const int x0 = std::min(static_cast<int>(x), view.width - 2), y0 = std::min(static_cast<int>(y), view.height - 2);
  const double u = x - x0, v = y - y0;
  const std::size_t i = view.index(x0, y0), j = view.index(x0, y0 + 1);
  z = (1 - v) * ((1 - u) * view.point[i].z() + u * view.point[i + 1].z()) +
      v * ((1 - u) * view.point[j].z() + u * view.point[j + 1].z());
  return true;
}

double irradiance(const Vector3& point, const Vector3& normal, const Vector3& lamp) {
  const Vector3 way = lamp - point;
  const double squared = way.squaredNorm();
  return std::max(-normal.dot(way), 0.0) / (squared * std::sqrt(squared));
}

}  // namespace

double lamp_visibility(const MembraneView& view, int x, int y, const Vector3& lamp_m, double softness) {
  constexpr double kStepPx = 1.5;  // the membrane is smoother than this
  constexpr int kMaxSteps = 400;
  const std::size_t here = view.index(x, y);
  const Vector3& point = view.point[here];
  const Vector3 way = lamp_m - point;
  const double distance = std::hypot(way.x(), way.y());
  if (distance == 0.0 || view.width < 2 || view.height < 2) return 1.0;
  const double fall = way.z() / distance;  // < 0: towards the light the path goes into the gel
  // Size of one pixel of the undeformed front: parallax within a shadow's length is neglected.
  const double pixel_x = view.rest[1].x() - view.rest[0].x();
  const double pixel_y = view.rest[view.width].y() - view.rest[0].y();
  const double step = kStepPx * pixel_x;
  const double dx = way.x() / distance * step / pixel_x, dy = way.y() / distance * step / pixel_y;
  double clearance = -fall;
  for (int i = 1; i <= kMaxSteps; ++i) {
    double z = 0.0;
    if (!height_at(view, x + i * dx, y + i * dy, z)) break;
    clearance = std::min(clearance, (z - point.z()) / (i * step) - fall);
    // No point lies deeper than the object, at most a gel's thickness; 3 mm covers every press a gel survives.
    constexpr double kMaxDepthM = 3e-3;
    if (point.z() + fall * i * step < -kMaxDepthM) break;
  }
  return std::clamp(0.5 + clearance / softness, 0.0, 1.0);
}

double relative_irradiance(const MembraneView& view, int x, int y, const Vector3& lamp_m, double softness) {
  const std::size_t i = view.index(x, y);
  const double flat = irradiance(view.rest[i], Vector3::UnitZ(), lamp_m);
  const double lit = irradiance(view.point[i], view.normal[i], lamp_m);
  if (lit == 0.0) return -1.0;
  return lamp_visibility(view, x, y, lamp_m, softness) * lit / flat - 1.0;
}

double relative_irradiance(const LightGeometry& geometry, const MembraneView& view, int x, int y, const Vector3& normal,
                           std::size_t lamp) {
  const Vector3& middle = geometry.lamps_m[lamp];
  const double half = geometry.lamp_half_width_rad.empty() ? 0.0 : geometry.lamp_half_width_rad[lamp];
  constexpr std::array<double, 5> kNodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                         0.9061798459386640};
  constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                           0.4786286704993665, 0.2369268850561891};
  const std::size_t i = view.index(x, y);
  if (half == 0.0) {
    const double here = irradiance(view.point[i], normal, middle);
    if (here == 0.0) return -1.0;
    const double flat = irradiance(view.rest[i], Vector3::UnitZ(), middle);
    return lamp_visibility(view, x, y, middle, geometry.shadow_softness) * here / flat - 1.0;
  }
  double flat = 0.0, lit = 0.0;
  for (std::size_t k = 0; k < kNodes.size(); ++k) {
    const Vector3 point = Eigen::AngleAxisd(half * kNodes[k], Vector3::UnitZ()) * middle;
    flat += kWeights[k] * irradiance(view.rest[i], Vector3::UnitZ(), point);
    const double here = irradiance(view.point[i], normal, point);
    if (here > 0.0) lit += kWeights[k] * here * lamp_visibility(view, x, y, point, geometry.shadow_softness);
  }
  return lit / flat - 1.0;
}

LightFeatures::LightFeatures(const LightGeometry& geometry, const MembraneView& view)
    : geometry_(&geometry), view_(&view) {
  if (geometry.dome.size() > 0) dome_.emplace(geometry.dome, view);
}

void LightFeatures::bases(int x, int y, const Vector3& n, const std::vector<double>* row_horizons, double* out) const {
  const LightGeometry& geometry = *geometry_;
  const MembraneView& view = *view_;
  const std::size_t i = view.index(x, y);
  for (std::size_t lamp = 0; lamp < geometry.lamps_m.size(); ++lamp) {
    const double q = relative_irradiance(geometry, view, x, y, n, lamp);
    *out++ = q;
    *out++ = q * q;
  }
  if (dome_ && row_horizons)
    dome_->at(x, *row_horizons, n, out);
  else if (dome_)
    dome_->at(x, y, n, out);
  out += geometry.dome.size();
  for (int degree = 1; degree <= geometry.environment_degree; ++degree)
    for (int power_y = 0; power_y <= degree; ++power_y)
      *out++ = std::pow(n.x(), degree - power_y) * std::pow(n.y(), power_y);
  if (geometry.environment_depth) *out++ = (view.rest[i].z() - view.point[i].z()) / kMillimetre;
}

void LightGeometry::field_terms(const Vector3& rest, double* out) const {
  const double field_x = rest.x() / field_half_width_m, field_y = rest.y() / field_half_width_m;
  for (int degree = 0; degree <= field_degree; ++degree)
    for (int power_y = 0; power_y <= degree; ++power_y) {
      double f = 1.0;
      for (int k = 0; k < degree; ++k) f *= k < degree - power_y ? field_x : field_y;
      *out++ = f;
    }
}

void LightFeatures::at(int x, int y, const Vector3& normal, double* out) const {
  std::vector<double> values(geometry_->num_bases());
  bases(x, y, normal, nullptr, values.data());
  std::vector<double> terms(geometry_->num_field_terms());
  geometry_->field_terms(view_->rest[view_->index(x, y)], terms.data());
  for (const double value : values)
    for (const double term : terms) *out++ = value * term;
}

void LightFeatures::at(int x, int y, double* out) const { at(x, y, view_->normal[view_->index(x, y)], out); }

void LightFeatures::row_bases(int y, Eigen::MatrixXd& out) const {
  out.resize(geometry_->num_bases(), view_->width);
  const auto horizons = dome_ ? dome_->row_horizons(y) : std::vector<double>{};
  for (int x = 0; x < view_->width; ++x)
    bases(x, y, view_->normal[view_->index(x, y)], dome_ ? &horizons : nullptr, out.col(x).data());
}

FloatImage code_change(const LightField& light, const MembraneView& view) {
  FloatImage change(view.width, view.height, 3);
  const LightFeatures of(light.geometry, view);
  // Σ_j f_j (Σ_k w_kj φ_k) avoids the products f_j φ_k at every pixel.
  const Eigen::Index terms = light.geometry.num_field_terms(), bases = light.geometry.num_bases();
  Eigen::MatrixXd weights(3 * terms, bases);
  for (Eigen::Index k = 0; k < bases; ++k)
    for (Eigen::Index j = 0; j < terms; ++j)
      weights.block<3, 1>(3 * j, k) = light.weights.row(k * terms + j).transpose();
  tbb::parallel_for(0, view.height, [&](int y) {
    Eigen::MatrixXd values;
    of.row_bases(y, values);
    const Eigen::MatrixXd by_term = weights * values;
    Eigen::VectorXd field(terms);
    for (int x = 0; x < view.width; ++x) {
      light.geometry.field_terms(view.rest[view.index(x, y)], field.data());
      const auto codes = by_term.col(x).reshaped(3, terms);
      for (int c = 0; c < 3; ++c) change.at(x, y, c) = static_cast<float>(codes.row(c).dot(field));
    }
  });
  return gaussian_blurred(change, light.blur_px);
}

ByteImage add_change(const ByteImage& background, const FloatImage& change) {
  assert(background.pixels.size() == change.pixels.size());
  ByteImage out = background;
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] =
        static_cast<std::uint8_t>(std::clamp(std::round(background.pixels[i] + double{change.pixels[i]}), 0.0, 255.0));
  return out;
}

FloatImage gaussian_blurred(const FloatImage& image, double sigma_px) {
  if (sigma_px == 0.0) return image;
  const int radius = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) sum += weights.emplace_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
  const auto mirrored = [](int i, int n) {
    if (n == 1) return 0;
    const int phase = std::abs(i) % (2 * n - 2);
    return phase < n ? phase : 2 * n - 2 - phase;
  };
  const auto pass = [&](const FloatImage& in, bool along_x) {
    FloatImage out(in.width, in.height, in.channels);
    for (int y = 0; y < in.height; ++y)
      for (int x = 0; x < in.width; ++x)
        for (int c = 0; c < in.channels; ++c) {
          double total = 0.0;
          for (int i = -radius; i <= radius; ++i)
            total += weights[i + radius] *
                     (along_x ? in.at(mirrored(x + i, in.width), y, c) : in.at(x, mirrored(y + i, in.height), c));
          out.at(x, y, c) = static_cast<float>(total / sum);
        }
    return out;
  };
  return pass(pass(image, true), false);
}

}  // namespace tacipc
