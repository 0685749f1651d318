// A sensor as one file: gel, material, light, camera. Frame S: origin at the centre of the undeformed front face, x to
// image right, y to image down, z out of the gel towards the object; the camera looks along +z from behind. Values are
// SI here.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sensor/layered_path.h"
#include "common/sensor/light_field.h"

namespace tacipc {

/// Outline and thickness of the gel. A flat gel fills −thickness ≤ z ≤ 0; a domed one has its apex at the origin, its
/// front lies on the sphere of radius `dome_radius_m` below it, and its thickness is measured at the apex.
struct GelShape {
  enum class Outline { disc, rectangle };
  Outline outline = Outline::disc;
  double radius_m = 0.0;  // disc
  double width_m = 0.0;   // rectangle, along x
  double height_m = 0.0;  // rectangle, along y
  double thickness_m = 0.0;
  std::optional<double> dome_radius_m = std::nullopt;  // absent: flat front

  static GelShape read(ConfigReader& in);
  /// Whether (x, y) lies within the outline.
  bool contains(double x, double y) const;
  /// Height of the undeformed front face at (x, y): 0 for a flat gel, −(R − √(R² − x² − y²)) for a dome.
  double front_z(double x, double y) const;
};

/// One member of a Prony series: a part of the instantaneous modulus that relaxes.
struct Relaxation {
  double part = 0.0;    // g, of the instantaneous modulus
  double time_s = 0.0;  // τ, in which all but 1/e of it has relaxed
};

/// Isotropic material, elastic or viscoelastic.
struct Material {
  std::string law = {};  // "neo_hookean" or "stvk_hencky"
  double density_kg_m3 = 0.0;
  double youngs_modulus_pa = 0.0;  // long-term: of a gel that has relaxed
  double poissons_ratio = 0.0;
  std::vector<Relaxation> relaxation = {};  // none: elastic; the parts sum to less than 1

  /// The section `material` of a sensor, or a file of its own with the same keys. Values may say where they come from
  /// (ConfigReader::accept_sources).
  static Material read(ConfigReader& in);
  /// Lamé parameters: λ = E ν / ((1 + ν)(1 − 2ν)), μ = E / (2(1 + ν)), in Pa, long-term like E.
  double lame_lambda_pa() const;
  double lame_mu_pa() const;
};

/// A planar layer behind the gel, such as the acrylic window.
struct Layer {
  std::string name = {};
  double thickness_m = 0.0;
  double ior = 1.0;  // refractive index
};

/// What lies between membrane and camera, in order of falling z: the gel, the layers, then air.
struct OpticalStack {
  double gel_thickness_m = 0.0;                  // at z = 0
  std::optional<double> gel_ior = std::nullopt;  // absent: light goes straight from everywhere to everywhere
  std::vector<Layer> layers = {};                // from the gel towards the camera

  bool refracts() const { return gel_ior.has_value(); }
  /// z of the last interface, towards air.
  double back_z_m() const;
  static OpticalStack read(ConfigReader& sensor, ConfigReader& gel, double gel_thickness_m);
  /// Media from height `z_m` down to the gel's front, first the one that holds z_m. \pre z_m < −gel_thickness_m
  LayerStack from(double z_m) const;
};

/// What the gel's glued face is held by: a spring along z and one along x and y, without mass. It moves by compliance ×
/// force against the housing and takes frame S with it.
struct Mount {
  double compliance_m_per_n = 0.0;        // along z; 0: rigid
  double shear_compliance_m_per_n = 0.0;  // along x and y

  bool gives_way() const { return compliance_m_per_n > 0.0 || shear_compliance_m_per_n > 0.0; }
  /// Along x, y, z.
  Vector3 compliance() const { return {shear_compliance_m_per_n, shear_compliance_m_per_n, compliance_m_per_n}; }
  static Mount read(ConfigReader& in);
};

/// Paint on the front face as seen from inside: a Lambert part and a glossy lobe (GGX microfacets of roughness
/// `ggx_alpha`, Schlick's Fresnel from `specular_f0`).
struct Coating {
  std::array<double, 3> albedo{};
  double specular_f0 = 0.0;  // 0: no lobe
  double ggx_alpha = 1.0;

  static Coating read(ConfigReader& in);
};

/// How a light's intensity falls with the angle θ from its normal.
enum class Emission { lambertian, isotropic, cosine_power };

/// One light. Colour is linear sRGB of the group, intensity relative within the group, in the renderer's radiometric
/// unit (only ratios show after exposure).
struct Led {
  Vector3 position_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, the direction of its maximum
  std::array<double, 3> rgb{};        // linear radiant intensity along the normal, at `intensity` 1
  std::array<double, 2> size_m{};     // edge lengths of the emitter, away from the axis and across; zero for a point
  Emission emission = Emission::lambertian;
  double emission_exponent = 1.0;  // of cosine_power: I = I0 cos^m θ
  double intensity = 1.0;
  std::string group = {};  // LEDs of one name are driven together and share a colour; empty: on its own

