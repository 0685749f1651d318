// Sources of the fields of a packed dataset: each names the file of a sample and reads one frame of it.
#pragma once

#include <initializer_list>
#include <string>

#include "stages/dataset/pack/field.h"

namespace tacipc {

/// Codes of slip_state and nodal_contact_state, and of phase.
std::string slip_codes();
std::string phase_codes();

// Images of a frame. They are absent if the dataset's maps or the sensor leave them out.
FieldSource tactile_image();
FieldSource marker_image();
FieldSource radiance_image();
/// An image that depends on the camera's rays, so a variant with the sensor's own rays has none.
FieldSource ray_image(FrameFile file);
FieldSource contact_mask();
FieldSource slip_image();
FieldSource segmentation();
FieldSource marker_pixels();
FieldSource visible_markers();

/// Normal or friction part of contact forces and tractions.
using Part = Positions ContactParts::*;
inline constexpr Part kNormal = &ContactParts::normal, kFriction = &ContactParts::friction;

// Arrays of the press.
/// Sum of these parts on each cell of a grid over the camera's window: traction, and force.
FieldSource traction_grid(std::initializer_list<Part> parts);
FieldSource force_grid(std::initializer_list<Part> parts);
FieldSource nodal_force(Part part);
FieldSource summed_force(Part part);
FieldSource contact_wrench(Vector3 Wrench::*part);
FieldSource contact_states();
FieldSource first_slips();
FieldSource marker_positions();
FieldSource front_positions();
FieldSource front_triangles();
FieldSource object_pose();
FieldSource object_twist(Vector3 Twist::*part);
FieldSource frame_times();
FieldSource frame_phases();
FieldSource frame_numbers();

FieldSource of_press_record(FieldReader read);
/// A line of `per_frame` in the record of the press.
template <typename T>
FieldSource press_line(T PressFrameLines::*number) {
  return of_press_record([=](SampleFrames& s, std::size_t f) { return Numbers{{}, {s.press_number(f, number)}}; });
}
/// A line of `per_frame` in the record of the grasp; absent if the sample is no finger of one.
FieldSource grasp_line(double GraspFrameLines::*number);
/// The line of the sample's own finger.
FieldSource finger_line(double GraspFrameLines::*left, double GraspFrameLines::*right);

// Arrays of the grasp and of both of its fingers.
FieldSource world_poses(GraspArray array);
FieldSource finger_forces();
/// Sum of the normal forces on the front of each finger, and on those of its vertices that slip.
FieldSource normal_forces();
FieldSource slipping_forces();
FieldSource friction_radii();

// Labels of an ensemble: of the sample, deviation over the members, change with their mesh.
FieldSource ensemble_label(EnsembleLabel label);
FieldSource ensemble_sigma(EnsembleLabel label);
FieldSource ensemble_mesh_difference(EnsembleLabel label);

}  // namespace tacipc
