#include "stages/dataset/pack/field.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/base/packed_units.h"
#include "common/base/rounding.h"

namespace tacipc {
namespace {

using enum NumberType;

constexpr double kNewton = 1.0;  // per newton
constexpr double kSame = 1.0;    // codes, counts, ratios, pixels, seconds
constexpr const char* kS = "S";
constexpr int kStepOfMm = -13, kStepOfNormals = -12;  // 0.12 µm; 0.014°
constexpr const char* kImage = "image";
constexpr const char* kNone = "none";

/// Reason of a missing picture: a variant without rays of its own has only what light changes.
std::string because(const SampleFrames& sample, const std::string& otherwise) {
  return sample.in_variant() ? "this variant is seen along the sensor's own rays: see obs of the sample" : otherwise;
}

/// Other codes for those of an image. \throw DataError if one of them has none
template <typename Change>
FieldData changed(FieldData data, Change&& change) {
  if (auto* image = std::get_if<ByteImage>(&data)) {
    std::array<std::optional<std::uint8_t>, 256> known;
    for (std::uint8_t& value : image->pixels) {
      std::optional<std::uint8_t>& code = known[value];
      if (!code) code = static_cast<std::uint8_t>(change(value));
      value = *code;
    }
  }
  return data;
}

constexpr const char* kNotWanted = "the dataset's maps leave it out";
constexpr const char* kNoForces = "the press had left no contact forces when the images were made";

/// Without a choice of maps render leaves out only what there is not.
std::string not_wanted_or(const SampleFrames& s, const char* reason) {
  return s.render().section("inputs").has("maps") ? fmt::format("{}, or {}", kNotWanted, reason) : reason;
}

FieldData contact_picture(SampleFrames& s, std::size_t f, FrameFile file) {
  return s.image(f, file, because(s, not_wanted_or(s, kNoForces)));
}

Numbers numbers_of(const Positions& rows) {
  return {{static_cast<std::size_t>(rows.rows()), 3}, {rows.data(), rows.data() + rows.size()}};
}

Numbers numbers_of(const Vector3& v) { return {{3}, {v.begin(), v.end()}}; }

Numbers scalar(double value) { return {{}, {value}}; }

/// Normal or friction.
using Part = Positions ContactParts::*;

/// Sum of these parts of the traction, times a factor, on each cell of a grid over the camera's window.
Numbers traction_grid(SampleFrames& sample, std::size_t frame, std::initializer_list<Part> parts, double factor) {
  const ContactParts traction = sample.arrays().tractions(frame);
  Positions sum = Positions::Zero(traction.normal.rows(), 3);
  for (const Part part : parts) sum += traction.*part;
  Numbers out = numbers_of(Positions(sum * factor));
  out.shape = {kTractionRows, kTractionColumns, 3};
  return out;
}

Numbers force_grid(SampleFrames& sample, std::size_t frame, std::initializer_list<Part> parts) {
  const Camera& camera = sample.sensor().camera;
  const double cell_area_m2 =
      camera.window_width_m * camera.window_height_m / static_cast<double>(kTractionRows * kTractionColumns);
  return traction_grid(sample, frame, parts, cell_area_m2);
}

constexpr Part kNormal = &ContactParts::normal, kFriction = &ContactParts::friction;

/// Force on each front vertex, (V, 3).
Numbers nodal_force(SampleFrames& sample, std::size_t frame, Part part) {
  return numbers_of(sample.arrays().contact_forces(frame).*part);
}

Numbers summed_force(SampleFrames& sample, std::size_t frame, Part part) {
  const Positions all = sample.arrays().contact_forces(frame).*part;
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index v = 0; v < all.rows(); ++v) sum += all.row(v).transpose();
  return numbers_of(sum);
}

/// x, y, z in mm, then the unit quaternion x, y, z, w with w ≥ 0.
Numbers pose_numbers(const Matrix4& pose) {
  Eigen::Quaterniond q(Matrix3(pose.topLeftCorner<3, 3>()));
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Vector3 at = kMmPerM * pose.topRightCorner<3, 1>();
  return {{7}, {at.x(), at.y(), at.z(), q.x(), q.y(), q.z(), q.w()}};
}

Numbers pose(SampleFrames& sample, std::size_t frame) { return pose_numbers(sample.arrays().poses()[frame]); }

/// A frame of poses of the grasp, 7 numbers each.
Numbers world_poses(SampleFrames& sample, std::size_t frame, GraspArray array) {
  const auto poses = items_of<Matrix4>(sample.grasp_arrays().frame_of(field_of(array), frame));
  Numbers all{{poses.size(), 7}, {}};
  if (poses.size() == 1) all.shape = {7};
  for (const Matrix4& world_from : poses) {
    const Numbers one = pose_numbers(world_from);
    all.values.insert(all.values.end(), one.values.begin(), one.values.end());
  }
  return all;
}

/// Of both fingers, by their forces and states on each front vertex in this frame.
Numbers of_fingers(SampleFrames& sample, std::size_t frame, double (*measure)(const FingerFront&)) {
  Numbers both{{2}, {}};
  for (const std::size_t side : {0, 1}) both.values.push_back(measure(sample.finger_front(side, frame)));
  return both;
}

double normal_force(const FingerFront& front) { return front.normal_n.sum(); }

double slipping_force(const FingerFront& front) {
  double sum = 0.0;
  for (std::size_t v = 0; v < front.states.size(); ++v)
    if (front.states[v] == ContactState::slip) sum += front.normal_n[static_cast<Eigen::Index>(v)];
  return sum;
}

FieldData twist(SampleFrames& sample, std::size_t frame, Vector3 Twist::*part) {
  if (!sample.arrays().has(PressArray::object_twist)) return Absent{"the object moves as prescribed"};
  return numbers_of(sample.arrays().twists()[frame].*part);
}

FieldData of_grasp(SampleFrames& sample, std::size_t frame, double GraspFrameLines::*number) {
  if (!sample.grasp()) return Absent{"no grasp"};
  return scalar(sample.grasp_number(frame, number));
}

Numbers front_positions(SampleFrames& sample, std::size_t frame) {
  return numbers_of(Positions(sample.arrays().positions(frame)(sample.arrays().front_vertices(), Eigen::all)));
}

Numbers contact_states(SampleFrames& sample, std::size_t frame) {
  const std::vector<ContactState> states = sample.arrays().contact_states(frame);
  Numbers numbers{{states.size()}, {}};
  for (const ContactState state : states) numbers.values.push_back(static_cast<double>(state));
  return numbers;
}

Numbers first_slips(SampleFrames& sample) {
  std::vector<double> times_s = sample.arrays().first_slips();
  return {{times_s.size()}, std::move(times_s)};
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

/// Its own codes, of what segment.png shows.
double segment(double code) {
  const Segment seen = segment_of(code);
  if (seen == Segment::beside) return 2.0;
  return seen == Segment::marker || seen == Segment::marker_in_contact ? 1.0 : 0.0;
}

/// A line of the press record's `per_frame`.
template <typename T>
auto judged(T PressFrameLines::*number) {
  return [number](SampleFrames& s, std::size_t f) -> FieldData { return scalar(s.press_number(f, number)); };
}

std::string source_of(FrameFile file) { return "render: " + field_of(file).file; }

std::string source_of(PressArray array) { return "press: " + field_of(array).file; }

std::string source_of(GraspArray array) { return "press: " + field_of(array).file + " of the grasp"; }

std::string phase_codes() {
  std::string codes;
  for (std::size_t k = 0; k < kPhaseNames.size(); ++k)
    codes += fmt::format("{}{} {}", k > 0 ? ", " : "", k, kPhaseNames[k]);
  return codes;
}

/// Of slip_state and nodal_contact_state.
std::string slip_codes() {
  using enum ContactState;
  return fmt::format("{:d} no contact, {:d} sticks, {:d} slips", static_cast<int>(none), static_cast<int>(stick),
                     static_cast<int>(slip));
}

/// Of the group's frames, (T) or (P).
Field time_field(Section group, const char* shape) {
  return {group,
          "time_s",
          f64,
          shape,
          "s",
          kNone,
          kNone,
          "time of the frame, 0 at the first",
          source_of(PressArray::time),
          kSame,
          [](SampleFrames& s, std::size_t f) -> FieldData { return scalar(s.arrays().times()[f]); }};
}
Field phase_field(Section group, const char* shape) {
  return {
      group,
      "phase",
      u8,
      shape,
      "code",
      kNone,
      kNone,
      "part of the motion that the frame ends or lies in",
      source_of(PressArray::phase),
      kSame,
      [](SampleFrames& s, std::size_t f) -> FieldData { return scalar(static_cast<double>(s.arrays().phases()[f])); },
      false,
      true,
      {{"codes", phase_codes()}}};
}

std::vector<Field> observations() {
  constexpr auto kObs = Section::obs;
  return {
      {kObs, "rgb", u8, "(T,H,W,3)", "code", kImage, kNone,
       "tactile image, RGB, row 0 on top, as the camera's response curve encodes it; frame 0 is the reference image",
       source_of(FrameFile::tactile), kSame,
       [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::tactile, "no image"); }, true},
      {kObs, "rgb_marker", u8, "(T,H,W,3)", "code", kImage, kNone, "the same with the printed markers",
       source_of(FrameFile::marker), kSame,
       [](SampleFrames& s, std::size_t f) {
         return s.image(f, FrameFile::marker,
                        s.sensor().markers.radius_m ? kNotWanted : "the sensor prints no markers");
       },
       true},
      {kObs, "radiance", f16, "(T,H,W,3)", "relative", kImage, kNone,
       "radiance before exposure, response curve and noise, linear sRGB primaries", source_of(FrameFile::linear), kSame,
       [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::linear, kNotWanted); }, true},
      {kObs,
       "indentation_mm",
       f32,
       "(T,H,W)",
       "mm",
       kS,
       "positive into the gel (along -z of S)",
       "undeformed minus deformed height of the gel point a pixel sees; NaN beside the gel",
       source_of(FrameFile::indentation),
       kMmPerM,
       [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::indentation, because(s, kNotWanted)); },
       true,
       true,
       {},
       kStepOfMm},
      {kObs,
       "camera_depth_mm",
       f32,
       "(T,H,W)",
       "mm",
       "camera",
       "positive away from the camera",
       "distance from the camera to the gel's front along the optical axis; NaN beside the gel",
       source_of(FrameFile::depth),
       kMmPerM,
       [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::depth, because(s, kNotWanted)); },
       true,
       true,
       {},
       kStepOfMm},
      {kObs,
       "normal",
       f16,
       "(T,H,W,3)",
       "1",
       kS,
       "outward: (0, 0, 1) where the gel is flat",
       "unit normal of the deformed front; NaN beside the gel",
       source_of(FrameFile::normal),
       kSame,
       [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::normal, because(s, kNotWanted)); },
       true,
       true,
       {},
       kStepOfNormals},
      {kObs,
       "contact_mask",
       u8,
       "(T,H,W)",
       "code",
       kImage,
       kNone,
       "whether the object pushes on the gel where a pixel looks (its nearest vertex carries contact force)",
       source_of(FrameFile::contact),
       kSame,
       [](SampleFrames& s, std::size_t f) {
         return changed(contact_picture(s, f, FrameFile::contact),
                        [](double code) { return touches(code) ? 1.0 : 0.0; });
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
       source_of(FrameFile::stick_slip),
       kSame,
       [](SampleFrames& s, std::size_t f) {
         return changed(contact_picture(s, f, FrameFile::stick_slip),
                        [](double code) { return static_cast<double>(state_of(code)); });
       },
       true,
       true,
       {{"codes", slip_codes()}}},
      {kObs,
       "segmentation",
       u8,
       "(T,H,W)",
       "code",
       kImage,
       kNone,
       "what a pixel shows",
       source_of(FrameFile::segment),
       kSame,
       [](SampleFrames& s, std::size_t f) {
         return changed(s.image(f, FrameFile::segment, because(s, kNotWanted)), segment);
       },
       true,
       true,
       {{"codes", "0 gel, 1 marker, 2 beside the gel"}}},
      {kObs, "force_field_N", f32, "(T,h,w,3)", "N", kS, "force on the gel by the object",
       "contact force per cell of a regular grid over the camera's window in the plane z = 0 (row 0 at the smallest y, "
       "column 0 at the smallest x); sums to the force on the front vertices inside the window",
       source_of(PressArray::traction) + " times the cell's area", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData {
         return force_grid(s, f, {kNormal, kFriction});
       }},
      {kObs, "force_field_normal_N", f32, "(T,h,w,3)", "N", kS, "force on the gel by the object",
       "the part of force_field_N that pushes the surfaces apart (the contact barrier's)",
       source_of(PressArray::traction) + " times the cell's area", kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return force_grid(s, f, {kNormal}); }},
      {kObs, "force_field_friction_N", f32, "(T,h,w,3)", "N", kS, "force on the gel by the object",
       "the part of force_field_N that resists sliding", source_of(PressArray::traction) + " times the cell's area",
       kNewton, [](SampleFrames& s, std::size_t f) -> FieldData { return force_grid(s, f, {kFriction}); }},
      {kObs, "traction_Nmm2", f32, "(T,h,w,3)", "N/mm^2", kS, "force on the gel by the object",
       "force_field_N per area of the cell, in the plane (not along the slope)", source_of(PressArray::traction),
       kNPerMm2PerPa,
       [](SampleFrames& s, std::size_t f) -> FieldData {
         return traction_grid(s, f, {kNormal, kFriction}, 1.0);
       }},
      {kObs, "force_N", f32, "(T,3)", "N", kS, "force on the gel by the object: a press has z < 0",
       "resultant contact force, wherever the object touches the gel", source_of(PressArray::wrench), kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return numbers_of(s.arrays().wrenches()[f].force_n); }},
      {kObs, "torque_Nmm", f32, "(T,3)", "N mm", kS, "torque on the gel by the object, right-handed",
       "resultant torque about the origin of S", source_of(PressArray::wrench), kNmmPerNm,
       [](SampleFrames& s, std::size_t f) -> FieldData { return numbers_of(s.arrays().wrenches()[f].torque_n_m); }},
      {kObs, "normal_force_N", f32, "(T,3)", "N", kS, "force on the gel by the object",
       "sum of the normal forces on the gel's front", source_of(PressArray::contact_force), kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return summed_force(s, f, kNormal); }},
      {kObs, "friction_force_N", f32, "(T,3)", "N", kS, "force on the gel by the object",
       "sum of the friction forces on the gel's front", source_of(PressArray::contact_force), kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData { return summed_force(s, f, kFriction); }},
      {kObs, "press_force_N", f32, "(T)", "N", kS, "positive when the object pushes into the gel",
       "-z component of force_N", "press: record", kNewton, judged(&PressFrameLines::press_force_n)},
      {kObs, "marker_px", f32, "(T,2,N,2)", "px", kImage, "x right, y down; pixel (0, 0) spans 0 to 1",
       "column and row of each marker in frame 0 [0] and now [1]; NaN where the image does not show it",
       "render: " + marker_px_field().file, kSame, marker_px, true},
      {kObs, "marker_mm", f32, "(T,N,3)", "mm", kS, "coordinates in S", "markers on the deformed front",
       source_of(PressArray::markers), kMmPerM,
       [](SampleFrames& s, std::size_t f) -> FieldData { return numbers_of(s.arrays().markers(f)); }},
      {kObs,
       "marker_visible",
       u8,
       "(T,N)",
       "code",
       kImage,
       kNone,
       "whether the image shows a marker",
       "render: " + marker_px_field().file,
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
       source_of(PressArray::object_pose),
       kSame,
       [](SampleFrames& s, std::size_t f) -> FieldData { return pose(s, f); },
       false,
       true,
       {{"quat_order", "xyzw"}}},
      {kObs, "object_velocity_mm_s", f32, "(T,3)", "mm/s", kS, "along the axes of S",
       "velocity of the object's centre of mass in the world, for a finger of a grasp too",
       source_of(PressArray::object_twist), kMmPerM,
       [](SampleFrames& s, std::size_t f) -> FieldData { return twist(s, f, &Twist::velocity_m_s); }},
      {kObs, "object_spin_rad_s", f32, "(T,3)", "rad/s", kS, "right-handed, along the axes of S",
       "angular velocity of the object in the world", source_of(PressArray::object_twist), kSame,
       [](SampleFrames& s, std::size_t f) -> FieldData { return twist(s, f, &Twist::spin_rad_s); }},
      {kObs, "slip_mm", f32, "(T)", "mm", kNone, kNone,
       "displacement of the object's point at the grip, relative to the hand, since the fingers have closed",
       "press: record of the grasp", kMmPerM,
       [](SampleFrames& s, std::size_t f) -> FieldData { return of_grasp(s, f, &GraspFrameLines::slip_m); }},
      {kObs, "turn_deg", f32, "(T)", "deg", kNone, kNone,
       "angle by which the object has turned relative to the hand since the fingers have closed",
       "press: record of the grasp", kDegPerRad,
       [](SampleFrames& s, std::size_t f) -> FieldData { return of_grasp(s, f, &GraspFrameLines::turn_rad); }},
      {kObs, "slip_share", f32, "(T)", "1", kNone, kNone,
       "part of the finger's normal force that is on vertices that slip; 0 where it does not touch",
       "press: record of the grasp", kSame,
       [](SampleFrames& s, std::size_t f) -> FieldData {
         return of_grasp(s, f,
                         s.is_right_finger() ? &GraspFrameLines::slip_share_right : &GraspFrameLines::slip_share_left);
       }},
      time_field(kObs, "(T)"),
      phase_field(kObs, "(T)"),
      {kObs, "frame", i32, "(T)", "count", kNone, kNone,
       "number of the frame in the press (not all need have been rendered)", "render: record", kSame,
       [](SampleFrames&, std::size_t f) -> FieldData { return scalar(static_cast<double>(f)); }}};
}