  /// Every LED of a sensor's `leds` section: a ring pattern or a list. None may lie in the gel, nor, where light is
  /// refracted, before it.
  static std::vector<Led> read_all(ConfigReader& in, const GelShape& gel, const OpticalStack& stack);
};

/// LEDs that always shine together: one basis image, one colour.
struct LightGroup {
  std::string name = {};  // "" for an LED on its own
  std::array<double, 3> rgb{};
  std::vector<int> leds = {};
};

/// The groups in the order of their first LEDs.
std::vector<LightGroup> light_groups(const std::vector<Led>& leds);

/// A scattering ring between LEDs and gel: what passes it leaves its face as from a Lambert emitter.
struct Diffuser {
  double inner_radius_m = 0.0;
  double outer_radius_m = 0.0;
  double z_m = 0.0;            // of the face that looks at the gel
  double transmittance = 1.0;  // share of the light

  static Diffuser read(ConfigReader& in, const OpticalStack& stack, const std::vector<Led>& leds);
};

/// Camera at `position_m`. With rotation zero it looks along +z, columns grow with x and rows with y.
/// `pinhole`: x_d = f tan θ; `fisheye`: r = f θ (equidistant); `rectified`: each pixel is a point of the undeformed
/// plane z = 0 on a linear grid, seen through the layers along the refracted path (a real image after rectification).
struct Camera {
  enum class Model { pinhole, fisheye, rectified };
  Vector3 position_m = Vector3::Zero();
  int width_px = 0;
  int height_px = 0;
  double window_width_m = 0.0;  // what the middle row and column see of the plane z = 0
  double window_height_m = 0.0;
  Model model = Model::pinhole;
  Vector3 rotation_rad = Vector3::Zero();                             // about x, then y, then z of S
  std::optional<std::array<double, 4>> intrinsics_px = std::nullopt;  // fx, fy, cx, cy; absent: from the window
  std::array<double, 3> radial{};      // k1, k2, k3 of Brown's distortion (fisheye: of θ)
  std::array<double, 2> tangential{};  // p1, p2
  std::array<double, 2> vignetting{};  // v2, v4: 1 + v2 ρ² + v4 ρ⁴, ρ = 1 in the corner

  static Camera read(ConfigReader& in, const GelShape& gel, const OpticalStack& stack);
};

/// From radiance to 8-bit codes.
struct Response {
  double mean_level = 0.0;  // exposure makes the no-contact image's mean this fraction of full scale (after the curve)
  std::string curve = {};   // "srgb", "linear" or "gamma"
  double gamma = 2.2;       // of "gamma": code = v^(1/gamma)
  std::optional<double> exposure = std::nullopt;                  // fixed; else by mean_level
  std::array<double, 3> white_balance{1.0, 1.0, 1.0};             // gains of the channels
  std::array<double, 9> color_matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};  // camera from scene colours, by rows, after the gains

  static Response read(ConfigReader& in);
};

/// Noise of the photosites.
struct SensorNoise {
  double full_well_e = 0.0;  // electrons at full scale
  double read_e = 0.0;       // standard deviation of the read-out, electrons

  static SensorNoise read(ConfigReader& in);
};

/// Markers printed on the front face, in rows along x and columns along y.
struct MarkerGrid {
  int rows = 19;
  int columns = 19;
  double pitch_m = 1e-3;
  double center_x_m = 0.0;  // of the whole grid, frame S
  double center_y_m = 0.0;
  bool given = false;  // the sensor file has a section `markers`: then each must lie on the front face
  std::optional<double> radius_m = std::nullopt;  // of the printed dots; absent: positions only, nothing to draw
  std::array<double, 3> albedo{};                 // of the dots

  static MarkerGrid read(ConfigReader& in);
  /// Whether a point of the undeformed gel lies on a dot. \pre radius_m
  bool covers(double x, double y) const;
  /// Marker of a row (0 at the smallest y) and a column (0 at the smallest x) on the undeformed gel, frame S.
  double x_m(int column) const { return center_x_m + (column - 0.5 * (columns - 1)) * pitch_m; }
  double y_m(int row) const { return center_y_m + (row - 0.5 * (rows - 1)) * pitch_m; }
};

/// One value of a sensor file and where it comes from: `known`, `derived`, `guess`, or `unstated`.
struct ValueSource {
  std::string path = {};
  std::string source = {};
};

/// Colour of a light: `rgb_linear`, `cct_k` or `wavelength_nm` with `fwhm_nm`, exactly one; the last two with largest
/// channel 1 and nothing negative.
std::array<double, 3> read_light_color(ConfigReader& in);

struct Sensor {
  std::string name = {};
  GelShape gel;
  std::optional<double> friction = std::nullopt;  // coefficient of the gel's surface; absent: as whoever presses says
  Material material;
  Mount mount = {};
  OpticalStack stack;
  Coating coating;
  std::array<double, 3> ambient_rgb{};  // radiance added everywhere: the veil of internal reflections and housing
  std::vector<Led> leds = {};
  std::optional<Diffuser> diffuser = std::nullopt;
  /// Light calibrated on photographs, as changes of codes against the reference image: takes the place of leds,
  /// coating, ambient and response, which stay empty.
  std::optional<LightField> light_field = std::nullopt;
  Camera camera;
  MarkerGrid markers;
  Response response;
  std::optional<SensorNoise> noise = std::nullopt;
  std::optional<std::filesystem::path>
      reference_image;  // a real photograph without contact, relative to the sensor file
  std::vector<ValueSource> sources = {};

  static Sensor read(ConfigReader& in);
};

}  // namespace tacipc
