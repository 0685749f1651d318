#include "stages/pack/field.h"

#include <cmath>

#include "common/packed_units.h"

namespace tacipc {
namespace {

using enum NumberType;

constexpr double kNewton = 1.0;  // per newton
constexpr double kSame = 1.0;    // codes, counts, ratios, pixels, seconds
constexpr const char* kS = "S";
constexpr const char* kImage = "image";
constexpr const char* kNone = "none";

/// Reason of a missing picture: a variant without rays of its own has only what light changes.
std::string because(const SampleFrames& sample, const std::string& otherwise) {
  return sample.in_variant() ? "this variant is seen along the sensor's own rays: see obs of the sample" : otherwise;
}

template <typename Change>
FieldData changed(FieldData data, Change&& change) {
  if (auto* numbers = std::get_if<Numbers>(&data)) {
    for (double& value : numbers->values) value = change(value);
  }
  return data;
}

constexpr const char* kNoForces = "the press had left no contact forces when the images were made";

FieldData contact_picture(SampleFrames& s, std::size_t f, const char* name) {
  return s.png(f, name, 1, because(s, kNoForces));
}

/// Force per cell of traction.npy (24, 32, 2, 3): its grid lies over the camera's window in the plane z = 0. `kinds`:
/// first and last of normal [0] and friction [1], summed.
Numbers grid(SampleFrames& sample, std::size_t frame, std::size_t first, std::size_t last, bool times_area) {
  const Numbers traction = sample.press_array(frame, "traction.npy");
  const std::size_t cells = traction.shape.at(0) * traction.shape.at(1);
  const Camera& camera = sample.sensor().camera;
  const double area_m2 = camera.window_width_m * camera.window_height_m / static_cast<double>(cells);
  Numbers out{{traction.shape[0], traction.shape[1], 3}, std::vector<double>(3 * cells, 0.0)};
  for (std::size_t c = 0; c < cells; ++c) {
    for (std::size_t kind = first; kind <= last; ++kind) {
      for (std::size_t i = 0; i < 3; ++i) out.values[3 * c + i] += traction.values[6 * c + 3 * kind + i];
    }
    for (std::size_t i = 0; i < 3 && times_area; ++i) out.values[3 * c + i] *= area_m2;
  }
  return out;
}

/// Normal [0] or friction [1] force on each front vertex, (V, 3).
Numbers nodal_force(SampleFrames& sample, std::size_t frame, std::size_t kind) {
  const Numbers both = sample.press_array(frame, "contact_force.npy");
  Numbers out{{both.shape.at(0), 3}, {}};
  for (std::size_t v = 0; v < both.shape[0]; ++v) {
    for (std::size_t i = 0; i < 3; ++i) out.values.push_back(both.values[6 * v + 3 * kind + i]);
  }
  return out;
}

Numbers summed_force(SampleFrames& sample, std::size_t frame, std::size_t kind) {
  const Numbers all = nodal_force(sample, frame, kind);
  Numbers sum{{3}, {0.0, 0.0, 0.0}};
  for (std::size_t i = 0; i < all.values.size(); ++i) sum.values[i % 3] += all.values[i];
  return sum;
}

Numbers part_of_wrench(SampleFrames& sample, std::size_t frame, std::size_t first) {
  const Numbers wrench = sample.press_array(frame, "wrench.npy");
  const auto begin = wrench.values.begin() + static_cast<std::ptrdiff_t>(first);
  return {{3}, {begin, begin + 3}};
}

/// x, y, z in mm, then the unit quaternion x, y, z, w with w ≥ 0.
Numbers pose(SampleFrames& sample, std::size_t frame) {
  const Numbers matrix = sample.press_array(frame, "object_pose.npy");
  const Matrix4 s_from_object = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.values.data());
  Eigen::Quaterniond q(Matrix3(s_from_object.topLeftCorner<3, 3>()));
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Vector3 at = kMmPerM * s_from_object.topRightCorner<3, 1>();
  return {{7}, {at.x(), at.y(), at.z(), q.x(), q.y(), q.z(), q.w()}};
}

FieldData marker_px(SampleFrames& s, std::size_t f) {
  const std::string reason = because(s, "the press tracks no markers");
  FieldData reference = s.marker_px(0, reason), current = s.marker_px(f, reason);
  if (!std::holds_alternative<Numbers>(reference) || !std::holds_alternative<Numbers>(current)) return reference;
  Numbers& both = std::get<Numbers>(reference);
  const Numbers& now = std::get<Numbers>(current);
  both.values.insert(both.values.end(), now.values.begin(), now.values.end());
  both.shape.insert(both.shape.begin(), 2);
  return reference;
}

FieldData marker_visible(SampleFrames& s, std::size_t f) {
  FieldData px = s.marker_px(f, because(s, "the press tracks no markers"));
  if (auto* numbers = std::get_if<Numbers>(&px)) {
    Numbers seen{{numbers->shape.at(0)}, {}};
    for (std::size_t m = 0; m < numbers->shape[0]; ++m)
      seen.values.push_back(std::isnan(numbers->values[2 * m]) ? 0.0 : 1.0);
    return seen;
  }
  return px;
}

/// Codes of segment.png are 0 beside the gel, 60 gel, 120 contact, 180 marker, 240 marker in contact.
double segment(double code) { return code == 0.0 ? 2.0 : code >= 180.0 ? 1.0 : 0.0; }

Numbers scalar(double value) { return {{}, {value}}; }

/// A line of the press record's `per_frame`.
auto judged(const char* key) {
  return [key](SampleFrames& s, std::size_t f) -> FieldData { return scalar(s.press_number(f, key)); };
}

/// An array of the press as it is.
auto pressed(const char* file) {
  return [file](SampleFrames& s, std::size_t f) -> FieldData { return s.press_array(f, file); };
}

const std::string kPhases =
    "0 reference, 1 approach, 2 press, 3 shear, 4 twist, 5 hold, 6 release, 7 tilt, 8 path, 9 load";

std::vector<Field> observations() {
  constexpr auto kObs = Section::obs;
  return {
      {kObs, "rgb", u8, "(T,H,W,3)", "code", kImage, kNone,
       "tactile image, RGB, row 0 on top, as the camera's response curve encodes it; frame 0 is the reference image",
       "render: tactile.png", kSame,
       [](SampleFrames& s, std::size_t f) { return s.png(f, "tactile.png", 3, "no image"); }, true},
      {kObs, "rgb_marker", u8, "(T,H,W,3)", "code", kImage, kNone, "the same with the printed markers",
       "render: marker.png", kSame,
       [](SampleFrames& s, std::size_t f) { return s.png(f, "marker.png", 3, "the sensor prints no markers"); }, true},
      {kObs, "radiance", f16, "(T,H,W,3)", "relative", kImage, kNone,
       "radiance before exposure, response curve and noise, linear sRGB primaries", "render: linear.exr", kSame,
       [](SampleFrames& s, std::size_t f) {
         return s.exr(f, "linear.exr", {"R", "G", "B"}, "no image");
       },
       true},
      {kObs, "indentation_mm", f32, "(T,H,W)", "mm", kS, "positive into the gel (along -z of S)",
       "undeformed minus deformed height of the gel point a pixel sees; NaN beside the gel", "render: indentation.exr",
       kMmPerM, [](SampleFrames& s, std::size_t f) { return s.exr(f, "indentation.exr", {"Y"}, because(s, "no map")); },
       true},
      {kObs, "camera_depth_mm", f32, "(T,H,W)", "mm", "camera", "positive away from the camera",
       "distance from the camera to the gel's front along the optical axis; NaN beside the gel", "render: depth.exr",
       kMmPerM, [](SampleFrames& s, std::size_t f) { return s.exr(f, "depth.exr", {"Z"}, because(s, "no map")); },
       true},
      {kObs, "normal", f16, "(T,H,W,3)", "1", kS, "outward: (0, 0, 1) where the gel is flat",
       "unit normal of the deformed front; NaN beside the gel", "render: normal.exr", kSame,
       [](SampleFrames& s, std::size_t f) {
         return s.exr(f, "normal.exr", {"X", "Y", "Z"}, because(s, "no map"));
       },
       true},
      {kObs,
       "contact_mask",
       u8,
       "(T,H,W)",
       "code",
       kImage,
       kNone,
       "whether the object pushes on the gel where a pixel looks (its nearest vertex carries contact force)",
       "render: contact.png",
       kSame,
       [](SampleFrames& s, std::size_t f) {
         return changed(contact_picture(s, f, "contact.png"), [](double v) { return v > 0.0 ? 1.0 : 0.0; });
       },
       true,
       true,
       {{"codes", "0 no contact, 1 contact"}}},
      {kObs,
       "slip_state",
       u8,
       "(T,H,W)",
       "code",
       kImage,
       kNone,
       "whether the gel sticks to the object or slides along it, of the vertex nearest to what a pixel sees",
       "render: stick_slip.png",
       kSame,
       [](SampleFrames& s, std::size_t f) {
         return changed(contact_picture(s, f, "stick_slip.png"), [](double v) { return v / 127.0; });
       },
       true,
       true,
       {{"codes", "0 no contact, 1 sticks, 2 slips"}}},
      {kObs,
       "segmentation",
       u8,
       "(T,H,W)",
       "code",
       kImage,
       kNone,
       "what a pixel shows",
       "render: segment.png",
       kSame,
       [](SampleFrames& s, std::size_t f) {
         return changed(s.png(f, "segment.png", 1, because(s, "no map")), segment);
       },
       true,
       true,
       {{"codes", "0 gel, 1 marker, 2 beside the gel"}}},
      {kObs, "force_field_N", f32, "(T,h,w,3)", "N", kS, "force on the gel by the object",
       "contact force per cell of a regular grid over the camera's window in the plane z = 0 (row 0 at the smallest y, "
       "column 0 at the smallest x); sums to the force on the front vertices inside the window",
       "press: traction.npy times the cell's area", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return grid(s, f, 0, 1, true); }},
      {kObs, "force_field_normal_N", f32, "(T,h,w,3)", "N", kS, "force on the gel by the object",
       "the part of force_field_N that pushes the surfaces apart (the contact barrier's)",
       "press: traction.npy times the cell's area", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return grid(s, f, 0, 0, true); }},
      {kObs, "force_field_friction_N", f32, "(T,h,w,3)", "N", kS, "force on the gel by the object",
       "the part of force_field_N that resists sliding", "press: traction.npy times the cell's area", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return grid(s, f, 1, 1, true); }},
      {kObs, "traction_Nmm2", f32, "(T,h,w,3)", "N/mm^2", kS, "force on the gel by the object",
       "force_field_N per area of the cell, in the plane (not along the slope)", "press: traction.npy", kNPerMm2PerPa,
       [](SampleFrames& s, std::size_t f) -> FieldData { return grid(s, f, 0, 1, false); }},
      {kObs, "force_N", f32, "(T,3)", "N", kS, "force on the gel by the object: a press has z < 0",
       "resultant contact force, wherever the object touches the gel", "press: wrench.npy", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return part_of_wrench(s, f, 0); }},
      {kObs, "torque_Nmm", f32, "(T,3)", "N mm", kS, "torque on the gel by the object, right-handed",
       "resultant torque about the origin of S", "press: wrench.npy", kNmmPerNm,
       [](SampleFrames& s, std::size_t f) -> FieldData { return part_of_wrench(s, f, 3); }},
      {kObs, "normal_force_N", f32, "(T,3)", "N", kS, "force on the gel by the object",
       "sum of the normal forces on the gel's front", "press: contact_force.npy", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return summed_force(s, f, 0); }},
      {kObs, "friction_force_N", f32, "(T,3)", "N", kS, "force on the gel by the object",
       "sum of the friction forces on the gel's front", "press: contact_force.npy", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return summed_force(s, f, 1); }},
      {kObs, "press_force_N", f32, "(T)", "N", kS, "positive when the object pushes into the gel",
       "-z component of force_N", "press: record", kNewton, judged("press_force_n")},
      {kObs, "marker_px", f32, "(T,2,N,2)", "px", kImage, "x right, y down; pixel (0, 0) spans 0 to 1",
       "column and row of each marker in frame 0 [0] and now [1]; NaN where the image does not show it",
       "render: marker_px.npy", kSame, marker_px, true},
      {kObs, "marker_mm", f32, "(T,N,3)", "mm", kS, "coordinates in S", "markers on the deformed front",
       "press: markers.npy", kMmPerM, pressed("markers.npy")},
      {kObs,
       "marker_visible",
       u8,
       "(T,N)",
       "code",
       kImage,
       kNone,
       "whether the image shows a marker",
       "render: marker_px.npy",
       kSame,
       marker_visible,
       true,
       true,
       {{"codes", "0 not seen, 1 seen"}}},
      {kObs,
       "object_pose",
       f32,
       "(T,7)",
       "mm and 1",
       kS,
       "S from the object's own frame",
       "position x, y, z in mm, then unit quaternion x, y, z, w (scalar last, never negative)",
       "press: object_pose.npy",
       kSame,
       [](SampleFrames& s, std::size_t f) -> FieldData { return pose(s, f); },
       false,
       true,
       {{"quat_order", "xyzw"}}},
      {kObs, "time_s", f64, "(T)", "s", kNone, kNone, "time of the frame, 0 at the first", "press: time.npy", kSame,
       pressed("time.npy")},
      {kObs,
       "phase",
       u8,
       "(T)",
       "code",
       kNone,
       kNone,
       "part of the motion that the frame ends or lies in",
       "press: phase.npy",
       kSame,
       pressed("phase.npy"),
       false,
       true,
       {{"codes", kPhases}}},
      {kObs, "frame", i32, "(T)", "count", kNone, kNone,
       "number of the frame in the press (not all need have been rendered)", "render: record", kSame,
       [](SampleFrames&, std::size_t f) -> FieldData { return scalar(static_cast<double>(f)); }}};
}

