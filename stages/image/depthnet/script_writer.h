// Writes a network as a method of a TorchScript module, with its weights.
#pragma once

#include <torch/script.h>

#include <cstdint>
#include <string>

#include "common/benchmark/unet.h"

namespace tacipc {

/// Writes the source of a method `name(x)` and makes its weights, drawn by He et al. 2015 from the seed.
class ScriptWriter : public NetworkWriter {
 public:
  ScriptWriter(torch::jit::Module& module, const std::string& name, std::uint64_t seed);

  void begin(double change_codes, double reference_codes, int multiple) override;
  void convolution(int in, int out, int width, bool rectified) override;
  void halve() override;
  void keep(int level) override;
  void enlarge_and_join(int level) override;
  void end() override;

  /// Begins a network for sequences of `images` changes against a reference, (N × images, 3, h, w), in grey levels.
  /// Each is divided by `change_codes`, and is followed by its difference from the first of its sequence, divided by
  /// `since_codes`; last rows and columns are repeated up to a multiple.
  void begin_sequences(int images, double change_codes, double since_codes, int multiple);
  /// Mean and maximum of each channel, concatenated over `images` successive images: (N × images, C, h, w) → (N, images
  /// × 2 C, 1, 1).
  void pool_and_join(int images);
  /// Ends a network without maps: (N, 1, 1, 1) → (N).
  void end_with_number();

 private:
  void pad(int multiple);
  void line(const std::string& text) { source_ += "    " + text + "\n"; }

  torch::jit::Module& module_;
  std::uint64_t seed_;
  int count_ = 0;
  std::string source_;
};

/// Adds the method `reduced(image, reference)`: u8 (N, H, W, 3) both, or one reference for all → input of the network,
/// f32 (N, 6, h, w). It holds means over squares of the change against the reference, then of the reference, in grey
/// levels.
void define_reduced(torch::jit::Module& module, int reduction);

}  // namespace tacipc
