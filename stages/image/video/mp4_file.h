// An MP4 file of one H.264 track, by FFmpeg's libraries and x264.
#pragma once

#include <filesystem>
#include <memory>

#include "common/image/image.h"

namespace tacipc {

/// Frames are coded with one fixed quality (CRF 18) in one thread, as 4:2:0 with the colours of BT.709, each from those
/// before it, every fiftieth by itself. The index lies before the frames, so that a browser shows them as they arrive.
/// The file has no times of its making: the same frames give the same bytes.
class Mp4File {
 public:
  /// \pre even sizes \throw DataError if a library refuses them, or the file cannot be written
  Mp4File(const std::filesystem::path& path, int width, int height);
  ~Mp4File();
  Mp4File(const Mp4File&) = delete;
  Mp4File& operator=(const Mp4File&) = delete;

  /// \param seconds for which the frame is shown \pre RGB of that size \throw DataError if it cannot be written
  void add(const ByteImage& image, double seconds);
  /// Writes what is left. \pre a frame was added \throw DataError
  void close();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tacipc
