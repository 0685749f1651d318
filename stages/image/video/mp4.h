// An MP4 file of one H.264 track.
#pragma once

#include <string>
#include <vector>

#include "stages/image/video/h264.h"

namespace tacipc {

struct Mp4Track {
  int width = 0, height = 0;
  std::vector<double> seconds;  // that each frame is shown
  std::vector<CodedFrame> frames = {};
  std::string sequence_parameters = {}, picture_parameters = {};  // of the stream
};

/// The index before the frames, so that a browser shows them as they arrive; boxes of ISO/IEC 14496-12, avc1 and avcC
/// of 14496-15. No times of its making: the same track gives the same bytes. \throw DataError if it would be 4 GiB or
/// longer
std::string mp4_bytes(const Mp4Track& track);

}  // namespace tacipc
