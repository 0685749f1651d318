// The U-Net of `depthnet` as a sequence of steps, for code that writes it as TorchScript (depthnet/script_writer.h) or
// ONNX (depth_model.h).
#pragma once

#include <string>

namespace tacipc {

/// Size of a U-Net (Ronneberger et al. 2015): on each level two 3 × 3 convolutions, then half the size and twice the
/// channels; on the way up, maps of equal size are concatenated.
struct NetworkConfig {
  static constexpr int kMostLevels = 6, kMostChannels = 256, kMostReduction = 16;

  int levels = 4;  // number of times the size is halved
  int base_channels = 16;
  int reduction = 2;  // edge length, in pixels, of the squares over which the network's input is averaged

  bool operator==(const NetworkConfig&) const = default;
};

/// Writes consecutive steps. The first step receives the network's input: six channels, the change against the
/// reference and the reference, in 8-bit levels.
class NetworkWriter {
 public:
  virtual ~NetworkWriter() = default;
  /// Writes change / `change_codes` and reference / `reference_codes` − 1, with the last rows and columns repeated up
  /// to a multiple of `multiple`.
  virtual void begin(double change_codes, double reference_codes, int multiple) = 0;
  /// Writes a convolution of `width` × `width` with zero padding, followed by max(0, x) if `rectified`. Weights
  /// and biases are named weight_name(n) and bias_name(n), with n the convolution's number.
  virtual void convolution(int in, int out, int width, bool rectified) = 0;
  /// Writes max pooling over 2 × 2.
  virtual void halve() = 0;
  /// Keeps the current maps for enlarge_and_join().
  virtual void keep(int level) = 0;
  /// Writes upsampling to twice the size, bilinear between pixel centres, and concatenation after the kept channels.
  virtual void enlarge_and_join(int level) = 0;
  /// Writes the removal of the repeated rows and columns.
  virtual void end() = 0;
};

/// Returns the number of channels of a level's maps; the first level is 0.
int channels_of(const NetworkConfig& config, int level);

/// Number of input channels.
inline constexpr int kSeenChannels = 6;

/// Writes the contracting path after begin(), down to the maps of the last level, the smallest.
/// \pre begin() left a size that can be halved `levels` times
void write_contracting_path(const NetworkConfig& config, NetworkWriter& writer);
/// Writes the whole network, up to one channel of the size of the first maps.
void write_unet(const NetworkConfig& config, NetworkWriter& writer);

/// Return the names of a convolution's weights and biases.
std::string weight_name(int convolution);
std::string bias_name(int convolution);

}  // namespace tacipc
