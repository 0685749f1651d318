#include "stages/dataset/pack/field_sources.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "common/base/packed_units.h"

namespace tacipc {
namespace {

constexpr const char* kNotWanted = "the dataset's maps leave it out";
constexpr const char* kNoForces = "the press had left no contact forces when the images were made";
constexpr const char* kNoMarkers = "the press tracks no markers";

/// Reason of a missing picture: a variant without rays of its own has only what light changes.
std::string because(const SampleFrames& sample, const std::string& otherwise) {
  return sample.in_variant() ? "this variant is seen along the sensor's own rays: see obs of the sample" : otherwise;
}

/// Without a choice of maps render leaves out only what there is not.
std::string not_wanted_or(const SampleFrames& s, const char* reason) {
  return s.render().section("inputs").has("maps") ? fmt::format("{}, or {}", kNotWanted, reason) : reason;
}

std::string text_of(FrameFile file) { return "render: " + field_of(file).file; }
std::string text_of(PressArray array) { return "press: " + field_of(array).file; }
std::string text_of(GraspArray array) { return "press: " + field_of(array).file + " of the grasp"; }

FieldSource of_array(PressArray array, FieldReader read) { return {text_of(array), std::move(read)}; }

FieldSource of_image(FrameFile file, FieldReader read) { return {text_of(file), std::move(read), true}; }

FieldSource of_marker_px(FieldReader read) { return {"render: " + marker_px_field().file, std::move(read), true}; }

/// Other codes for those of an image. \throw DataError if one of them has none
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

FieldSource contact_image(FrameFile file, double (*change)(double code)) {
  return of_image(file, [=](SampleFrames& s, std::size_t f) {
    return changed(s.image(f, file, because(s, not_wanted_or(s, kNoForces))), change);
  });
}

Numbers numbers_of(const Positions& rows) {
  return {{static_cast<std::size_t>(rows.rows()), 3}, {rows.data(), rows.data() + rows.size()}};
}

Numbers numbers_of(const Vector3& v) { return {{3}, {v.begin(), v.end()}}; }

Numbers scalar(double value) { return {{}, {value}}; }

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

/// A number of each finger, by the forces and states on its front.
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

/// The packed code of a code of segment.png.
double packed_segment(double code) {
  const Segment seen = segment_of(code);
  if (seen == Segment::beside) return 2.0;
  return seen == Segment::marker || seen == Segment::marker_in_contact ? 1.0 : 0.0;
}

}  // namespace

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

FieldSource tactile_image() {
  return of_image(FrameFile::tactile,
                  [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::tactile, "no image"); });
}

FieldSource marker_image() {
  return of_image(FrameFile::marker, [](SampleFrames& s, std::size_t f) {
    return s.image(f, FrameFile::marker, s.sensor().markers.radius_m ? kNotWanted : "the sensor prints no markers");
  });
}

FieldSource radiance_image() {
  return of_image(FrameFile::linear,
                  [](SampleFrames& s, std::size_t f) { return s.image(f, FrameFile::linear, kNotWanted); });
}

FieldSource ray_image(FrameFile file) {
  return of_image(file, [=](SampleFrames& s, std::size_t f) { return s.image(f, file, because(s, kNotWanted)); });
}

FieldSource contact_mask() {
  return contact_image(FrameFile::contact, [](double code) { return touches(code) ? 1.0 : 0.0; });
}

FieldSource slip_image() {
  return contact_image(FrameFile::stick_slip, [](double code) { return static_cast<double>(state_of(code)); });
}

FieldSource segmentation() {
  return of_image(FrameFile::segment, [](SampleFrames& s, std::size_t f) {
    return changed(s.image(f, FrameFile::segment, because(s, kNotWanted)), packed_segment);
  });
}

FieldSource marker_pixels() { return of_marker_px(marker_px); }

FieldSource visible_markers() { return of_marker_px(marker_visible); }

FieldSource traction_grid(std::initializer_list<Part> parts) {
  return of_array(PressArray::traction,
                  [parts = std::vector(parts)](SampleFrames& s, std::size_t f) { return grid_of(s, f, parts, 1.0); });
}

