// Writes an MP4 file with one H.264 track by FFmpeg's libraries and x264.
#pragma once

#include <filesystem>
#include <memory>

#include "common/image/image.h"

namespace tacipc {

/// MP4 file. Frames are coded with one fixed quality (CRF 18) in one thread, as 4:2:0 with the colours of BT.709. Each
/// frame is coded from previous ones, every fiftieth by itself. The index precedes the frames, so a browser plays the
/// file while it loads. The file has no creation times: the same frames give the same bytes.
class Mp4File {
 public:
  /// Opens the file.
  /// \pre even sizes
  /// \throw DataError if a library refuses the settings, or the file cannot be written
  Mp4File(const std::filesystem::path& path, int width, int height);
  ~Mp4File();
  Mp4File(const Mp4File&) = delete;
  Mp4File& operator=(const Mp4File&) = delete;

  /// Adds a frame.
  /// \param seconds duration of the frame
  /// \pre RGB of that size
  /// \throw DataError if it cannot be written
  void add(const ByteImage& image, double seconds);
  /// Writes the remaining data and closes the file.
  /// \pre a frame was added
  /// \throw DataError if that fails
  void close();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tacipc
