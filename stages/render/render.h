// Tactile images of the frames of one press.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/config.h"
#include "common/npy.h"
#include "common/sensor.h"
#include "common/tet_mesh.h"
#include "stages/render/develop.h"
#include "stages/render/trace.h"

namespace tacipc {

struct RenderConfig {
  bool all_frames = false;  // else the last one, and frame 0 as the reference
  TraceSettings trace;
  NoiseModel noise;  // of the synthetic reference

  static RenderConfig read(ConfigReader& in);
};

/// Positions of one frame of positions.npy. \pre the array has shape (frames, vertices, 3)
Positions frame_positions(const NpyArray& positions, std::size_t frame);

/// \throw DataError unless the array has shape (frames, #V, 3) with finite numbers and frame 0 is the gel at rest
/// (within 1e-6 m). `name` stands for the file in messages.
void check_positions(const NpyArray& positions, const TetMesh& gel, const std::string& name);

/// The photograph named by the sensor. \throw DataError if its size is not the camera's.
ByteImage read_reference(const std::filesystem::path& path, const Camera& camera);

struct RenderedFrame {
  std::size_t index = 0;
  TraceResult trace;
  FloatImage linear;
  TactileImage tactile;
};

struct RenderSummary {
  std::vector<std::size_t> frames;
  double exposure = 0.0;
  double reference_mean_code = 0.0;
  double clipped_fraction = 0.0;  // largest of all frames
  std::int64_t rays = 0;
  std::int64_t nudged_rays = 0;
  std::int64_t outside_rays = 0;
  double max_indentation_m = 0.0;  // in the last frame
};

/// Colours from 0 to the frame's deepest indentation (to 1 µm at least).
ByteImage indentation_picture(const FloatImage& indentation);

/// Renders frame 0 (the reference, from the gel at rest), then the frames asked for, and hands each to `deliver`.
/// `reference` is the real photograph, absent for a synthetic one.
RenderSummary render(const Sensor& sensor, const RenderConfig& config, const TetMesh& gel, const NpyArray& positions,
                     const std::optional<ByteImage>& reference,
                     const std::function<void(const RenderedFrame&)>& deliver);

}  // namespace tacipc
