// Front face of a pressed gel as input of render, from a press folder.
#pragma once

#include <filesystem>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/sample/press_folder.h"
#include "stages/image/render/deformation.h"

namespace tacipc {

/// Keeps a reference to the gel, which must outlive this object.
class PressedGel : public Deformation {
 public:
  /// Opens a press. Contact (both files or none) and markers may be absent.
  /// \throw DataError if the press did not finish, a file does not fit the gel or the other files, a position is not
  /// finite, or frame 0 is not the gel at rest (within 1e-6 m)
  PressedGel(const std::filesystem::path& press, const TetMesh& gel);

  std::size_t num_frames() const override { return press_.extent(PressArray::positions, kFrames); }
  std::vector<std::size_t> phase_ends() const override;
  Membrane at_rest() const override { return make_membrane(gel_, gel_.positions); }
  void move(Membrane& membrane, std::size_t frame) const override { move_membrane(membrane, positions(frame)); }
  SurfaceFields fields(std::size_t frame, const Membrane& membrane) const override;
  Positions markers(std::size_t frame) const override;
  /// Vertex positions of the whole gel, m.
  Positions positions(std::size_t frame) const { return press_.positions(frame); }

 private:
  const TetMesh& gel_;
  PressFolder press_;
};

}  // namespace tacipc