std::vector<Field> simulated() {
  constexpr auto kSim = Section::sim;
  return {
      {kSim, "surface_vertices_mm", f32, "(T,V,3)", "mm", kS, "coordinates in S", "vertices of the deformed front",
       "press: positions.npy, front_vertices.npy", kMmPerM,
       [](SampleFrames& s, std::size_t f) -> FieldData { return s.front_positions(f); }},
      {kSim, "surface_triangles", i32, "(F,3)", "count", kNone, "counter-clockwise seen from the object",
       "triangles of the front, rows of surface_vertices_mm", "tetmesh: gel.msh", kSame,
       [](SampleFrames& s, std::size_t) -> FieldData { return s.front_triangles(); }, false, false},
      {kSim, "nodal_force_normal_N", f32, "(T,V,3)", "N", kS, "force on the gel by the object",
       "normal force on each front vertex", "press: contact_force.npy", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return nodal_force(s, f, 0); }},
      {kSim, "nodal_force_friction_N", f32, "(T,V,3)", "N", kS, "force on the gel by the object",
       "friction force on each front vertex", "press: contact_force.npy", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return nodal_force(s, f, 1); }},
      {kSim,
       "nodal_contact_state",
       u8,
       "(T,V)",
       "code",
       kNone,
       kNone,
       "contact of each front vertex",
       "press: contact_state.npy",
       kSame,
       pressed("contact_state.npy"),
       false,
       true,
       {{"codes", "0 no contact, 1 sticks, 2 slips"}}},
      {kSim, "first_slip_s", f32, "(V)", "s", kNone, kNone,
       "time of the first frame of the press in which a front vertex slips, +inf where none does",
       "press: first_slip.npy", kSame,
       [](SampleFrames& s, std::size_t) -> FieldData { return s.whole_press_array("first_slip.npy"); }, false, false}};
}