std::vector<Field> simulated() {
  constexpr auto kSim = Section::sim;
  return {{kSim, "surface_vertices_mm", f32, "(T,V,3)", "mm", kS, "coordinates in S", "vertices of the deformed front",
           source_of(PressArray::positions) + ", " + field_of(PressArray::front_vertices).file, kMmPerM,
           [](SampleFrames& s, std::size_t f) -> FieldData { return front_positions(s, f); }},
          {kSim, "surface_triangles", i32, "(F,3)", "count", kNone, "counter-clockwise seen from the object",
           "triangles of the front, rows of surface_vertices_mm", "tetmesh: gel.msh", kSame,
           [](SampleFrames& s, std::size_t) -> FieldData { return s.front_triangles(); }, false, false},
          {kSim, "nodal_force_normal_N", f32, "(T,V,3)", "N", kS, "force on the gel by the object",
           "normal force on each front vertex", source_of(PressArray::contact_force), kNewton,
           [](SampleFrames& s, std::size_t f) -> FieldData { return nodal_force(s, f, kNormal); }},
          {kSim, "nodal_force_friction_N", f32, "(T,V,3)", "N", kS, "force on the gel by the object",
           "friction force on each front vertex", source_of(PressArray::contact_force), kNewton,
           [](SampleFrames& s, std::size_t f) -> FieldData { return nodal_force(s, f, kFriction); }},
          {kSim,
           "nodal_contact_state",
           u8,
           "(T,V)",
           "code",
           kNone,
           kNone,
           "contact of each front vertex",
           source_of(PressArray::contact_state),
           kSame,
           [](SampleFrames& s, std::size_t f) -> FieldData { return contact_states(s, f); },
           false,
           true,
           {{"codes", slip_codes()}}},
          {kSim, "first_slip_s", f32, "(V)", "s", kNone, kNone,
           "time of the first frame of the press in which a front vertex slips, +inf where none does",
           source_of(PressArray::first_slip), kSame,
           [](SampleFrames& s, std::size_t) -> FieldData { return first_slips(s); }, false, false}};
}