FieldSource force_grid(std::initializer_list<Part> parts) {
  return {text_of(PressArray::traction) + " times the cell's area",
          [parts = std::vector(parts)](SampleFrames& s, std::size_t f) {
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

FieldSource contact_states() {
  return of_array(PressArray::contact_state, [](SampleFrames& s, std::size_t f) {
    const std::vector<ContactState> states = s.arrays().contact_states(f);
    Numbers numbers{{states.size()}, {}};
    append_numbers(numbers.values, states);
    return numbers;
  });
}

FieldSource first_slips() {
  return of_array(PressArray::first_slip, [](SampleFrames& s, std::size_t) {
    std::vector<double> times_s = s.arrays().first_slips();
    return Numbers{{times_s.size()}, std::move(times_s)};
  });
}

FieldSource marker_positions() {
  return of_array(PressArray::markers,
                  [](SampleFrames& s, std::size_t f) { return numbers_of(s.arrays().markers(f)); });
}

FieldSource front_positions() {
  return {text_of(PressArray::positions) + ", " + field_of(PressArray::front_vertices).file,
          [](SampleFrames& s, std::size_t f) {
            return numbers_of(Positions(s.arrays().positions(f)(s.arrays().front_vertices(), Eigen::all)));
          }};
}

FieldSource front_triangles() {
  return {"tetmesh: gel.msh", [](SampleFrames& s, std::size_t) { return s.front_triangles(); }};
}

FieldSource object_pose() {
  return of_array(PressArray::object_pose,
                  [](SampleFrames& s, std::size_t f) { return pose_numbers(s.arrays().poses()[f]); });
}

FieldSource object_twist(Vector3 Twist::*part) {
  return of_array(PressArray::object_twist, [=](SampleFrames& s, std::size_t f) -> FieldData {
    if (!s.arrays().has(PressArray::object_twist)) return Absent{"the object moves as prescribed"};
    return numbers_of(s.arrays().twists()[f].*part);
  });
}

FieldSource frame_times() {
  return of_array(PressArray::time, [](SampleFrames& s, std::size_t f) { return scalar(s.arrays().times()[f]); });
}

FieldSource frame_phases() {
  return of_array(PressArray::phase,
                  [](SampleFrames& s, std::size_t f) { return scalar(static_cast<double>(s.arrays().phases()[f])); });
}

FieldSource frame_numbers() {
  return {"render: record", [](SampleFrames&, std::size_t f) { return scalar(static_cast<double>(f)); }};
}

FieldSource of_press_record(FieldReader read) { return {"press: record", std::move(read)}; }

FieldSource grasp_line(double GraspFrameLines::*number) { return finger_line(number, number); }

FieldSource finger_line(double GraspFrameLines::*left, double GraspFrameLines::*right) {
  return {"press: record of the grasp", [=](SampleFrames& s, std::size_t f) -> FieldData {
            if (!s.grasp()) return Absent{"no grasp"};
            return scalar(s.grasp_number(f, s.is_right_finger() ? right : left));
          }};
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

FieldSource finger_forces() {
  return {text_of(GraspArray::finger_force), [](SampleFrames& s, std::size_t f) {
            return Numbers{{2, 3}, s.grasp_arrays().frame_of(field_of(GraspArray::finger_force), f)};
          }};
}

FieldSource normal_forces() {
  return of_fingers([](const FingerFront& front) { return front.normal_n.sum(); });
}

FieldSource slipping_forces() {
  return of_fingers([](const FingerFront& front) {
    double sum = 0.0;
    for (std::size_t v = 0; v < front.states.size(); ++v)
      if (front.states[v] == ContactState::slip) sum += front.normal_n[static_cast<Eigen::Index>(v)];
    return sum;
  });
}

FieldSource friction_radii() {
  return {"press: record of the grasp", [](SampleFrames& s, std::size_t f) {
            return Numbers{{2},
                           {s.grasp_number(f, &GraspFrameLines::friction_radius_left_m),
                            s.grasp_number(f, &GraspFrameLines::friction_radius_right_m)}};
          }};
}

FieldSource ensemble_label(EnsembleLabel label) {
  return of_ensemble("press: arrays and record", label, "",
                     [=](const EnsembleLabels& of, std::size_t f) { return of.label(label, f); });
}

FieldSource ensemble_sigma(EnsembleLabel label) {
  return of_ensemble(kOfMembers, label, "fewer than two members were pressed",
                     [=](const EnsembleLabels& of, std::size_t f) { return of.sigma(label, f); });
}

FieldSource ensemble_mesh_difference(EnsembleLabel label) {
  return of_ensemble(kOfMembers, label, "the members have the mesh of the sample, or this press failed",
                     [=](const EnsembleLabels& of, std::size_t f) { return of.mesh_difference(label, f); });
}

}  // namespace tacipc
