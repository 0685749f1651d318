// The network of depthnet, step by step, for whoever writes it down: as TorchScript (depthnet/script_writer.h) or ONNX
// (depth_model.h).
#pragma once

#include <string>

namespace tacipc {

/// A U-Net (Ronneberger et al. 2015): on each level two 3 × 3 convolutions, then half the size and twice the channels;
/// on the way back the maps of the same size are joined.
struct NetworkConfig {
  static constexpr int kMostLevels = 6, kMostChannels = 256, kMostReduction = 16;

  int levels = 4;  // times the size is halved
  int base_channels = 16;
  int reduction = 2;  // the network sees means over squares of this many pixels

  bool operator==(const NetworkConfig&) const = default;
};

/// Writes down steps that follow each other. The first one gets what the network sees: six channels, the change against
/// the reference and the reference, in codes.
class NetworkWriter {
 public:
  virtual ~NetworkWriter() = default;
  /// change / `change_codes` and reference / `reference_codes` − 1; last rows and columns repeated up to a multiple.
  virtual void begin(double change_codes, double reference_codes, int multiple) = 0;
  /// `width` × `width`, zeros around; then max(0, x) or not. Its weights are `weight_name` and `bias_name` of its
  /// number.
  virtual void convolution(int in, int out, int width, bool rectified) = 0;
  /// The largest of 2 × 2.
  virtual void halve() = 0;
  virtual void keep(int level) = 0;
  /// Twice the size, bilinear by the pixels' centres, behind the channels that were kept.
  virtual void enlarge_and_join(int level) = 0;
  /// Without the repeated rows and columns.
  virtual void end() = 0;
};

/// Channels of the maps of a level, the first one 0.
int channels_of(const NetworkConfig& config, int level);

/// Channels that the first level sees.
inline constexpr int kSeenChannels = 6;

/// After the beginning: to the maps of the last level, the smallest. Whatever begins leaves a size that can be halved
/// `levels` times.
void write_contracting_path(const NetworkConfig& config, NetworkWriter& writer);
/// All of it, to one channel of the size of the first maps.
void write_unet(const NetworkConfig& config, NetworkWriter& writer);

std::string weight_name(int convolution);
std::string bias_name(int convolution);

}  // namespace tacipc
