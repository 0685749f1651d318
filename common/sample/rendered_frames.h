// Selection of the frames of a press run that are rendered: the key `frames` of a configuration of render.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Frames rendered in addition to frame 0: the last one, the last of each phase of the motion, or all.
enum class RenderedFrames { last, phases, all };
/// Reads the key `frames` of a configuration of render; `last` if it is absent.
RenderedFrames read_rendered_frames(ConfigReader& in);
/// Reads the key `frames` of a file and ignores all others.
/// \throw ConfigError if the value is not allowed
RenderedFrames read_rendered_frames(const std::filesystem::path& config);
/// Returns the number of rendered frames of a motion, including frame 0.
/// \param frames number of frames after frame 0
/// \param kinds kinds of the motion's phases; neighbouring phases of one kind count as one
int count_rendered(RenderedFrames which, int frames, const std::vector<std::string>& kinds);

}  // namespace tacipc
