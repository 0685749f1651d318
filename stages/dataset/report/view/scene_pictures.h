// Pictures of a scene at a few instants, all from where one sees best what moves.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "stages/dataset/report/timeline.h"
#include "stages/dataset/report/view/raster.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// An instant that is shown, by its place among the frames of the view.
struct PicturedInstant {
  std::size_t shown = 0;
  std::string what;  // "start", "first contact", "end"; empty: in between
};

/// The start, the first contact, two in between and the end, as far as they differ. \param first_contact a frame of the
/// scene; nothing: none, and three in between
std::vector<PicturedInstant> pictured_instants(const SceneView& view, std::optional<int> first_contact);

/// Colours of the pictures, so that a caption can name them.
namespace picture_colors {
inline constexpr Color kGel{120, 190, 214}, kObject{232, 148, 72}, kSoft{140, 190, 170}, kFixed{214, 206, 192},
    kRobot{140, 148, 160};
}  // namespace picture_colors

/// Where one sees from: across the direction in which the first gel looks, from somewhat above; so near that the gels,
/// what moves freely and the robot's parts right beside them just fit at every instant. \pre the view has a gel
Viewpoint scene_viewpoint(const SceneView& view, double aspect);

/// The pictures side by side, each with its words above it. `frames`: all of the scene.
ByteImage scene_pictures(const SceneView& view, const std::vector<PicturedInstant>& instants,
                         const std::vector<Instant>& frames, int width, int height);

}  // namespace tacipc
