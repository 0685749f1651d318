// Light field: illumination of a sensor whose light sources are unknown. Point lights are fitted to photographs, and
// the residual is a smooth environment. The light field predicts the change of a pixel's 8-bit value when the membrane
// at that pixel is displaced and tilted.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/base/types.h"
#include "common/base/value.h"
#include "common/config/config.h"
#include "common/image/image.h"
#include "common/sensor/dome_light.h"

namespace tacipc {

struct MembraneView;

/// Geometry of a light field: the parameters on which its features depend non-linearly.
///
/// Light l at p_l illuminates a membrane point x of inner normal −n with g = max(−n · w, 0) / r², w = (p_l − x) / r.
/// Relative to the flat front on the same ray, with V the fraction of the light that the membrane itself does not hide:
///   q_l = V g / g_flat − 1.
/// The membrane is a height field z over the image plane. It lets the following fraction pass:
///   V = clamp(1/2 + m / softness, 0, 1),  m = min over s of (z(x + s ŵ) − z_ray(s)) / s,
/// with s the distance in the plane towards the light. Here m is the angle (tangent) by which the path clears the
/// membrane, and `softness` the width of the penumbra.
///
/// The environment is a polynomial φ_m(n) = n_x^i n_y^j, 1 ≤ i + j ≤ degree, of the unit normal: spherical harmonics up
/// to that degree without their constant, restricted to the sphere. With `environment_depth` it also varies along z, by
/// φ = (z_rest − z) / 1 mm.
///
/// A light of half width w is a strip that covers azimuths ± w about the z axis from its position. Its q uses
/// the sum of V g over five of its points (Gauss–Legendre) in place of V g.
///
/// The dome (dome_light.h) is light from all directions in bins, each hidden by the membrane's true horizon. Its
/// features are the irradiance from each bin minus that of the flat front. They count as environment.
struct LightGeometry {
  std::vector<Vector3> lamps_m = {};             // positions of the point lights, frame S
  std::vector<double> lamp_half_width_rad = {};  // per light; empty: points
  double shadow_softness = 0.0;                  // width of the penumbra, a tangent, > 0
  int environment_degree = 0;                    // 0: no environment
  DomeBins dome = {};
  bool environment_depth = false;  // adds a monomial: depth of the membrane
  int field_degree = 1;            // degree of the polynomial in x and y by which weights vary over the field
  double field_half_width_m = 1;   // half-width over which x and y of that polynomial run from −1 to 1

  int num_monomials() const { return environment_degree * (environment_degree + 3) / 2 + (environment_depth ? 1 : 0); }
  /// Returns the number of terms 1, x, y, x², xy, y², … up to field_degree.
  int num_field_terms() const { return (field_degree + 1) * (field_degree + 2) / 2; }
  /// Computes these terms at a point of the flat front.
  /// \pre out has num_field_terms() entries
  void field_terms(const Vector3& rest, double* out) const;
  /// Returns the number of bases: q and q² of each light, bins of the dome, monomials. Each has as many features as the
  /// field has terms.
  int num_bases() const { return 2 * static_cast<int>(lamps_m.size()) + dome.size() + num_monomials(); }
  int num_features() const { return num_field_terms() * num_bases(); }
  int first_environment_feature() const { return num_field_terms() * 2 * static_cast<int>(lamps_m.size()); }
};

/// Returns the fraction V of the light at `lamp_m` that reaches pixel (x, y) over the membrane; see LightGeometry.
double lamp_visibility(const MembraneView& view, int x, int y, const Vector3& lamp_m, double softness);

/// Returns q_l of one point light at a pixel.
double relative_irradiance(const MembraneView& view, int x, int y, const Vector3& lamp_m, double softness);

/// Returns q of light `lamp` of the geometry, with its width, for this membrane normal.
double relative_irradiance(const LightGeometry& geometry, const MembraneView& view, int x, int y, const Vector3& normal,
                           std::size_t lamp);

/// Features of the pixels of one view. Bases are ordered: lights (q, q²), dome, monomials by degree and falling power
/// of n_x, depth last. Each is multiplied by f = (1, x, y, …), ordered by degree and falling power of x.
class LightFeatures {
 public:
  /// \pre the view does not change, except for its normals
  LightFeatures(const LightGeometry& geometry, const MembraneView& view);

  /// Computes the features of a pixel with this membrane normal.
  /// \pre out has num_features() entries
  void at(int x, int y, const Vector3& normal, double* out) const;
  /// Computes the features of a pixel with the view's own normal.
  void at(int x, int y, double* out) const;
  /// Computes the bases alone for all pixels of a row, one column each, with the view's own normals. Faster than pixel
  /// by pixel.
  void row_bases(int y, Eigen::MatrixXd& out) const;

 private:
  void bases(int x, int y, const Vector3& normal, const std::vector<double>* row_horizons, double* out) const;

  const LightGeometry* geometry_;
  const MembraneView* view_;
  std::optional<DomeIrradiance> dome_;
};

/// Change of the 8-bit value in channel c: Σ_l (a_lc · f) q_l + (b_lc · f) q_l² + Σ_k (d_kc · f) D_k + Σ_m (e_mc · f)
/// φ_m(n), f = (1, x, y, …). a is the contribution of a light through the camera's colour matrix (so it may be
/// negative) and the vignetting, b the curvature of the response, d the dome's radiance, e the rest of the environment.
struct LightField {
  LightGeometry geometry;
  Eigen::Matrix<double, Eigen::Dynamic, 3> weights;  // #features × channels, 8-bit levels
  double blur_px = 0.0;                              // σ of the optics' Gaussian blur, applied to the change

  static LightField read(ConfigReader& in);
  Value to_value() const;
};

/// Reads `azimuths` (at least 3), the number of `bands` and their `elevation_tan` from a section `dome`.
DomeBins read_dome_bins(ConfigReader& in);

/// Returns the change of the 8-bit values of `view` against the photograph without contact, not rounded.
FloatImage code_change(const LightField& light, const MembraneView& view);

/// Returns clamp(round(background + change), 0, 255), so that noise and texture of the photograph remain.
/// \pre equal sizes
ByteImage add_change(const ByteImage& background, const FloatImage& change);

/// Gaussian blur, cut at 4 σ; the border is mirrored about the outermost pixels. σ = 0 returns the image unchanged.
FloatImage gaussian_blurred(const FloatImage& image, double sigma_px);

}  // namespace tacipc
