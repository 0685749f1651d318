// A network of depthnet, without the library that trained it.
#pragma once

#include <memory>
#include <string>

#include "common/benchmark/depth_model.h"
#include "common/image/image.h"

namespace tacipc {

/// Reads depth by a network. OpenCV is given the graph that we build from it, never a file's own. Each thread needs its
/// own.
class DepthReader {
 public:
  /// `model_name` begins its messages.
  DepthReader(const DepthModel& model, std::string model_name);
  ~DepthReader();
  DepthReader(DepthReader&&) noexcept;
  DepthReader& operator=(DepthReader&&) = delete;

  /// The indentation, mm. \throw DataError, which begins with the name, if the image is not of the size that the
  /// network is for, or not of its reference's; DataError with the model's name and this one if the answer has numbers
  /// that are not finite \pre three channels
  FloatImage depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference);

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  std::string model_name_;
};

/// \throw DataError, which begins with the name, if the image is not of the size that the network is for, or not of its
/// reference's
void check_size(const DepthModel& model, const std::string& name, const ByteImage& image, const ByteImage& reference);

/// OpenCV says nothing by itself and stays in the thread that asks. To be called once, before any thread reads.
void set_up_opencv();

}  // namespace tacipc
