#include "common/mesh/gltf_numbers.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "common/base/error.h"
#include "common/base/text_reader.h"
#include "common/mesh/scene_parts.h"

namespace tacipc {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers of buffers are read as they lie in memory");

/// Returns the size in bytes; 0 for an unknown type.
std::size_t size_of(int component_type) {
  switch (component_type) {
    case kGltfByte:
    case kGltfUnsignedByte: return 1;
    case kGltfShort:
    case kGltfUnsignedShort: return 2;
    case kGltfUnsignedInt:
    case kGltfFloat: return 4;
    default: return 0;
  }
}

template <typename T>
double loaded(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// Reads a number. Normalized integers are fractions of the largest integer.
double number_at(const char* bytes, int component_type, bool normalized) {
  const auto scaled = [&](double value, double largest) {
    return normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (component_type) {
    case kGltfByte: return scaled(loaded<std::int8_t>(bytes), 127.0);
    case kGltfUnsignedByte: return scaled(loaded<std::uint8_t>(bytes), 255.0);
    case kGltfShort: return scaled(loaded<std::int16_t>(bytes), 32767.0);
    case kGltfUnsignedShort: return scaled(loaded<std::uint16_t>(bytes), 65535.0);
    case kGltfUnsignedInt: return loaded<std::uint32_t>(bytes);
    default: return loaded<float>(bytes);
  }
}

std::size_t components_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

}  // namespace

GltfNumbers::GltfNumbers(const GltfFile& file, std::size_t accessor, const std::string& type, const std::string& name)
    : file_(file), accessor_(file.accessors[accessor]), place_(fmt::format("{}: accessors[{}]", name, accessor)) {
  if (accessor_.type != type) fail(fmt::format("is {}, not {}", shown(accessor_.type), type));
  component_size_ = size_of(accessor_.component_type);
  if (component_size_ == 0)
    fail(fmt::format("has the component type {}, which there is not", accessor_.component_type));
  element_size_ = component_size_ * components_of(type);
  constexpr std::size_t kMostElements = 3 * kMostSceneElements;
  if (accessor_.count > kMostElements)
    fail(fmt::format("has {} elements, more than {}", accessor_.count, kMostElements));
  if (accessor_.view) {
    const std::size_t given = file.views[*accessor_.view].stride;
    stride_ = given == 0 ? element_size_ : given;
    base_ = data_of(*accessor_.view, accessor_.offset, accessor_.count, element_size_, stride_);
  }
  if (accessor_.sparse) read_sparse(*accessor_.sparse);
}

double GltfNumbers::at(std::size_t element, std::size_t component) const {
  const char* bytes = base_ == nullptr ? nullptr : base_ + element * stride_;
  if (!replaced_.empty()) {
    const auto found = std::ranges::lower_bound(replaced_, element);
    if (found != replaced_.end() && *found == element)
      bytes = values_ + static_cast<std::size_t>(found - replaced_.begin()) * element_size_;
  }
  if (bytes == nullptr) return 0.0;
  return number_at(bytes + component * component_size_, accessor_.component_type, accessor_.normalized);
}

void GltfNumbers::fail(const std::string& reason) const { throw DataError("{} {}", place_, reason); }

const char* GltfNumbers::data_of(std::size_t view, std::size_t offset, std::size_t count, std::size_t size,
                                 std::size_t stride) const {
  const GltfView& of = file_.views[view];
  // None of these products overflows: counts and strides are checked, or are below the size of a view.
  const bool fits = offset <= of.length && (count <= 1 || stride <= of.length) &&
                    (count == 0 || (count - 1) * stride + size <= of.length - offset);
  if (!fits) fail(fmt::format("reaches beyond the {} bytes of bufferViews[{}]", of.length, view));
  return file_.buffers[of.buffer].data() + of.offset + offset;
}

void GltfNumbers::read_sparse(const GltfSparse& sparse) {
  const std::size_t size = size_of(sparse.indices_type);
  const int type = sparse.indices_type;
  if (type != kGltfUnsignedByte && type != kGltfUnsignedShort && type != kGltfUnsignedInt)
    fail("has sparse indices that are no whole numbers from 0");
  if (sparse.count > accessor_.count) fail("has more sparse elements than elements");
  const char* indices = data_of(sparse.indices_view, sparse.indices_offset, sparse.count, size, size);
  values_ = data_of(sparse.values_view, sparse.values_offset, sparse.count, element_size_, element_size_);
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const auto element = static_cast<std::size_t>(number_at(indices + i * size, sparse.indices_type, false));
    if (element >= accessor_.count || (i > 0 && element <= replaced_.back()))
      fail(fmt::format("has sparse indices out of order or beyond its {} elements", accessor_.count));
    replaced_.push_back(element);
  }
}

}  // namespace tacipc