std::vector<Field> checks() {
  using L = PressFrameLines;
  const auto line = [](const char* name, NumberType type, const char* unit, const char* sign, const char* meaning,
                       double scale, auto number) {
    return Field{Section::check, name, type, "(T)", unit, kNone, sign, meaning, "press: record", scale, judged(number)};
  };
  return {line("min_distance_mm", f32, "mm", "positive: apart", "smallest gap between gel and object", kMmPerM,
               &L::min_gap_m),
          line("stand_off_mm", f32, "mm", "positive: apart",
               "mean gap of what touches, weighted by force: how far the contact barrier keeps the surfaces apart",
               kMmPerM, &L::stand_off_m),
          line("min_volume_ratio", f32, "1", "positive: not inverted",
               "smallest deformed over undeformed volume of a tetrahedron", kSame, &L::min_volume_ratio),
          line("intersections", i32, "count", kNone, "pairs of triangles that intersect, by exact test", kSame,
               &L::intersections),
          line("inverted_tets", i32, "count", kNone, "inverted tetrahedra, by exact test", kSame, &L::inverted_tets),
          line("newton_iterations", i32, "count", kNone, "Newton iterations since the frame before", kSame,
               &L::newton_iterations),
          line("velocity_residual_mm_s", f32, "mm/s", kNone, "last Newton step over the time step", kMmPerM,
               &L::velocity_residual_m_s),
          line("force_residual_N", f32, "N", kNone, "forces left out of balance, summed as lengths", kNewton,
               &L::force_residual_n),
          line("friction_residual_N", f32, "N", kNone, "how far friction is from that of its own contact forces",
               kNewton, &L::friction_residual_n),
          line("force_balance_rel", f32, "1", kNone,
               "contact, inertia, damping, gravity and mount summed, over the contact force (at least 0.01 N)", kSame,
               &L::balance_relative),
          line("force_balance_N", f32, "N", kNone, "the same sum", kNewton, &L::balance_n),
          line("pose_error_mm", f32, "mm", kNone, "largest distance of the object from where its motion puts it",
               kMmPerM, &L::pose_error_m),
          line("contact_area_mm2", f32, "mm^2", kNone, "area of the front that carries contact force", kSame,
               &L::contact_area_mm2),
          line("sticking", i32, "count", kNone, "front vertices that stick", kSame, &L::sticking),
          line("slipping", i32, "count", kNone, "front vertices that slip", kSame, &L::slipping)};
}

