#include "stages/dataset/pack/field.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "common/base/packed_units.h"
#include "common/base/rounding.h"
#include "stages/dataset/pack/field_sources.h"

namespace tacipc {
namespace {

using enum NumberType;

constexpr PackedUnit kMm{"mm", kMmPerM}, kMmPerS{"mm/s", kMmPerM}, kNewton{"N"}, kNmm{"N mm", kNmmPerNm},
    kNPerMm2{"N/mm^2", kNPerMm2PerPa}, kDeg{"deg", kDegPerRad}, kRadPerS{"rad/s"}, kSecond{"s"}, kPixel{"px"},
    kCode{"code"}, kCount{"count"}, kRatio{"1"}, kRelative{"relative"};
constexpr PackedUnit kSquareMm{"mm^2"}, kPose{"mm and 1"};  // read in mm
constexpr int kStepOfMm = -13, kStepOfNormals = -12;        // 0.12 µm; 0.014°

constexpr FieldAxes kNoAxes{}, kImage{"image"}, kOnGel{"S", "force on the gel by the object"},
    kTorqueOnGel{"S", "torque on the gel by the object, right-handed"},
    kIntoGel{"S", "positive into the gel (along -z of S)"},
    kPushing{"S", "positive when the object pushes into the gel"}, kCoordinates{"S", "coordinates in S"},
    kApart{"none", "positive: apart"};

FieldNumbers as(NumberType type, const char* shape, PackedUnit unit) { return {type, shape, unit}; }
FieldAxes in(const char* frame, const char* sign) { return {frame, sign}; }
FieldExtra codes(std::string codes) { return {.more = {{"codes", std::move(codes)}}}; }
FieldExtra quaternions() { return {.more = {{"quat_order", "xyzw"}}}; }
FieldExtra in_steps(int exponent) { return {.step_exponent = exponent}; }
FieldExtra once() { return {.per_frame = false}; }

/// Of the group's frames, (T) or (P).
Field time_field(const char* shape) {
  return {"time_s", as(f64, shape, kSecond), kNoAxes, "time of the frame, 0 at the first", frame_times()};
}

Field phase_field(const char* shape) {
  return {"phase",        as(u8, shape, kCode), kNoAxes, "part of the motion that the frame ends or lies in",
          frame_phases(), codes(phase_codes())};
}

std::vector<Field> images() {
  return {
      {"rgb", as(u8, "(T,H,W,3)", kCode), kImage,
       "tactile image, RGB, row 0 on top, as the camera's response curve encodes it; frame 0 is the reference image",
       tactile_image()},
      {"rgb_marker", as(u8, "(T,H,W,3)", kCode), kImage, "the same with the printed markers", marker_image()},
      {"radiance", as(f16, "(T,H,W,3)", kRelative), kImage,
       "radiance before exposure, response curve and noise, linear sRGB primaries", radiance_image()},
      {"indentation_mm", as(f32, "(T,H,W)", kMm), kIntoGel,
       "undeformed minus deformed height of the gel point a pixel sees; NaN beside the gel",
       ray_image(FrameFile::indentation), in_steps(kStepOfMm)},
      {"camera_depth_mm", as(f32, "(T,H,W)", kMm), in("camera", "positive away from the camera"),
       "distance from the camera to the gel's front along the optical axis; NaN beside the gel",
       ray_image(FrameFile::depth), in_steps(kStepOfMm)},
      {"normal", as(f16, "(T,H,W,3)", kRatio), in("S", "outward: (0, 0, 1) where the gel is flat"),
       "unit normal of the deformed front; NaN beside the gel", ray_image(FrameFile::normal), in_steps(kStepOfNormals)},
      {"contact_mask", as(u8, "(T,H,W)", kCode), kImage,
       "whether the object pushes on the gel where a pixel looks (its nearest vertex carries contact force)",
       contact_mask(), codes("0 no contact, 1 contact")},
      {"slip_state", as(u8, "(T,H,W)", kCode), kImage,
       "whether the gel sticks to the object or slides along it, of the vertex nearest to what a pixel sees",
       slip_image(), codes(slip_codes())},
      {"segmentation", as(u8, "(T,H,W)", kCode), kImage, "what a pixel shows", segmentation(),
       codes("0 gel, 1 marker, 2 beside the gel")}};
}

std::vector<Field> forces() {
  return {
      {"force_field_N", as(f32, "(T,h,w,3)", kNewton), kOnGel,
       "contact force per cell of a regular grid over the camera's window in the plane z = 0 (row 0 at the smallest y, "
       "column 0 at the smallest x); sums to the force on the front vertices inside the window",
       force_grid({kNormal, kFriction})},
      {"force_field_normal_N", as(f32, "(T,h,w,3)", kNewton), kOnGel,
       "the part of force_field_N that pushes the surfaces apart (the contact barrier's)", force_grid({kNormal})},
      {"force_field_friction_N", as(f32, "(T,h,w,3)", kNewton), kOnGel,
       "the part of force_field_N that resists sliding", force_grid({kFriction})},
      {"traction_Nmm2", as(f32, "(T,h,w,3)", kNPerMm2), kOnGel,
       "force_field_N per area of the cell, in the plane (not along the slope)", traction_grid({kNormal, kFriction})},
      {"force_N", as(f32, "(T,3)", kNewton), in("S", "force on the gel by the object: a press has z < 0"),
       "resultant contact force, wherever the object touches the gel", contact_wrench(&Wrench::force_n)},
      {"torque_Nmm", as(f32, "(T,3)", kNmm), kTorqueOnGel, "resultant torque about the origin of S",
       contact_wrench(&Wrench::torque_n_m)},
      {"normal_force_N", as(f32, "(T,3)", kNewton), kOnGel, "sum of the normal forces on the gel's front",
       summed_force(kNormal)},
      {"friction_force_N", as(f32, "(T,3)", kNewton), kOnGel, "sum of the friction forces on the gel's front",
       summed_force(kFriction)},
      {"press_force_N", as(f32, "(T)", kNewton), kPushing, "-z component of force_N",
       press_line(&PressFrameLines::press_force_n)}};
}

std::vector<Field> markers() {
  return {{"marker_px", as(f32, "(T,2,N,2)", kPixel), in("image", "x right, y down; pixel (0, 0) spans 0 to 1"),
           "column and row of each marker in frame 0 [0] and now [1]; NaN where the image does not show it",
           marker_pixels()},
          {"marker_mm", as(f32, "(T,N,3)", kMm), kCoordinates, "markers on the deformed front", marker_positions()},
          {"marker_visible", as(u8, "(T,N)", kCode), kImage, "whether the image shows a marker", visible_markers(),
           codes("0 not seen, 1 seen")}};
}

std::vector<Field> object_motion() {
  return {{"object_pose", as(f32, "(T,7)", kPose), in("S", "S from the object's own frame"),
           "position x, y, z in mm, then unit quaternion x, y, z, w (scalar last, never negative)", object_pose(),
           quaternions()},
          {"object_velocity_mm_s", as(f32, "(T,3)", kMmPerS), in("S", "along the axes of S"),
           "velocity of the object's centre of mass in the world, for a finger of a grasp too",
           object_twist(&Twist::velocity_m_s)},
          {"object_spin_rad_s", as(f32, "(T,3)", kRadPerS), in("S", "right-handed, along the axes of S"),
           "angular velocity of the object in the world", object_twist(&Twist::spin_rad_s)},
          {"slip_mm", as(f32, "(T)", kMm), kNoAxes,
           "displacement of the object's point at the grip, relative to the hand, since the fingers have closed",
           grasp_line(&GraspFrameLines::slip_m)},
          {"turn_deg", as(f32, "(T)", kDeg), kNoAxes,
           "angle by which the object has turned relative to the hand since the fingers have closed",
           grasp_line(&GraspFrameLines::turn_rad)},
          {"slip_share", as(f32, "(T)", kRatio), kNoAxes,
           "part of the finger's normal force that is on vertices that slip; 0 where it does not touch",
           finger_line(&GraspFrameLines::slip_share_left, &GraspFrameLines::slip_share_right)},
          time_field("(T)"),
          phase_field("(T)"),
          {"frame", as(i32, "(T)", kCount), kNoAxes,
           "number of the frame in the press (not all need have been rendered)", frame_numbers()}};
}

std::vector<Field> simulated() {
  return {{"surface_vertices_mm", as(f32, "(T,V,3)", kMm), kCoordinates, "vertices of the deformed front",
           front_positions()},
          {"surface_triangles", as(i32, "(F,3)", kCount), in("none", "counter-clockwise seen from the object"),
           "triangles of the front, rows of surface_vertices_mm", front_triangles(), once()},
          {"nodal_force_normal_N", as(f32, "(T,V,3)", kNewton), kOnGel, "normal force on each front vertex",
           nodal_force(kNormal)},
          {"nodal_force_friction_N", as(f32, "(T,V,3)", kNewton), kOnGel, "friction force on each front vertex",
           nodal_force(kFriction)},
          {"nodal_contact_state", as(u8, "(T,V)", kCode), kNoAxes, "contact of each front vertex", contact_states(),
           codes(slip_codes())},
          {"first_slip_s", as(f32, "(V)", kSecond), kNoAxes,
           "time of the first frame of the press in which a front vertex slips, +inf where none does", first_slips(),
           once()}};
}

std::vector<Field> checks() {
  using Lines = PressFrameLines;
  const auto line = [](const char* name, NumberType type, PackedUnit unit, auto number, const char* meaning,
                       const FieldAxes& axes = kNoAxes) {
    return Field{name, as(type, "(T)", unit), axes, meaning, press_line(number)};
  };
  return {
      line("min_distance_mm", f32, kMm, &Lines::min_gap_m, "smallest gap between gel and object", kApart),
      line("stand_off_mm", f32, kMm, &Lines::stand_off_m,
           "mean gap of what touches, weighted by force: how far the contact barrier keeps the surfaces apart", kApart),
      line("min_volume_ratio", f32, kRatio, &Lines::min_volume_ratio,
           "smallest deformed over undeformed volume of a tetrahedron", in("none", "positive: not inverted")),
      line("intersections", i32, kCount, &Lines::intersections, "pairs of triangles that intersect, by exact test"),
      line("inverted_tets", i32, kCount, &Lines::inverted_tets, "inverted tetrahedra, by exact test"),
      line("newton_iterations", i32, kCount, &Lines::newton_iterations, "Newton iterations since the frame before"),
      line("velocity_residual_mm_s", f32, kMmPerS, &Lines::velocity_residual_m_s,
           "last Newton step over the time step"),
      line("force_residual_N", f32, kNewton, &Lines::force_residual_n, "forces left out of balance, summed as lengths"),
      line("friction_residual_N", f32, kNewton, &Lines::friction_residual_n,
           "how far friction is from that of its own contact forces"),
      line("force_balance_rel", f32, kRatio, &Lines::balance_relative,
           "contact, inertia, damping, gravity and mount summed, over the contact force (at least 0.01 N)"),
      line("force_balance_N", f32, kNewton, &Lines::balance_n, "the same sum"),
      line("pose_error_mm", f32, kMm, &Lines::pose_error_m,
           "largest distance of the object from where its motion puts it"),
      line("contact_area_mm2", f32, kSquareMm, &Lines::contact_area_mm2,
           "area of the front that carries contact force"),
      line("sticking", i32, kCount, &Lines::sticking, "front vertices that stick"),
      line("slipping", i32, kCount, &Lines::slipping, "front vertices that slip")};
}

/// Of a grasp, in every frame of the press: what its labels follow from.
std::vector<Field> series() {
  return {
      time_field("(P)"),
      phase_field("(P)"),
      {"hand_pose", as(f64, "(P,7)", kPose), in("world", "the world from the hand"),
       "position and unit quaternion of the hand, whose origin is where the object is gripped in frame 0",
       world_poses(GraspArray::hand_pose), quaternions()},
      {"finger_pose", as(f64, "(P,2,7)", kPose), in("world", "the world from S of the left and of the right finger"),
       "position and unit quaternion of both fingers", world_poses(GraspArray::finger_pose), quaternions()},
      {"object_pose", as(f64, "(P,7)", kPose), in("world", "the world from the object's own frame"),
       "position and unit quaternion of the object", world_poses(GraspArray::object_world_pose), quaternions()},
      {"finger_force_N", as(f64, "(P,2,3)", kNewton), in("world", "force on the left and on the right finger"),
       "contact force on each finger, of the object and of the other gel", finger_forces()},
      {"normal_force_N", as(f64, "(P,2)", kNewton), kNoAxes,
       "sum of the lengths of the normal forces on the vertices of each front", normal_forces()},
      {"slipping_force_N", as(f64, "(P,2)", kNewton), kNoAxes, "the same over those vertices that slip",
       slipping_forces()},
      {"friction_radius_mm", as(f64, "(P,2)", kMm), kNoAxes,
       "mean distance of these normal forces from their centre, in the plane of the front; 0 where nothing touches",
       friction_radii()}};
}

/// Of a sample that an ensemble has also pressed: each label, its standard deviation over the members, and its change
/// with the members' mesh.
std::vector<Field> ensemble() {
  std::vector<Field> all;
  const auto add = [&](EnsembleLabel label, const std::string& name, const FieldNumbers& numbers, const FieldAxes& axes,
                       const char* meaning) {
    all.push_back({name, numbers, axes, meaning, ensemble_label(label)});
    all.push_back({name + "_sigma", numbers, in(axes.frame, "none"),
                   "standard deviation of " + name + " over the members (n - 1)", ensemble_sigma(label)});
    all.push_back({name + "_mesh", numbers, in(axes.frame, "positive: more with the coarser mesh"),
                   name + " of the sensor in the members' mesh, minus that of the sample",
                   ensemble_mesh_difference(label)});
  };
  using enum EnsembleLabel;
  add(press_force, "press_force_N", as(f32, "(T)", kNewton), kPushing, "force on the gel along -z");
  add(tangential_force, "tangential_force_N", as(f32, "(T)", kNewton), in("S", "none"),
      "length of the force on the gel along x and y");
  add(torque, "torque_Nmm", as(f32, "(T,3)", kNmm), kTorqueOnGel, "resultant torque about the origin of S");
  add(contact_area, "contact_area_mm2", as(f32, "(T)", kSquareMm), kNoAxes,
      "area of the front that carries contact force");
  add(deepest_indentation, "deepest_indentation_mm", as(f32, "(T)", kMm), kIntoGel,
      "largest way of a front vertex along -z since rest");
  add(object_depth, "object_depth_mm", as(f32, "(T)", kMm), in("S", "positive below the undeformed front"),
      "depth of the object's lowest point, where a mount gives way");
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
    std::vector<Field> all;
    const auto add = [&](Section section, std::initializer_list<std::vector<Field>> groups) {
      for (const std::vector<Field>& group : groups) {
        for (const Field& field : group) all.emplace_back(field).section = section;
      }
    };
    add(Section::obs, {images(), forces(), markers(), object_motion()});
    add(Section::sim, {simulated()});
    add(Section::check, {checks()});
    add(Section::series, {series()});
    add(Section::ensemble, {ensemble()});
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
  if (const auto* image = std::get_if<ByteImage>(&data);
      image && field.numbers.type == u8 && field.numbers.unit.per_read == 1.0)
    return {image->pixels.begin(), image->pixels.end()};
  // A few at a time: what all numbers of an image would take as doubles is no longer in the processor's cache.
  constexpr std::size_t kAtOnce = 4096;
  std::string bytes;
  std::vector<double> values;
  const auto add = [&](const auto& numbers) {
    bytes.reserve(numbers.size() * size_of(field.numbers.type));
    for (std::size_t first = 0; first < numbers.size(); first += kAtOnce) {
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
      values.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, numbers.size() - first)));
      for (double& value : values) value *= field.numbers.unit.per_read;
      if (field.extra.step_exponent) round_to(values, *field.extra.step_exponent);
      bytes += to_bytes(field.numbers.type, values);
    }
  };
  if (const auto* image = std::get_if<FloatImage>(&data)) add(image->pixels);
  if (const auto* image = std::get_if<ByteImage>(&data)) add(image->pixels);
  if (const auto* numbers = std::get_if<Numbers>(&data)) add(numbers->values);
  return bytes;
}

Value::Map attributes_of(const Field& field) {
  Value::Map lines{{"dtype", name_of(field.numbers.type)},
                   {"shape", field.numbers.shape},
                   {"unit", field.numbers.unit.name},
                   {"frame", field.axes.frame},
                   {"sign", field.axes.sign},
                   {"meaning", field.meaning},
                   {"source", field.from.text}};
  for (const auto& [name, text] : field.extra.more) lines.emplace_back(name, text);
  if (field.extra.step_exponent) lines.emplace_back("step", std::ldexp(1.0, *field.extra.step_exponent));
  return lines;
}

}  // namespace tacipc
