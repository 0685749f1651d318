#include "stages/image/depthnet/grasp_set.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <variant>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/sha256.h"
#include "common/sample/motion.h"
#include "stages/image/depthnet/packed_image.h"

namespace tacipc {
namespace {

constexpr const char* kHeld = "lifted";
constexpr const char* kFingers[] = {"left", "right"};

const Value* attribute(const Value::Map& attributes, const std::string& name) {
  const auto found = std::ranges::find_if(attributes, [&](const auto& line) { return line.first == name; });
  return found == attributes.end() ? nullptr : &found->second;
}

std::string text(const Value::Map& attributes, const std::string& name) {
  const Value* value = attribute(attributes, name);
  const std::string* words = value ? std::get_if<std::string>(&value->data()) : nullptr;
  if (!words) throw DataError("has no attribute {} that is a text", name);
  return *words;
}

double number(const Value::Map& attributes, const std::string& name) {
  if (const Value* value = attribute(attributes, name)) {
    if (const auto* whole = std::get_if<std::int64_t>(&value->data())) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&value->data())) return *real;
  }
  throw DataError("has no attribute {} that is a number", name);
}

/// Numbers of a field, one per frame.
/// \throw DataError if their number differs
std::vector<double> per_frame(const Hdf5Reader& shard, const std::string& field, std::size_t frames) {
  if (!shard.has(field)) throw DataError("has no {}: packed without", field);
  std::vector<double> numbers = from_bytes(shard.type(field), shard.read(field));
  if (numbers.size() != frames) throw DataError("{}: {} numbers of {} frames", field, numbers.size(), frames);
  return numbers;
}

/// Last frame of the first phase `close`; nothing if there is no such frame.
std::optional<std::size_t> closed_at(const std::vector<double>& phases) {
  const auto closes = [](double phase) { return phase == static_cast<double>(PhaseKind::close); };
  const auto closing = std::ranges::find_if(phases, closes);
  if (closing == phases.end()) return std::nullopt;
  return static_cast<std::size_t>(std::find_if_not(closing, phases.end(), closes) - phases.begin()) - 1;
}

/// Reads a finger's images into a grasp.
/// \return false if there are not enough frames
/// \throw DataError as `read_grasps`
bool take_images(GraspItem& item, std::size_t finger, const Hdf5Reader& shard, const std::string& sample,
                 std::size_t count, double judged_frame, const torch::jit::Module& network) {
  const std::string obs = sample + "/obs/", rgb = obs + "rgb";
  if (!shard.has(rgb)) throw DataError("has no {}: packed without", rgb);
  const std::size_t frames = shard.shape(rgb).front();
  const auto numbers = [&](const char* field) { return per_frame(shard, obs + field, frames); };
  const std::optional<std::size_t> begin = closed_at(numbers("phase"));
  if (!begin || *begin + count > frames) return false;
  const std::size_t last = *begin + count - 1;
  if (numbers("frame")[last] >= judged_frame)
    throw DataError(
        "{}: its outcome was judged in frame {}, not after the first {} frames since it was closed: fewer `frames`, or "
        "a longer motion",
        sample, judged_frame, count);
  const std::vector<double> times_s = numbers("time_s");
  item.seen_s = times_s[last] - times_s[*begin];
  item.slip_mm = numbers("slip_mm")[last];
  const torch::NoGradGuard no_gradients;
  std::vector<torch::Tensor> images;
  for (std::size_t t = *begin; t <= last; ++t)
    images.push_back(tensor_of(packed_image<std::uint8_t>(shard, rgb, NumberType::u8, 3, t)));
  const torch::Tensor reference = tensor_of(packed_image<std::uint8_t>(shard, rgb, NumberType::u8, 3, 0));
  item.fingers[finger] = network.get_method("reduced")({torch::cat(images), reference})
                             .toTensor()
                             .narrow(1, 0, 3)
                             .to(torch::kHalf)
                             .contiguous();
  return true;
}

}  // namespace

std::vector<GraspItem> read_grasps(const std::vector<std::pair<std::string, std::filesystem::path>>& shards, int frames,
                                   const torch::jit::Module& network) {
  std::map<std::string, GraspItem> grasps;
  std::size_t fingers = 0;
  for (const auto& [name, path] : shards) {
    checked_sha256(path);
    const Hdf5Reader shard(path);
    try {
      for (const std::string& id : shard.names("/data")) {
        const std::string sample = "/data/" + id;
        const Value::Map attributes = shard.attributes(sample);
        if (!attribute(attributes, "grasp")) continue;
        const std::string grasp = text(attributes, "grasp"), finger = text(attributes, "finger");
        const auto which = std::find(std::begin(kFingers), std::end(kFingers), finger) - std::begin(kFingers);
        if (which == 2) throw DataError("{}: its finger is {}, neither left nor right", id, finger);
        GraspItem& item = grasps[grasp];
        if (!take_images(item, static_cast<std::size_t>(which), shard, sample, static_cast<std::size_t>(frames),
                         number(attributes, "judged_frame"), network))
          continue;
        item.name = grasp;
        item.object = text(attributes, "object_id");
        item.split = text(attributes, "split");
        item.outcome = text(attributes, "outcome");
        item.held = item.outcome == kHeld;
        item.grip_n += 0.5 * number(attributes, "grip_N");
        show_progress(0.0, fmt::format("reading: {} fingers", ++fingers));
      }
    } catch (const DataError& error) {
      throw DataError("{}: {}", path.string(), error.what());
    }
  }
  std::vector<GraspItem> items;
  for (auto& [name, item] : grasps) {
    if (item.fingers[0].defined() && item.fingers[1].defined())
      items.push_back(std::move(item));
    else
      log_warning("{}: passed over: the shards have not {} frames of both fingers after they have closed", name,
                  frames);
  }
  return items;
}

}  // namespace tacipc
