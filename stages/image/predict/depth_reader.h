// Evaluates a network of depthnet without the library that trained it.
#pragma once

#include <memory>
#include <string>

#include "common/benchmark/depth_model.h"
#include "common/image/image.h"

namespace tacipc {

/// Estimates depth by a network. OpenCV gets the graph that this class builds from the model, never a file's own graph.
/// Each thread needs its own object.
class DepthReader {
 public:
  /// \param model_name text that begins messages
  DepthReader(const DepthModel& model, std::string model_name);
  ~DepthReader();
  DepthReader(DepthReader&&) noexcept;
  DepthReader& operator=(DepthReader&&) = delete;

  /// Indentation, mm.
  /// \pre three channels
  /// \throw DataError, starting with `name`, if the image does not have the network's size or that of its reference
  /// \throw DataError, with the model's name and `name`, if the prediction has numbers that are not finite
  FloatImage depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference);

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  std::string model_name_;
};

/// Checks an image.
/// \throw DataError, starting with `name`, if it does not have the network's size or that of its reference
void check_size(const DepthModel& model, const std::string& name, const ByteImage& image, const ByteImage& reference);

/// Silences OpenCV and keeps it in the calling thread. To be called once, before any thread estimates depth.
void set_up_opencv();

}  // namespace tacipc
