// Frames as an H.264 stream, by OpenH264.
#pragma once

#include <memory>
#include <string>

#include "common/image/image.h"

namespace tacipc {

/// A coded frame: its NAL units, each behind its length as four bytes, big-endian.
struct CodedFrame {
  std::string bytes;
  bool key = false;  // can be decoded without those before it
};

/// Codes with one fixed quantiser and in one thread: the same frames give the same bytes.
class H264Encoder {
 public:
  /// \pre even; at most 3840 x 2160 \throw DataError if the library refuses them
  H264Encoder(int width, int height);
  ~H264Encoder();
  H264Encoder(const H264Encoder&) = delete;
  H264Encoder& operator=(const H264Encoder&) = delete;

  /// \pre RGB of that size \throw DataError if the library fails
  CodedFrame encode(const ByteImage& image);
  /// Sequence and picture parameter set, without start codes. \pre a frame was coded
  const std::string& sequence_parameters() const { return sequence_; }
  const std::string& picture_parameters() const { return picture_; }

 private:
  struct Codec;
  std::unique_ptr<Codec> codec_;
  std::string sequence_, picture_;
};

}  // namespace tacipc
