// The press folder of a sheared sample, written by hand: two steps of press, two of shear, two markers, two contacts.
#pragma once

#include <string>
#include <vector>

#include "tests/stages/dataset/report/sample_folder.h"

namespace tacipc {

inline const std::string kShearedSummary = R"(summary:
  frames: 5
  gel_vertices: 4
  face: -z
  element: averaged_volume
  friction_coefficient: 0.7
  newton_iterations: 40
  press_force_n: 1.2
  tangential_force_n: 0.84
  min_distance_m: 3.5e-05
  min_volume_ratio: 0.75
  intersections: 0
  inverted_tets: 0
  max_balance_relative: 2.0e-04
  max_pose_error_m: 0
  first_slip_time_s: 0.025
  gross_slip_time_s: 0.04
  press_end_frame: 2
  converged: true
  verdict: pass
  limits: {smallest_distance_m: 0, intersections: 0, inverted_tets: 0, volume_ratio: 0, balance_relative: 0.001, smallest_contact_n: 0.01, pose_error_m: 1.0e-09}
  per_frame:
    - {time_s: 0, phase: reference, press_force_n: 0, tangential_force_n: 0, balance_n: 0, balance_relative: 0, contact_area_mm2: 0, mean_pressure_pa: 0, peak_pressure_pa: 0, sticking: 0, slipping: 0, substeps: 0, newton_iterations: 0, min_gap_m: 5.0e-05, min_volume_ratio: 1, pose_error_m: 0}
    - {time_s: 0.01, phase: approach, press_force_n: 0, tangential_force_n: 0, balance_n: 1.0e-07, balance_relative: 1.0e-05, contact_area_mm2: 0, mean_pressure_pa: 0, peak_pressure_pa: 0, sticking: 0, slipping: 0, substeps: 1, newton_iterations: 1, min_gap_m: 4.5e-05, min_volume_ratio: 1, pose_error_m: 0}
    - {time_s: 0.02, phase: press, press_force_n: 1.25, tangential_force_n: 0.01, balance_n: 2.5e-04, balance_relative: 2.0e-04, contact_area_mm2: 5, mean_pressure_pa: 250000, peak_pressure_pa: 500000, sticking: 2, slipping: 0, substeps: 1, newton_iterations: 12, min_gap_m: 3.5e-05, min_volume_ratio: 0.8, pose_error_m: 0}
    - {time_s: 0.03, phase: shear, press_force_n: 1.22, tangential_force_n: 0.5, balance_n: 1.0e-05, balance_relative: 8.0e-06, contact_area_mm2: 5, mean_pressure_pa: 244000, peak_pressure_pa: 500000, sticking: 1, slipping: 1, substeps: 2, newton_iterations: 15, min_gap_m: 3.5e-05, min_volume_ratio: 0.75, pose_error_m: 0}
    - {time_s: 0.04, phase: shear, press_force_n: 1.2, tangential_force_n: 0.84, balance_n: 1.0e-05, balance_relative: 8.0e-06, contact_area_mm2: 5, mean_pressure_pa: 240000, peak_pressure_pa: 500000, sticking: 0, slipping: 2, substeps: 1, newton_iterations: 12, min_gap_m: 3.6e-05, min_volume_ratio: 0.76, pose_error_m: 0}
)";

inline const std::string kShearedMotion =
    "    motion:\n"
    "      - {kind: press, depth_mm: 0.5, steps: 2}\n"
    "      - {kind: shear, direction_deg: 90, distance_mm: 0.4, steps: 2}\n";

/// The record of a plain press with another motion and summary.
inline std::string sheared_record() {
  const std::string plain = kPressRecord;
  const std::string head = plain.substr(0, plain.find("summary:"));
  return replaced(head, "    motion: {kind: press, depth_mm: 0.5, steps: 2}\n", kShearedMotion) + kShearedSummary;
}

/// Gel vertices 1 and 3 lie on the front, at x = −1 and 1 mm, and follow the object's shear along y.
inline void write_sheared_arrays(const std::filesystem::path& press) {
  const std::vector<double> shear_m{0, 0, 0, 2e-4, 4e-4}, height_m{2.1e-3, 2.0e-3, 1.5e-3, 1.5e-3, 1.5e-3};
  std::vector<double> poses, positions, markers, displacement, wrench;
  for (std::size_t f = 0; f < 5; ++f) {
    const double s = shear_m[f];
    poses.insert(poses.end(), {1, 0, 0, 0, 0, 1, 0, s, 0, 0, 1, height_m[f], 0, 0, 0, 1});
    positions.insert(positions.end(), {0, 0, -2e-3, -1e-3, s, 0, 5e-3, 5e-3, -2e-3, 1e-3, s, 0});
    wrench.insert(wrench.end(), {0, 0, -1, 0, 0, 1e-3 * static_cast<double>(f)});
    const double spread = f >= 2 ? 1e-5 : 0.0;  // what the press does to markers
    for (const double x : {-1e-3, 1e-3}) {
      const double away = x < 0 ? -spread : spread;
      markers.insert(markers.end(), {x + away, s, 0});
      displacement.insert(displacement.end(), {away, s, 0, 0, s, 0});
    }
  }
  const std::vector<double> front{1, 3}, state{0, 0, 0, 0, 1, 1, 1, 2, 2, 2};
  write_npy(press / "object_pose.npy", {5, 4, 4}, poses.data());
  write_npy(press / "positions.npy", {5, 4, 3}, positions.data());
  write_npy(press / "wrench.npy", {5, 6}, wrench.data());
  write_npy(press / "markers.npy", {5, 2, 3}, markers.data());
  write_npy(press / "marker_displacement.npy", {5, 2, 2, 3}, displacement.data());
  write_npy(press / "front_vertices.npy", {2}, front.data());
  write_npy(press / "contact_state.npy", {5, 2}, state.data());
}

/// As `write_sample`, sheared, with pictures of its last frame and of the end of the press.
inline std::filesystem::path write_sheared_sample(const std::filesystem::path& root, const std::string& name = "drag") {
  std::filesystem::path sample = write_sample(root, name);
  write_file(sample / "press/press.yaml", sheared_record());
  write_sheared_arrays(sample / "press");
  for (const char* picture : {"tactile.png", "indentation.png", "normal.png"})
    write_flat_png(sample / "render/frame_0004" / picture, 40, 30, 90);
  return sample;
}

}  // namespace tacipc
