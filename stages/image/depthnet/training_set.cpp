#include "stages/image/depthnet/training_set.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/sha256.h"
#include "common/sample/render_folder.h"
#include "stages/image/depthnet/packed_image.h"

namespace tacipc {
namespace {

void check_sizes(const DepthImage& one) {
  const auto& [name, split, image, reference, depth] = one;
  if (image.width != reference.width || image.height != reference.height || image.width != depth.width ||
      image.height != depth.height)
    throw DataError("{}: the image has {} x {} pixels, its reference {} x {}, its depth {} x {}", name, image.width,
                    image.height, reference.width, reference.height, depth.width, depth.height);
}

}  // namespace

void read_packed(const std::filesystem::path& path, const std::vector<std::string>& splits, bool last_frame,
                 const TakeDepthImage& take) {
  checked_sha256(path);
  const Hdf5Reader shard(path);
  try {
    for (const std::string& id : shard.names("/data")) {
      DepthImage one{.split = shard.text_attribute("/data/" + id, "split")};
      if (std::ranges::find(splits, one.split) == splits.end()) continue;
      const std::string rgb = "/data/" + id + "/obs/rgb", depth = "/data/" + id + "/obs/indentation_mm";
      for (const std::string& field : {rgb, depth})
        if (!shard.has(field)) throw DataError("has no {}: packed without", field);
      const std::size_t frames = shard.shape(rgb).front();
      if (frames < 2) {
        log_warning("{}: {} has no frame after its reference", path.string(), id);
        continue;
      }
      one.reference = packed_image<std::uint8_t>(shard, rgb, NumberType::u8, 3, 0);
      for (std::size_t t = last_frame ? frames - 1 : 1; t < frames; ++t) {
        one.name = id + "/" + frame_name(t);
        one.image = packed_image<std::uint8_t>(shard, rgb, NumberType::u8, 3, t);
        one.depth_mm = packed_image<float>(shard, depth, NumberType::f32, 1, t);
        check_sizes(one);
        take(one);
      }
    }
  } catch (const DataError& error) {
    throw DataError("{}: {}", path.string(), error.what());
  }
}

void read_rendered(const std::filesystem::path& folder, bool last_frame, const TakeDepthImage& take) {
  const std::vector<std::size_t> frames = frames_in(folder);
  if (frames.size() < 2 || frames.front() != 0) throw DataError("{}: holds no frames of render", folder.string());
  constexpr float kMmPerMetre = 1e3F;
  DepthImage one{.reference = read_png(frame_path(folder, 0, FrameFile::tactile), 3)};
  for (std::size_t k = last_frame ? frames.size() - 1 : 1; k < frames.size(); ++k) {
    one.name = (folder / frame_name(frames[k])).string();
    one.image = read_png(frame_path(folder, frames[k], FrameFile::tactile), 3);
    one.depth_mm = read_exr(frame_path(folder, frames[k], FrameFile::indentation), {"Y"});
    for (float& depth : one.depth_mm.pixels) depth *= kMmPerMetre;
    check_sizes(one);
    take(one);
  }
}

DepthItem item_of(const DepthImage& image, const torch::jit::Module& network, int reduction) {
  const torch::NoGradGuard no_gradients;
  const torch::Tensor both =
      network.get_method("reduced")({tensor_of(image.image), tensor_of(image.reference)}).toTensor().squeeze(0);
  torch::Tensor depth_mm = torch::empty({1, image.depth_mm.height, image.depth_mm.width});
  std::ranges::copy(image.depth_mm.pixels, depth_mm.data_ptr<float>());
  depth_mm = torch::avg_pool2d(depth_mm, {reduction, reduction}, {reduction, reduction}, {0, 0}, true, false);
  if (!depth_mm.isfinite().any().item<bool>()) throw DataError("{}: no pixel has a depth", image.name);
  return {.name = image.name,
          .size = {image.image.height, image.image.width},
          .change = both.narrow(0, 0, 3).to(torch::kHalf),
          .reference = both.narrow(0, 3, 3).to(torch::kHalf),
          .depth_mm = depth_mm.to(torch::kHalf)};
}

}  // namespace tacipc
