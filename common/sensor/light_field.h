// Light of a sensor without known lamps: point lamps fitted to photographs, and the residual as a
// smooth environment. It answers one question: by how many codes does a pixel change when the membrane there rises and
// turns?
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

/// The part of the model that features depend on non-linearly.
///
/// Lamp l at p_l lights a membrane point x of inner normal −n with g = max(−n · w, 0) / r², w = (p_l − x) / r. Relative
/// to the flat front on the same ray, with the share V of the lamp that the membrane itself does not hide:
///   q_l = V g / g_flat − 1.
/// The membrane as a height field z over the image plane hides the lamp by
///   V = clamp(1/2 + m / softness, 0, 1),  m = min over s of (z(x + s ŵ) − z_ray(s)) / s,
/// s the distance in the plane towards the lamp: the angle (tangent) by which the path clears the membrane, over the
/// width of the penumbra. The environment is a polynomial φ_m(n) = n_x^i n_y^j, 1 ≤ i + j ≤ degree, of the unit normal:
/// spherical harmonics up to that degree without their constant, restricted to the sphere; with `environment_depth` it
/// also varies along z, by φ = (z_rest − z) / 1 mm.
///
/// A lamp of half width w is a strip: it covers azimuths ± w about the z axis from its position, and q is of the sum of
/// V g over five of its points (Gauss–Legendre) in place of V g.
///
/// The dome (dome_light.h) is light from all sides in bins of direction, each hidden by the membrane's true horizon.
/// Its features are the irradiance from each bin less that of the flat front. They count as environment.
struct LightGeometry {
  std::vector<Vector3> lamps_m = {};             // frame S
  std::vector<double> lamp_half_width_rad = {};  // of each lamp; none: points
  double shadow_softness = 0.0;                  // > 0; tangent
  int environment_degree = 0;                    // 0: none
  DomeBins dome = {};
  bool environment_depth = false;  // one more monomial: how deep the membrane lies
  int field_degree = 1;            // of the polynomial in x and y by which weights vary over the field
  double field_half_width_m = 1;   // x and y of the fields below run from −1 to 1 over this

  int num_monomials() const { return environment_degree * (environment_degree + 3) / 2 + (environment_depth ? 1 : 0); }
  /// 1, x, y, x², xy, y², … up to field_degree
  int num_field_terms() const { return (field_degree + 1) * (field_degree + 2) / 2; }
  /// Those of a point of the flat front. \pre out has num_field_terms() entries
  void field_terms(const Vector3& rest, double* out) const;
  /// A lamp's q and its q², a bin of the dome, a monomial: each is one, and has as many features as the field has
  /// terms.
  int num_bases() const { return 2 * static_cast<int>(lamps_m.size()) + dome.size() + num_monomials(); }
  int num_features() const { return num_field_terms() * num_bases(); }
  int first_environment_feature() const { return num_field_terms() * 2 * static_cast<int>(lamps_m.size()); }
};

/// Share of lamp `lamp_m` that pixel (x, y) sees over the membrane. See LightGeometry.
double lamp_visibility(const MembraneView& view, int x, int y, const Vector3& lamp_m, double softness);

/// q_l of one lamp at a pixel.
double relative_irradiance(const MembraneView& view, int x, int y, const Vector3& lamp_m, double softness);

/// q of lamp `lamp` of the geometry, with its width, where the membrane has this normal.
double relative_irradiance(const LightGeometry& geometry, const MembraneView& view, int x, int y, const Vector3& normal,
                           std::size_t lamp);

/// All features of the pixels of one view. Bases are the lamps (q, q²), then the dome, then monomials by degree and
/// falling power of n_x, depth last; each times f = (1, x, y, …) by degree and falling power of x.
class LightFeatures {
 public:
  /// \pre the view stays as it is, but for its normals
  LightFeatures(const LightGeometry& geometry, const MembraneView& view);

  /// Of a pixel whose membrane has this normal. \pre out has num_features() entries
  void at(int x, int y, const Vector3& normal, double* out) const;
  /// The same with the view's own normal.
  void at(int x, int y, double* out) const;
  /// The bases alone, of all pixels of a row with the view's own normals, a column each: faster than one after the
  /// other.
  void row_bases(int y, Eigen::MatrixXd& out) const;

 private:
  void bases(int x, int y, const Vector3& normal, const std::vector<double>* row_horizons, double* out) const;

  const LightGeometry* geometry_;
  const MembraneView* view_;
  std::optional<DomeIrradiance> dome_;
};

/// Change of code in channel c: Σ_l (a_lc · f) q_l + (b_lc · f) q_l² + Σ_k (d_kc · f) D_k + Σ_m (e_mc · f) φ_m(n), f =
/// (1, x, y, …): a is what a lamp contributes through the camera's colour matrix (so it may be negative) and the
/// vignetting, b the curvature of the response, d the dome's radiance, e the rest of the environment.
struct LightField {
  LightGeometry geometry;
  Eigen::Matrix<double, Eigen::Dynamic, 3> weights;  // #features × channels, codes
  double blur_px = 0.0;                              // σ of the optics' Gaussian blur, on the change

  static LightField read(ConfigReader& in);
  Value to_value() const;
};

/// `azimuths`, at least 3, number of `bands` and their `elevation_tan` of a section `dome`.
DomeBins read_dome_bins(ConfigReader& in);

/// Codes by which the image of `view` differs from the photograph without contact, not rounded.
FloatImage code_change(const LightField& light, const MembraneView& view);

/// clamp(round(background + change), 0, 255): the noise and the texture of the photograph carry over.
/// \pre equal sizes
ByteImage add_change(const ByteImage& background, const FloatImage& change);

/// Gaussian blur (cut at 4 σ, border mirrored about the outermost pixels), σ = 0 leaves the image.
FloatImage gaussian_blurred(const FloatImage& image, double sigma_px);

}  // namespace tacipc
