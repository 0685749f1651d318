// A network of depthnet, without the library that trained it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/benchmark/trained_look.h"
#include "common/image/image.h"

namespace tacipc {

/// Reads depth by an ONNX file of depthnet (common/sample/depth_model.h). Each thread needs its own.
class DepthReader {
 public:
  /// \throw DataError if it is no such file or damaged, naming it
  explicit DepthReader(const std::filesystem::path& file);
  ~DepthReader();
  DepthReader(DepthReader&&) noexcept;
  DepthReader& operator=(DepthReader&&) = delete;

  /// The indentation, mm. \throw DataError, which begins with the name, if the image is not of the size that the
  /// network is for, or not of its reference's \pre three channels
  FloatImage depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference);

  /// Statistics of the training images; nothing if the file is of an earlier version.
  const std::optional<TrainedLook>& look() const { return look_; }
  /// \throw DataError, which begins with the name, if the image is not of the size that the network is for, or not of
  /// its reference's
  void check_size(const std::string& name, const ByteImage& image, const ByteImage& reference) const;

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  std::optional<TrainedLook> look_;
};

/// OpenCV says nothing by itself and stays in the thread that asks. To be called once, before any thread reads.
void set_up_opencv();

}  // namespace tacipc
