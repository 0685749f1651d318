#include "stages/dataset/pack/field_sources.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "common/base/packed_units.h"

namespace tacipc {
namespace {

using Sources = std::map<std::string, FieldSource>;

/// Normal or friction part of contact forces and tractions.
using Part = Positions ContactParts::*;
constexpr Part kNormal = &ContactParts::normal, kFriction = &ContactParts::friction;

constexpr const char* kNotWanted = "the dataset's maps leave it out";
constexpr const char* kNoForces = "the press had left no contact forces when the images were made";
constexpr const char* kNoStress = "the press file does not say stress: true";
constexpr const char* kNoMarkers = "the press tracks no markers";

/// Reason of a missing picture: a variant without rays of its own only has pictures that its light changes.
std::string because(const SampleFrames& sample, const std::string& otherwise) {
  return sample.in_variant() ? "this variant is seen along the sensor's own rays: see obs of the sample" : otherwise;
}

/// Without a choice of maps, render leaves out only maps that do not exist.
std::string not_wanted_or(const SampleFrames& s, const char* reason) {
  return s.render().section("inputs").has("maps") ? fmt::format("{}, or {}", kNotWanted, reason) : reason;
}

std::string text_of(FrameFile file) { return "render: " + field_of(file).file; }
std::string text_of(PressArray array) { return "press: " + field_of(array).file; }
std::string text_of(GraspArray array) { return "press: " + field_of(array).file + " of the grasp"; }

FieldSource of_array(PressArray array, FieldReader read) { return {text_of(array), std::move(read)}; }

FieldSource of_image(FrameFile file, FieldReader read) { return {text_of(file), std::move(read), true}; }

FieldSource of_marker_px(FieldReader read) { return {"render: " + marker_px_field().file, std::move(read), true}; }

/// Maps the values of an image.
/// \throw DataError if one of them has no new value
FieldData changed(FieldData data, double (*change)(double code)) {
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

FieldSource contact_image(FrameFile file, double (*change)(double code), std::string codes = {}) {
  FieldSource source = of_image(file, [=](SampleFrames& s, std::size_t f) {
    return changed(s.image(f, file, because(s, not_wanted_or(s, kNoForces))), change);
  });
  source.codes = std::move(codes);
  return source;
}

/// Image that depends on the camera's rays; a variant with the sensor's own rays has none.
FieldSource ray_image(FrameFile file) {
  return of_image(file, [=](SampleFrames& s, std::size_t f) { return s.image(f, file, because(s, kNotWanted)); });
}

Numbers numbers_of(const Positions& rows) {
  return {{static_cast<std::size_t>(rows.rows()), 3}, {rows.data(), rows.data() + rows.size()}};
}

Numbers numbers_of(const Vector3& v) { return {{3}, {v.begin(), v.end()}}; }

Numbers scalar(double value) { return {{}, {value}}; }

/// Sum of these parts on each cell of a grid over the camera's field of view.
Numbers grid_of(const SampleFrames& sample, std::size_t frame, const std::vector<Part>& parts, double factor) {
  const ContactParts traction = sample.arrays().tractions(frame);
  Positions sum = Positions::Zero(traction.normal.rows(), 3);
  for (const Part part : parts) sum += traction.*part;
  Numbers out = numbers_of(Positions(sum * factor));
  out.shape = {kTractionRows, kTractionColumns, 3};
  return out;
}

/// x, y, z in mm, then the unit quaternion x, y, z, w with w ≥ 0.
Numbers pose_numbers(const Matrix4& pose) {
  Eigen::Quaterniond q(Matrix3(pose.topLeftCorner<3, 3>()));
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Vector3 at = kMmPerM * pose.topRightCorner<3, 1>();
  return {{7}, {at.x(), at.y(), at.z(), q.x(), q.y(), q.z(), q.w()}};
}

/// Number of each finger, from the forces and states on its front.
FieldSource of_fingers(double (*measure)(const FingerFront&)) {
  return {text_of(PressArray::contact_force) + ", " + field_of(PressArray::contact_state).file + " of both fingers",
          [=](SampleFrames& s, std::size_t f) {
            return Numbers{{2}, {measure(s.finger_front(0, f)), measure(s.finger_front(1, f))}};
          }};
}

/// \param values_of gives the numbers of the label, or nothing for the reason `why_not`
template <typename Values>
FieldSource of_ensemble(const char* text, EnsembleLabel label, const char* why_not, Values values_of) {
  return {text, [=](SampleFrames& s, std::size_t f) -> FieldData {
            if (label == EnsembleLabel::object_depth && !s.ensemble().any_mount_gives_way())
              return Absent{"the mounts are rigid"};
            std::optional<std::vector<double>> values = values_of(s.ensemble(), f);
            if (!values) return Absent{why_not};
            if (values->size() == 1) return scalar(values->front());
            return Numbers{{values->size()}, std::move(*values)};
          }};
}

constexpr const char* kOfMembers = "press: arrays and record of the members";

FieldData marker_px(SampleFrames& s, std::size_t f) {
  const std::string reason = because(s, kNoMarkers);
  FieldData reference = s.marker_px(0, reason), current = s.marker_px(f, reason);
  if (!std::holds_alternative<Numbers>(reference) || !std::holds_alternative<Numbers>(current)) return reference;
  Numbers& both = std::get<Numbers>(reference);
  const Numbers& now = std::get<Numbers>(current);
  both.values.insert(both.values.end(), now.values.begin(), now.values.end());
  both.shape.insert(both.shape.begin(), 2);
  return reference;
}

FieldData marker_visible(SampleFrames& s, std::size_t f) {
  FieldData px = s.marker_px(f, because(s, kNoMarkers));
  if (auto* numbers = std::get_if<Numbers>(&px)) {
    Numbers seen{{numbers->shape.at(0)}, {}};
    for (std::size_t m = 0; m < numbers->shape[0]; ++m)
      seen.values.push_back(std::isnan(numbers->values[2 * m]) ? 0.0 : 1.0);
    return seen;
  }
  return px;
}

/// Packed value of a value of segment.png.
double packed_segment(double code) {
  const Segment seen = segment_of(code);
  if (seen == Segment::beside) return 2.0;
  return seen == Segment::marker || seen == Segment::marker_in_contact ? 1.0 : 0.0;
}

std::string phase_codes() {
  std::string codes;
  for (std::size_t k = 0; k < kPhaseNames.size(); ++k)
    codes += fmt::format("{}{} {}", k > 0 ? ", " : "", k, kPhaseNames[k]);
  return codes;
}

std::string slip_codes() {
  using enum ContactState;
  return fmt::format("{:d} no contact, {:d} sticks, {:d} slips", static_cast<int>(none), static_cast<int>(stick),
                     static_cast<int>(slip));
}

/// Images; absent if the dataset's maps or the sensor leave them out.
Sources images() {
  using enum FrameFile;
  return {
      {"rgb", of_image(tactile, [](SampleFrames& s, std::size_t f) { return s.image(f, tactile, "no image"); })},
      {"rgb_marker", of_image(marker,
                              [](SampleFrames& s, std::size_t f) {
                                const bool printed = s.sensor().markers.radius_m.has_value();
                                return s.image(f, marker, printed ? kNotWanted : "the sensor prints no markers");
                              })},
      {"radiance", of_image(linear, [](SampleFrames& s, std::size_t f) { return s.image(f, linear, kNotWanted); })},
      {"indentation_mm", ray_image(indentation)},
      {"camera_depth_mm", ray_image(depth)},
      {"normal", ray_image(normal)},
      {"pressure_Nmm2", ray_image(pressure)},
      {"shear_Nmm2", ray_image(shear)},
      {"contact_mask", contact_image(contact, [](double code) { return touches(code) ? 1.0 : 0.0; })},
      {"slip_state", contact_image(
                         stick_slip, [](double code) { return static_cast<double>(state_of(code)); }, slip_codes())},
      {"segmentation", of_image(segment,
                                [](SampleFrames& s, std::size_t f) {
                                  return changed(s.image(f, segment, because(s, kNotWanted)), packed_segment);
                                })},
      {"marker_px", of_marker_px(marker_px)},
      {"marker_visible", of_marker_px(marker_visible)}};
}

FieldSource traction_grid(std::vector<Part> parts) {
  return of_array(PressArray::traction, [=](SampleFrames& s, std::size_t f) { return grid_of(s, f, parts, 1.0); });
}

FieldSource force_grid(std::vector<Part> parts) {
  return {text_of(PressArray::traction) + " times the cell's area", [=](SampleFrames& s, std::size_t f) {
            const Camera& camera = s.sensor().camera;
            const double cell_area_m2 =
                camera.window_width_m * camera.window_height_m / static_cast<double>(kTractionRows * kTractionColumns);
            return grid_of(s, f, parts, cell_area_m2);
          }};
}

FieldSource nodal_force(Part part) {
  return of_array(PressArray::contact_force,
                  [=](SampleFrames& s, std::size_t f) { return numbers_of(s.arrays().contact_forces(f).*part); });
}

/// Arrays of a press with stress.
FieldSource of_stress(PressArray array, Numbers (*read)(const PressFolder& press, std::size_t frame)) {
  return of_array(array, [=](SampleFrames& s, std::size_t f) -> FieldData {
    if (!s.arrays().has(array)) return Absent{kNoStress};
    return read(s.arrays(), f);
  });
}

Sources stresses() {
  return {{"nodal_pressure_Nmm2",
           of_stress(PressArray::front_pressure,
                     [](const PressFolder& press, std::size_t f) {
                       const Eigen::VectorXd pressure = press.front_by_contact(f).pressure;
                       return Numbers{{static_cast<std::size_t>(pressure.size())}, {pressure.begin(), pressure.end()}};
                     })},
          {"nodal_shear_Nmm2", of_stress(PressArray::front_shear,
                                         [](const PressFolder& press, std::size_t f) {
                                           return numbers_of(press.front_by_contact(f).shear);
                                         })},
          {"stress_Nmm2", of_stress(PressArray::stress, [](const PressFolder& press, std::size_t f) {
             const SymmetricRows rows = press.stresses(f);
             return Numbers{{static_cast<std::size_t>(rows.rows()), 6}, {rows.data(), rows.data() + rows.size()}};
           })}};
}

FieldSource summed_force(Part part) {
  return of_array(PressArray::contact_force, [=](SampleFrames& s, std::size_t f) {
    const Positions all = s.arrays().contact_forces(f).*part;
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index v = 0; v < all.rows(); ++v) sum += all.row(v).transpose();
    return numbers_of(sum);
  });
}

FieldSource contact_wrench(Vector3 Wrench::*part) {
  return of_array(PressArray::wrench,
                  [=](SampleFrames& s, std::size_t f) { return numbers_of(s.arrays().wrenches()[f].*part); });
}

FieldSource object_twist(Vector3 Twist::*part) {
  return of_array(PressArray::object_twist, [=](SampleFrames& s, std::size_t f) -> FieldData {
    if (!s.arrays().has(PressArray::object_twist)) return Absent{"the object moves as prescribed"};
    return numbers_of(s.arrays().twists()[f].*part);
  });
}

/// Value of a line of `per_frame` in the record of the press.
template <typename T>
FieldSource press_line(T PressFrameLines::*number) {
  return {"press: record", [=](SampleFrames& s, std::size_t f) { return scalar(s.press_number(f, number)); }};
}

/// Value of a line of `per_frame` in the record of the grasp, for the sample's own finger; absent for a sample that is
/// not a finger.
FieldSource finger_line(double GraspFrameLines::*left, double GraspFrameLines::*right) {
  return {"press: record of the grasp", [=](SampleFrames& s, std::size_t f) -> FieldData {
            if (!s.grasp()) return Absent{"no grasp"};
            return scalar(s.grasp_number(f, s.is_right_finger() ? right : left));
          }};
}

FieldSource frame_times() {
  return of_array(PressArray::time, [](SampleFrames& s, std::size_t f) { return scalar(s.arrays().times()[f]); });
}

FieldSource frame_phases() {
  FieldSource source = of_array(PressArray::phase, [](SampleFrames& s, std::size_t f) {
    return scalar(static_cast<double>(s.arrays().phases()[f]));
  });
  source.codes = phase_codes();
  return source;
}

Sources forces_and_motion() {
  using Grasp = GraspFrameLines;
  return {{"force_field_N", force_grid({kNormal, kFriction})},
          {"force_field_normal_N", force_grid({kNormal})},
          {"force_field_friction_N", force_grid({kFriction})},
          {"traction_Nmm2", traction_grid({kNormal, kFriction})},
          {"force_N", contact_wrench(&Wrench::force_n)},
          {"torque_Nmm", contact_wrench(&Wrench::torque_n_m)},
          {"normal_force_N", summed_force(kNormal)},
          {"friction_force_N", summed_force(kFriction)},
          {"press_force_N", press_line(&PressFrameLines::press_force_n)},
          {"marker_mm", of_array(PressArray::markers,
                                 [](SampleFrames& s, std::size_t f) { return numbers_of(s.arrays().markers(f)); })},
          {"object_pose", of_array(PressArray::object_pose,
                                   [](SampleFrames& s, std::size_t f) { return pose_numbers(s.arrays().poses()[f]); })},
          {"object_velocity_mm_s", object_twist(&Twist::velocity_m_s)},
          {"object_spin_rad_s", object_twist(&Twist::spin_rad_s)},
          {"slip_mm", finger_line(&Grasp::slip_m, &Grasp::slip_m)},
          {"turn_deg", finger_line(&Grasp::turn_rad, &Grasp::turn_rad)},
          {"slip_share", finger_line(&Grasp::slip_share_left, &Grasp::slip_share_right)},
          {"time_s", frame_times()},
          {"phase", frame_phases()},
          {"frame", {"render: record", [](SampleFrames&, std::size_t f) { return scalar(static_cast<double>(f)); }}}};
}

FieldData contact_states(SampleFrames& s, std::size_t f) {
  const std::vector<ContactState> states = s.arrays().contact_states(f);
  Numbers numbers{{states.size()}, {}};
  append_numbers(numbers.values, states);
  return numbers;
}

FieldData first_slips(SampleFrames& s, std::size_t) {
  std::vector<double> times_s = s.arrays().first_slips();
  return Numbers{{times_s.size()}, std::move(times_s)};
}

Sources simulated() {
  FieldSource states = of_array(PressArray::contact_state, contact_states);
  states.codes = slip_codes();
  return {{"surface_vertices_mm",
           {text_of(PressArray::positions) + ", " + field_of(PressArray::front_vertices).file,
            [](SampleFrames& s, std::size_t f) {
              return numbers_of(Positions(s.arrays().positions(f)(s.arrays().front_vertices(), Eigen::all)));
            }}},
          {"surface_triangles", {"tetmesh: gel.msh", [](SampleFrames& s, std::size_t) { return s.front_triangles(); }}},
          {"nodal_force_normal_N", nodal_force(kNormal)},
          {"nodal_force_friction_N", nodal_force(kFriction)},
          {"nodal_contact_state", std::move(states)},
          {"first_slip_s", of_array(PressArray::first_slip, first_slips)}};
}

Sources checks() {
  using Lines = PressFrameLines;
  return {{"min_distance_mm",
           {"press: record",
            [](SampleFrames& s, std::size_t f) {
              return scalar(s.find_press_number(f, &Lines::min_gap_m).value_or(std::nan("")));
            }}},
          {"stand_off_mm", press_line(&Lines::stand_off_m)},
          {"min_volume_ratio", press_line(&Lines::min_volume_ratio)},
          {"intersections", press_line(&Lines::intersections)},
          {"inverted_tets", press_line(&Lines::inverted_tets)},
          {"newton_iterations", press_line(&Lines::newton_iterations)},
          {"velocity_residual_mm_s", press_line(&Lines::velocity_residual_m_s)},
          {"force_residual_N", press_line(&Lines::force_residual_n)},
          {"friction_residual_N", press_line(&Lines::friction_residual_n)},
          {"force_balance_rel", press_line(&Lines::balance_relative)},
          {"force_balance_N", press_line(&Lines::balance_n)},
          {"pose_error_mm", press_line(&Lines::pose_error_m)},
          {"contact_area_mm2", press_line(&Lines::contact_area_mm2)},
          {"sticking", press_line(&Lines::sticking)},
          {"slipping", press_line(&Lines::slipping)}};
}

FieldSource world_poses(GraspArray array) {
  return {text_of(array), [=](SampleFrames& s, std::size_t f) {
            const auto poses = items_of<Matrix4>(s.grasp_arrays().frame_of(field_of(array), f));
            Numbers all{{poses.size(), 7}, {}};
            if (poses.size() == 1) all.shape = {7};
            for (const Matrix4& pose : poses) append_numbers(all.values, pose_numbers(pose).values);
            return all;
          }};
}

double slipping_force(const FingerFront& front) {
  double sum = 0.0;
  for (std::size_t v = 0; v < front.states.size(); ++v)
    if (front.states[v] == ContactState::slip) sum += front.normal_n[static_cast<Eigen::Index>(v)];
  return sum;
}

/// Series of the grasp and of both of its fingers.
Sources series() {
  return {{"time_s", frame_times()},
          {"phase", frame_phases()},
          {"hand_pose", world_poses(GraspArray::hand_pose)},
          {"finger_pose", world_poses(GraspArray::finger_pose)},
          {"object_pose", world_poses(GraspArray::object_world_pose)},
          {"finger_force_N",
           {text_of(GraspArray::finger_force),
            [](SampleFrames& s, std::size_t f) {
              return Numbers{{2, 3}, s.grasp_arrays().frame_of(field_of(GraspArray::finger_force), f)};
            }}},
          {"normal_force_N", of_fingers([](const FingerFront& front) { return front.normal_n.sum(); })},
          {"slipping_force_N", of_fingers(slipping_force)},
          {"friction_radius_mm", {"press: record of the grasp", [](SampleFrames& s, std::size_t f) {
                                    return Numbers{{2},
                                                   {s.grasp_number(f, &GraspFrameLines::friction_radius_left_m),
                                                    s.grasp_number(f, &GraspFrameLines::friction_radius_right_m)}};
                                  }}}};
}

/// Labels of the sample, their standard deviation, and their change with the members' mesh.
Sources ensemble() {
  using enum EnsembleLabel;
  Sources all;
  for (const auto& [name, label] : {std::pair<std::string, EnsembleLabel>{"press_force_N", press_force},
                                    {"tangential_force_N", tangential_force},
                                    {"torque_Nmm", torque},
                                    {"contact_area_mm2", contact_area},
                                    {"deepest_indentation_mm", deepest_indentation},
                                    {"object_depth_mm", object_depth}}) {
    all[name] = of_ensemble("press: arrays and record", label, "",
                            [label](const EnsembleLabels& of, std::size_t f) { return of.label(label, f); });
    all[name + "_sigma"] = of_ensemble(kOfMembers, label, "fewer than two members were pressed",
                                       [label](const EnsembleLabels& of, std::size_t f) { return of.sigma(label, f); });
    all[name + "_mesh"] =
        of_ensemble(kOfMembers, label, "the members have the mesh of the sample, or this press failed",
                    [label](const EnsembleLabels& of, std::size_t f) { return of.mesh_difference(label, f); });
  }
  return all;
}

}  // namespace

std::map<std::string, FieldSource> field_sources(Section section) {
  switch (section) {
    case Section::obs: {
      Sources all = images();
      all.merge(forces_and_motion());
      return all;
    }
    case Section::sim: {
      Sources all = simulated();
      all.merge(stresses());
      return all;
    }
    case Section::check: return checks();
    case Section::series: return series();
    case Section::ensemble: return ensemble();
  }
  return {};
}

}  // namespace tacipc
