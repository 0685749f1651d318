// What render reads from a press's folder: positions, and contact and markers where they are there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/npy.h"
#include "common/optics/membrane.h"
#include "common/optics/trace.h"
#include "common/tet_mesh.h"
#include "common/types.h"
#include "stages/render/deformation.h"

namespace tacipc {

struct PressFrames {
  NpyArray positions = {};                               // (frames, #V, 3) m
  std::optional<NpyArray> contact_force = std::nullopt;  // (frames, #V_front, 2, 3) N
  std::optional<NpyArray> contact_state = std::nullopt;  // (frames, #V_front)
  std::optional<NpyArray> markers = std::nullopt;        // (frames, #M, 3) m

  std::size_t num_frames() const { return positions.shape[0]; }
};

/// Positions of one frame of positions.npy. \pre the array has shape (frames, vertices, 3)
Positions frame_positions(const NpyArray& positions, std::size_t frame);

/// \throw DataError unless the array has shape (frames, #V, 3) with finite numbers and frame 0 is the gel at rest
/// (within 1e-6 m). `name` stands for the file in messages.
void check_positions(const NpyArray& positions, const TetMesh& gel, const std::string& name);

/// \throw DataError if the press did not finish, or a file does not fit the gel or the other files. Contact (both files
/// or none) and markers may be absent.
PressFrames read_press(const std::filesystem::path& folder, const TetMesh& gel);

/// Contact state and traction of one frame on the membrane's vertices: normal plus friction force over the vertex's
/// share of the deformed area, a third of each triangle around it.
SurfaceFields surface_fields(const PressFrames& press, std::size_t frame, const Membrane& membrane);

/// Markers of one frame, #M × 3, m; no rows if the press has none.
Positions frame_markers(const PressFrames& press, std::size_t frame);

/// The front face of a pressed gel. Refers to both, which must outlive it.
class PressedGel : public Deformation {
 public:
  PressedGel(const TetMesh& gel, const PressFrames& press) : gel_(gel), press_(press) {}
  std::size_t num_frames() const override { return press_.num_frames(); }
  Membrane at_rest() const override { return make_membrane(gel_, gel_.positions); }
  void move(Membrane& membrane, std::size_t frame) const override {
    move_membrane(membrane, frame_positions(press_.positions, frame));
  }
  SurfaceFields fields(std::size_t frame, const Membrane& membrane) const override {
    return surface_fields(press_, frame, membrane);
  }
  Positions markers(std::size_t frame) const override { return frame_markers(press_, frame); }

 private:
  const TetMesh& gel_;
  const PressFrames& press_;
};

}  // namespace tacipc