/// Of a grasp, in every frame of the press: what its labels follow from.
std::vector<Field> series() {
  constexpr auto kSeries = Section::series;
  constexpr const char* kWorld = "world";
  const auto sum = [](const char* name, const char* unit, const char* meaning, double scale,
                      double (*measure)(const FingerFront&)) {
    return Field{
        kSeries,
        name,
        f64,
        "(P,2)",
        unit,
        kNone,
        kNone,
        meaning,
        source_of(PressArray::contact_force) + ", " + field_of(PressArray::contact_state).file + " of both fingers",
        scale,
        [measure](SampleFrames& s, std::size_t f) -> FieldData { return of_fingers(s, f, measure); }};
  };
  const auto poses = [](const char* name, const char* shape, const char* sign, const char* meaning, GraspArray array) {
    return Field{kSeries,
                 name,
                 f64,
                 shape,
                 "mm and 1",
                 kWorld,
                 sign,
                 meaning,
                 source_of(array),
                 kSame,
                 [=](SampleFrames& s, std::size_t f) -> FieldData { return world_poses(s, f, array); },
                 false,
                 true,
                 {{"quat_order", "xyzw"}}};
  };
  return {
      time_field(kSeries, "(P)"),
      phase_field(kSeries, "(P)"),
      poses("hand_pose", "(P,7)", "the world from the hand",
            "position and unit quaternion of the hand, whose origin is where the object is gripped in frame 0",
            GraspArray::hand_pose),
      poses("finger_pose", "(P,2,7)", "the world from S of the left and of the right finger",
            "position and unit quaternion of both fingers", GraspArray::finger_pose),
      poses("object_pose", "(P,7)", "the world from the object's own frame",
            "position and unit quaternion of the object", GraspArray::object_world_pose),
      {kSeries, "finger_force_N", f64, "(P,2,3)", "N", kWorld, "force on the left and on the right finger",
       "contact force on each finger, of the object and of the other gel", source_of(GraspArray::finger_force), kNewton,
       [](SampleFrames& s, std::size_t f) -> FieldData {
         return Numbers{{2, 3}, s.grasp_arrays().frame_of(field_of(GraspArray::finger_force), f)};
       }},
      sum("normal_force_N", "N", "sum of the lengths of the normal forces on the vertices of each front", kNewton,
          normal_force),
      sum("slipping_force_N", "N", "the same over those vertices that slip", kNewton, slipping_force),
      {kSeries, "friction_radius_mm", f64, "(P,2)", "mm", kNone, kNone,
       "mean distance of these normal forces from their centre, in the plane of the front; 0 where nothing touches",
       "press: record of the grasp", kMmPerM, [](SampleFrames& s, std::size_t f) -> FieldData {
         return Numbers{{2},
                        {s.grasp_number(f, "friction_radius_left_m"), s.grasp_number(f, "friction_radius_right_m")}};
       }}};
}

