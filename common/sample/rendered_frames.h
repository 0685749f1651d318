// Which frames of a press are rendered: the key `frames` of a configuration of render, for all who read it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Frames that are rendered besides frame 0, the reference: the last one, the last of each phase of the motion, or all.
enum class RenderedFrames { last, phases, all };
/// The key `frames` of a configuration of render; `last` if it is absent.
RenderedFrames read_rendered_frames(ConfigReader& in);
/// The same for a reader that needs no other key of the file. \throw ConfigError
RenderedFrames read_rendered_frames(const std::filesystem::path& config);
/// Number of rendered frames of a motion, frame 0 included. \param frames of the motion after frame 0
/// \param kinds of its phases; neighbouring phases of one kind count as one
int count_rendered(RenderedFrames which, int frames, const std::vector<std::string>& kinds);

}  // namespace tacipc
