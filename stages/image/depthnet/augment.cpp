#include "stages/image/depthnet/augment.h"

#include "common/base/rng.h"

namespace tacipc {
namespace {

/// Random numbers of one item in one epoch.
class Draws {
 public:
  Draws(std::uint64_t seed, int epoch, std::size_t index)
      : seed_(seed), stream_(mix_bits(random_bits(hash_of("augment"), static_cast<std::uint64_t>(epoch), index))) {}
  /// Number uniform in ±size.
  double within(double size) { return size * (2.0 * uniform() - 1.0); }
  double uniform() { return random_uniform(seed_, stream_, counter_++); }
  /// Three numbers, one per channel.
  torch::Tensor channels(double size) {
    torch::Tensor three = torch::empty({3, 1, 1});
    for (int c = 0; c < 3; ++c) three.data_ptr<float>()[c] = static_cast<float>(within(size));
    return three;
  }
  void add_noise(torch::Tensor& image, double sigma) {
    float* values = image.data_ptr<float>();
    for (std::int64_t i = 0; i < image.numel(); ++i)
      values[i] += static_cast<float>(sigma * random_normal(seed_ + 1, stream_, static_cast<std::uint64_t>(i)));
  }

 private:
  std::uint64_t seed_, stream_, counter_ = 0;
};

torch::Tensor shifted(const torch::Tensor& image, int dx, int dy) {
  const std::int64_t height = image.size(2), width = image.size(3);
  const int px = std::abs(dx), py = std::abs(dy);
  return torch::replication_pad2d(image, {px, px, py, py}).narrow(2, py - dy, height).narrow(3, px - dx, width);
}

}  // namespace

SensorExample disturbed(const torch::Tensor& change, const torch::Tensor& reference, const AugmentationConfig& config,
                        std::uint64_t seed, int epoch, std::size_t index) {
  Draws draws(seed, epoch, index);
  const torch::Tensor gain = draws.channels(config.gain), drift = draws.channels(config.drift_codes);
  torch::Tensor seen = (change.to(torch::kFloat) * (1.0 + gain) + drift).contiguous();
  draws.add_noise(seen, config.noise_codes * draws.uniform());
  if (reference.defined()) {
    const torch::Tensor rest = reference.to(torch::kFloat) + draws.channels(config.reference_codes);
    seen = torch::cat({seen, rest.expand_as(seen)}, 1);
  }
  const auto whole = [&] { return static_cast<int>(std::lround(draws.within(config.shift_px + 0.5 - 1e-9))); };
  const int dx = whole(), dy = whole();
  return {.input = shifted(seen, dx, dy), .dx = dx, .dy = dy};
}

DepthExample example_of(const DepthItem& item) {
  return {.input = torch::cat({item.change, item.reference}).to(torch::kFloat).unsqueeze(0),
          .depth_mm = item.depth_mm.to(torch::kFloat).unsqueeze(0)};
}

DepthExample augmented(const DepthItem& item, const AugmentationConfig& config, std::uint64_t seed, int epoch,
                       std::size_t index) {
  const SensorExample seen = disturbed(item.change.unsqueeze(0), item.reference, config, seed, epoch, index);
  return {.input = seen.input, .depth_mm = shifted(item.depth_mm.to(torch::kFloat).unsqueeze(0), seen.dx, seen.dy)};
}

}  // namespace tacipc