std::vector<Field> checks() {
  const auto line = [](const char* name, NumberType type, const char* unit, const char* sign, const char* meaning,
                       double scale, const char* key) {
    return Field{Section::check, name, type, "(T)", unit, kNone, sign, meaning, "press: record", scale, judged(key)};
  };
  return {line("min_distance_mm", f32, "mm", "positive: apart", "smallest gap between gel and object", kMmPerM,
               "min_gap_m"),
          line("stand_off_mm", f32, "mm", "positive: apart",
               "mean gap of what touches, weighted by force: how far the contact barrier keeps the surfaces apart",
               kMmPerM, "stand_off_m"),
          line("min_volume_ratio", f32, "1", "positive: not inverted",
               "smallest deformed over undeformed volume of a tetrahedron", kSame, "min_volume_ratio"),
          line("intersections", i32, "count", kNone, "pairs of triangles that intersect, by exact test", kSame,
               "intersections"),
          line("inverted_tets", i32, "count", kNone, "inverted tetrahedra, by exact test", kSame, "inverted_tets"),
          line("newton_iterations", i32, "count", kNone, "Newton iterations since the frame before", kSame,
               "newton_iterations"),
          line("velocity_residual_mm_s", f32, "mm/s", kNone, "last Newton step over the time step", kMmPerM,
               "velocity_residual_m_s"),
          line("force_residual_N", f32, "N", kNone, "forces left out of balance, summed as lengths", kNewton,
               "force_residual_n"),
          line("friction_residual_N", f32, "N", kNone, "how far friction is from that of its own contact forces",
               kNewton, "friction_residual_n"),
          line("force_balance_rel", f32, "1", kNone,
               "contact, inertia, damping, gravity and mount summed, over the contact force (at least 0.01 N)", kSame,
               "balance_relative"),
          line("force_balance_N", f32, "N", kNone, "the same sum", kNewton, "balance_n"),
          line("pose_error_mm", f32, "mm", kNone, "largest distance of the object from where its motion puts it",
               kMmPerM, "pose_error_m"),
          line("contact_area_mm2", f32, "mm^2", kNone, "area of the front that carries contact force", kSame,
               "contact_area_mm2"),
          line("sticking", i32, "count", kNone, "front vertices that stick", kSame, "sticking"),
          line("slipping", i32, "count", kNone, "front vertices that slip", kSame, "slipping")};
}

}  // namespace

const char* name_of(Section section) {
  switch (section) {
    case Section::obs:
      return "obs";
    case Section::sim:
      return "sim";
    case Section::check:
      return "check";
  }
  return "";
}

const std::vector<Field>& fields() {
  static const std::vector<Field> kFields = [] {
    std::vector<Field> all = observations();
    for (auto part : {simulated(), checks()}) all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return kFields;
}

Value::Map attributes_of(const Field& field) {
  Value::Map lines{{"dtype", name_of(field.type)}, {"shape", field.shape}, {"unit", field.unit},
                   {"frame", field.frame},         {"sign", field.sign},   {"meaning", field.meaning},
                   {"source", field.source}};
  for (const auto& [name, text] : field.more) lines.emplace_back(name, text);
  return lines;
}

}  // namespace tacipc