/// Of a sample that an ensemble has pressed, too: each label, its standard deviation over the members, and by how much
/// the members' mesh changes it.
std::vector<Field> ensemble() {
  constexpr auto kEnsemble = Section::ensemble;
  struct Label {
    EnsembleLabel label;
    const char *name, *shape, *unit, *frame, *sign, *meaning;
    double scale;
  };
  const std::vector<Label> labels{
      {EnsembleLabel::press_force, "press_force_N", "(T)", "N", kS, "positive when the object pushes into the gel",
       "force on the gel along -z", kNewton},
      {EnsembleLabel::tangential_force, "tangential_force_N", "(T)", "N", kS, kNone,
       "length of the force on the gel along x and y", kNewton},
      {EnsembleLabel::torque, "torque_Nmm", "(T,3)", "N mm", kS, "torque on the gel by the object, right-handed",
       "resultant torque about the origin of S", kNmmPerNm},
      {EnsembleLabel::contact_area, "contact_area_mm2", "(T)", "mm^2", kNone, kNone,
       "area of the front that carries contact force", kSame},
      {EnsembleLabel::deepest_indentation, "deepest_indentation_mm", "(T)", "mm", kS,
       "positive into the gel (along -z of S)", "largest way of a front vertex along -z since rest", kMmPerM},
      {EnsembleLabel::object_depth, "object_depth_mm", "(T)", "mm", kS, "positive below the undeformed front",
       "depth of the object's lowest point, where a mount gives way", kMmPerM}};
  std::vector<Field> all;
  for (const Label& l : labels) {
    const std::string name = l.name;
    const EnsembleLabel label = l.label;
    using Values = std::function<std::optional<std::vector<double>>(const EnsembleLabels&, std::size_t)>;
    const auto add = [&](const std::string& suffix, const std::string& sign, const std::string& meaning,
                         const std::string& why_not, Values values_of) {
      all.push_back({kEnsemble, name + suffix, f32, l.shape, l.unit, l.frame, sign, meaning,
                     "press: arrays and record" + std::string(suffix.empty() ? "" : " of the members"), l.scale,
                     [=](SampleFrames& s, std::size_t f) -> FieldData {
                       if (label == EnsembleLabel::object_depth && !s.ensemble().any_mount_gives_way())
                         return Absent{"the mounts are rigid"};
                       auto values = values_of(s.ensemble(), f);
                       if (!values) return Absent{why_not};
                       if (values->size() == 1) return scalar(values->front());
                       return Numbers{{values->size()}, std::move(*values)};
                     }});
    };
    add("", l.sign, l.meaning, "",
        [label](const EnsembleLabels& of, std::size_t f) { return std::optional(of.label(label, f)); });
    add("_sigma", kNone, "standard deviation of " + name + " over the members (n - 1)",
        "fewer than two members were pressed",
        [label](const EnsembleLabels& of, std::size_t f) { return of.sigma(label, f); });
    add("_mesh", "positive: more with the coarser mesh",
        name + " of the sensor in the members' mesh, minus that of the sample",
        "the members have the mesh of the sample, or this press failed",
        [label](const EnsembleLabels& of, std::size_t f) { return of.mesh_difference(label, f); });
  }
  return all;
}

}  // namespace

const char* name_of(Section section) {
  switch (section) {
    case Section::obs: return "obs";
    case Section::sim: return "sim";
    case Section::check: return "check";
    case Section::series: return "series";
    case Section::ensemble: return "ensemble";
  }
  return "";
}

const std::vector<Field>& fields() {
  static const std::vector<Field> kFields = [] {
    std::vector<Field> all = observations();
    for (auto part : {simulated(), checks(), series(), ensemble()}) all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return kFields;
}

std::vector<std::size_t> shape_of(const FieldData& data) {
  const auto of_image = [](const auto& image) {
    std::vector<std::size_t> shape{static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)};
    if (image.channels > 1) shape.push_back(static_cast<std::size_t>(image.channels));
    return shape;
  };
  if (const auto* image = std::get_if<FloatImage>(&data)) return of_image(*image);
  if (const auto* image = std::get_if<ByteImage>(&data)) return of_image(*image);
  return std::get<Numbers>(data).shape;
}

std::string bytes_of(const Field& field, const FieldData& data) {
  if (const auto* image = std::get_if<ByteImage>(&data); image && field.type == u8 && field.scale == 1.0)
    return {image->pixels.begin(), image->pixels.end()};
  // A few at a time: what all numbers of an image would take as doubles is no longer in the processor's cache.
  constexpr std::size_t kAtOnce = 4096;
  std::string bytes;
  std::vector<double> values;
  const auto add = [&](const auto& numbers) {
    bytes.reserve(numbers.size() * size_of(field.type));
    for (std::size_t first = 0; first < numbers.size(); first += kAtOnce) {
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
      values.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, numbers.size() - first)));
      for (double& value : values) value *= field.scale;
      if (field.step_exponent) round_to(values, *field.step_exponent);
      bytes += to_bytes(field.type, values);
    }
  };
  if (const auto* image = std::get_if<FloatImage>(&data)) add(image->pixels);
  if (const auto* image = std::get_if<ByteImage>(&data)) add(image->pixels);
  if (const auto* numbers = std::get_if<Numbers>(&data)) add(numbers->values);
  return bytes;
}

Value::Map attributes_of(const Field& field) {
  Value::Map lines{{"dtype", name_of(field.type)}, {"shape", field.shape}, {"unit", field.unit},
                   {"frame", field.frame},         {"sign", field.sign},   {"meaning", field.meaning},
                   {"source", field.source}};
  for (const auto& [name, text] : field.more) lines.emplace_back(name, text);
  if (field.step_exponent) lines.emplace_back("step", std::ldexp(1.0, *field.step_exponent));
  return lines;
}

}  // namespace tacipc
