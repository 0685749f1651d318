#include "common/format/hdf5_reader.h"

#include <hdf5.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "common/base/error.h"
#include "common/base/file_name.h"
#include "common/base/fragile_library.h"
#include "common/base/printable.h"
#include "common/format/hdf5_handle.h"

namespace tacipc {

using hdf5::Handle;
using Space = Handle<&H5Sclose>;
using Type = Handle<&H5Tclose>;
using Properties = Handle<&H5Pclose>;
using Dataset = Handle<&H5Dclose>;
using Attribute = Handle<&H5Aclose>;
using Group = Handle<&H5Gclose>;
using Object = Handle<&H5Oclose>;

namespace {

constexpr const char* kLibrary = "libhdf5";
constexpr std::size_t kLargestFrame = std::size_t{256} << 20, kLargestWhole = std::size_t{1} << 30;  // bytes
constexpr std::size_t kMostNumbers = 1 << 20;  // limit of an attribute
constexpr std::size_t kMostPacked = 1032;      // largest ratio of gzip

hdf5::Id open_file(const std::filesystem::path& path) {
  hdf5::begin();
  return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
}

/// Returns the extents; nothing if the space is not simple.
std::optional<std::vector<hsize_t>> extents_of(const Space& space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || H5Sget_simple_extent_type(space) == H5S_NULL) return std::nullopt;
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space, extents.data(), nullptr) < 0) return std::nullopt;
  return extents;
}

/// Returns the product of all extents and `size`; nothing if it exceeds `most`.
std::optional<std::size_t> product(const std::vector<hsize_t>& extents, std::size_t size, std::size_t most) {
  if (std::ranges::find(extents, hsize_t{0}) != extents.end()) return 0;
  for (const hsize_t extent : extents) {
    if (extent > most / size) return std::nullopt;
    size *= extent;
  }
  return size;
}

template <typename T>
Value number_value(T value) {
  if constexpr (std::is_same_v<T, double>) return Value(value);
  return Value(static_cast<std::int64_t>(value));
}

/// Makes a number, a list or a list of lists from row-major numbers.
template <typename T>
Value shaped(const std::vector<T>& values, const std::vector<hsize_t>& extents) {
  if (extents.empty()) return number_value(values.front());
  Value::List list;
  const std::size_t inner = extents.size() > 1 ? extents[1] : 1;
  for (std::size_t i = 0; i < extents[0]; ++i) {
    if (extents.size() == 1) {
      list.push_back(number_value(values[i]));
      continue;
    }
    Value::List row;
    for (std::size_t j = 0; j < inner; ++j) row.push_back(number_value(values[i * inner + j]));
    list.emplace_back(std::move(row));
  }
  return list;
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t add_attribute_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Compression of a dataset's frames.
struct Packing {
  bool deflated = false, shuffled = false;
};

/// Returns the compression; nothing for filters that Hdf5Writer does not use.
/// \param size bytes of a number
std::optional<Packing> packing_of(const Properties& list, std::size_t size) {
  Packing packing;
  const int filters = H5Pget_nfilters(list);
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0, config = 0, width = 0;
    std::size_t count = 1;
    const H5Z_filter_t filter =
        H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &count, &width, 0, nullptr, &config);
    if (filter == H5Z_FILTER_SHUFFLE && i == 0 && count == 1 && width == size)
      packing.shuffled = true;
    else if (filter == H5Z_FILTER_DEFLATE && i + 1 == filters)
      packing.deflated = true;
    else
      return std::nullopt;
  }
  if (filters < 0 || (packing.shuffled && !packing.deflated)) return std::nullopt;
  return packing;
}

/// Undoes the byte shuffle of numbers of `size` bytes.
std::string unshuffled(const std::string& planes, std::size_t size) {
  std::string bytes(planes.size(), '\0');
  const std::size_t count = planes.size() / size;
  for (std::size_t b = 0; b < size; ++b)
    for (std::size_t i = 0; i < count; ++i) bytes[i * size + b] = planes[b * count + i];
  return bytes;
}

/// Decompresses exactly `size` bytes; nothing if the stream does not contain them.
std::optional<std::string> inflated(const std::string& packed, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflate(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  std::string bytes(size, '\0');
  if (!inflate || libdeflate_zlib_decompress(inflate.get(), packed.data(), packed.size(), bytes.data(), size,
                                             nullptr) != LIBDEFLATE_SUCCESS)
    return std::nullopt;
  return bytes;
}

/// A dataset whose numbers are in its file, which is large enough for them.
struct Stored {
  Dataset set;
  Type type;
  std::vector<hsize_t> extents;
  std::size_t number_size = 0, size = 0;  // bytes: of a number, of all numbers
  std::optional<Packing> packing = {};    // set if the dataset has chunks, one per frame

  std::size_t frame_size() const { return extents.empty() || extents[0] == 0 ? size : size / extents[0]; }
};

}  // namespace

struct Hdf5Reader::File {
  std::string name;
  std::size_t size;  // bytes
  Handle<&H5Fclose> id;

  explicit File(const std::filesystem::path& path)
      : name(path.string()),
        size(std::filesystem::file_size(path)),
        id(open_file(path), name, "/", "is not a readable HDF5 file") {}

  [[noreturn]] void refuse(const std::string& object, const std::string& why) const {
    throw DataError("{}: {}: {}", name, printable(object), why);
  }

  /// Returns whether a path leads to an object by links within this file.
  bool leads(const std::string& path) const {
    if (path == "/") return true;
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      H5L_info_t link{};
      if (H5Lexists(id, part.c_str(), H5P_DEFAULT) <= 0) return false;
      if (H5Lget_info(id, part.c_str(), &link, H5P_DEFAULT) < 0) refuse(part, "has a link that cannot be read");
      if (link.type == H5L_TYPE_EXTERNAL) refuse(part, "is in another file (an external link), which is not read");
      if (link.type != H5L_TYPE_HARD) refuse(part, "is a soft link, which shards do not have");
      if (end == std::string::npos) return true;
    }
  }

  Object object(const std::string& path) const {
    return {leads(path) ? H5Oopen(id, path.c_str(), H5P_DEFAULT) : -1, name, path, "is not there"};
  }

  /// Opens a dataset.
  /// \throw DataError unless its numbers are in this file, contiguous or in one chunk per frame
  Stored dataset(const std::string& path) const {
    Dataset set(leads(path) ? H5Dopen2(id, path.c_str(), H5P_DEFAULT) : -1, name, path, "is not a dataset");
    const Properties list(H5Dget_create_plist(set), name, path, "has no creation properties");
    if (H5Pget_external_count(list) != 0) refuse(path, "has its numbers in another file, which is not read");
    const H5D_layout_t layout = H5Pget_layout(list);
    if (layout == H5D_VIRTUAL) refuse(path, "has its numbers in other files (a virtual dataset), which are not read");
    if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) refuse(path, "is laid out as shards are not");
    Type type(H5Dget_type(set), name, path, "has no type");
    const H5T_class_t kind = H5Tget_class(type);
    const bool is_text = kind == H5T_STRING && H5Tis_variable_str(type) == 0;
    const std::size_t number_size = H5Tget_size(type);
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT && !is_text) || number_size == 0)
      refuse(path, "has values that are no numbers");
    const auto extents = extents_of(Space(H5Dget_space(set), name, path, "has no shape"));
    if (!extents) refuse(path, "has no shape");
    Stored stored{std::move(set), std::move(type), *extents, number_size};
    const std::size_t most = kMostPacked * size;
    const auto all = product(stored.extents, number_size, most);
    if (!all) refuse(path, fmt::format("says that it is larger than {} bytes, which its file cannot hold", most));
    stored.size = *all;
    if (layout == H5D_CHUNKED)
      stored.packing = packing(path, list, stored);
    else if (H5Dget_storage_size(stored.set) != stored.size)
      refuse(path, fmt::format("needs {} bytes and has {}", stored.size, H5Dget_storage_size(stored.set)));
    return stored;
  }

  Packing packing(const std::string& path, const Properties& list, const Stored& stored) const {
    std::vector<hsize_t> frame = stored.extents, chunk(frame.size());
    const int rank = static_cast<int>(frame.size());
    if (rank > 0) frame[0] = 1;
    if (rank == 0 || H5Pget_chunk(list, rank, chunk.data()) != rank || chunk != frame)
      refuse(path, "is in chunks that are not of a frame each");
    const auto packing = packing_of(list, stored.number_size);
    if (!packing) refuse(path, "is packed by filters that shards do not use");
    return *packing;
  }

  /// Returns a frame that is a chunk. Checks its size, which the library would not.
  std::string chunk(const std::string& path, const Stored& stored, std::size_t frame) const {
    const auto unreadable = [&] { refuse(path, fmt::format("frame {} cannot be read", frame)); };
    std::vector<hsize_t> start(stored.extents.size(), 0);
    start[0] = frame;
    hsize_t packed_size = 0;
    if (H5Dget_chunk_storage_size(stored.set, start.data(), &packed_size) < 0 || packed_size == 0 || packed_size > size)
      unreadable();
    std::string bytes(packed_size, '\0');
    std::uint32_t left_out = 0;
    if (H5Dread_chunk(stored.set, H5P_DEFAULT, start.data(), &left_out, bytes.data()) < 0 || left_out != 0)
      unreadable();
    if (stored.packing->deflated) {
      auto unpacked = inflated(bytes, stored.frame_size());
      if (!unpacked) refuse(path, fmt::format("frame {} is damaged", frame));
      bytes = std::move(*unpacked);
    }
    if (bytes.size() != stored.frame_size()) refuse(path, fmt::format("frame {} is damaged", frame));
    return stored.packing->shuffled ? unshuffled(bytes, stored.number_size) : bytes;
  }

  std::string frame(const std::string& path, const Stored& stored, std::size_t frame) const {
    std::vector<hsize_t> count = stored.extents, start(count.size(), 0);
    if (count.empty() || frame >= count[0]) refuse(path, fmt::format("has no frame {}", frame));
    const std::size_t bytes_of_one = stored.frame_size();
    if (bytes_of_one > kLargestFrame)
      refuse(path, fmt::format("has frames of {} bytes, at most {} are read", bytes_of_one, kLargestFrame));
    if (bytes_of_one == 0) return "";
    if (stored.packing) return chunk(path, stored, frame);
    start[0] = frame;
    count[0] = 1;
    std::string bytes(bytes_of_one, '\0');
    const Space all(H5Dget_space(stored.set), name, path, "has no shape");
    const Space one(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), name, path, "shape");
    if (H5Sselect_hyperslab(all, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(stored.set, stored.type, one, all, H5P_DEFAULT, bytes.data()) < 0)
      refuse(path, fmt::format("frame {} cannot be read", frame));
    return bytes;
  }

  Value read_attribute(const Object& owner, const std::string& object, const std::string& attribute) const {
    if (!is_utf8(attribute)) refuse(object, "has an attribute whose name is not UTF-8");
    const Attribute open(H5Aopen(owner, attribute.c_str(), H5P_DEFAULT), name, object,
                         ("has no attribute " + printable(attribute)).c_str());
    const Type type(H5Aget_type(open), name, object, "an attribute has no type");
    const auto extents = extents_of(Space(H5Aget_space(open), name, object, "an attribute has no shape"));
    const auto fault = [&](const char* why) {
      refuse(object, fmt::format("attribute {} {}", printable(attribute), why));
    };
    if (!extents || extents->size() > 2) fault("is of another kind");
    const auto count = product(*extents, 1, kMostNumbers);
    if (!count) fault("has too many numbers");
    const auto read = [&](hid_t memory, void* to) {
      if (H5Aread(open, memory, to) < 0) fault("cannot be read");
    };
    if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) > 0 && extents->empty()) {
      char* text = nullptr;
      read(type, &text);
      const std::string copy = text ? text : "";
      H5free_memory(text);
      if (!is_utf8(copy)) fault("is not UTF-8");
      return copy;
    }
    if (H5Tget_class(type) == H5T_INTEGER) {
      std::vector<std::int64_t> values(*count);
      read(H5T_NATIVE_INT64, values.data());
      return shaped(values, *extents);
    }
    if (H5Tget_class(type) != H5T_FLOAT) fault("is of another kind");
    std::vector<double> values(*count);
    read(H5T_NATIVE_DOUBLE, values.data());
    return shaped(values, *extents);
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) {
  const FragileCall call(kLibrary, path.string());
  file_ = std::make_unique<File>(path);
}
Hdf5Reader::~Hdf5Reader() {
  const FragileCall call(kLibrary, file_->name);
  file_.reset();
}

const std::string& Hdf5Reader::name() const { return file_->name; }

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const FragileCall call(kLibrary, file_->name);
  const Group open(file_->leads(group) ? H5Gopen2(file_->id, group.c_str(), H5P_DEFAULT) : -1, file_->name, group,
                   "is not a group");
  std::vector<std::string> names;
  if (H5Literate(open, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) < 0)
    file_->refuse(group, "cannot be listed");
  for (const std::string& name : names) require_file_name(name, file_->name + ": " + group);
  std::ranges::sort(names);
  if (std::ranges::adjacent_find(names) != names.end()) file_->refuse(group, "has a name twice");
  return names;
}

bool Hdf5Reader::has(const std::string& path) const {
  const FragileCall call(kLibrary, file_->name);
  return file_->leads(path);
}

Value::Map Hdf5Reader::attributes(const std::string& object) const {
  const FragileCall call(kLibrary, file_->name);
  const Object owner = file_->object(object);
  std::vector<std::string> names;
  hsize_t from = 0;
  if (H5Aiterate2(owner, H5_INDEX_NAME, H5_ITER_INC, &from, add_attribute_name, &names) < 0)
    file_->refuse(object, "attributes cannot be listed");
  std::ranges::sort(names);
  Value::Map map;
  for (const std::string& name : names) map.emplace_back(name, file_->read_attribute(owner, object, name));
  return map;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& attribute) const {
  const FragileCall call(kLibrary, file_->name);
  const Value value = file_->read_attribute(file_->object(object), object, attribute);
  const auto* text = std::get_if<std::string>(&value.data());
  if (!text) file_->refuse(object, fmt::format("attribute {} is not a text", attribute));
  return *text;
}

std::string Hdf5Reader::name_attribute(const std::string& object, const std::string& attribute) const {
  return require_file_name(text_attribute(object, attribute),
                           fmt::format("{}: {}: attribute {}", file_->name, object, attribute));
}

std::size_t Hdf5Reader::count_attribute(const std::string& object, const std::string& attribute) const {
  const FragileCall call(kLibrary, file_->name);
  const Value value = file_->read_attribute(file_->object(object), object, attribute);
  const auto* count = std::get_if<std::int64_t>(&value.data());
  if (!count || *count < 0)
    file_->refuse(object, fmt::format("attribute {} is not a whole number from 0 on", attribute));
  return static_cast<std::size_t>(*count);
}

NumberType Hdf5Reader::type(const std::string& dataset) const {
  const FragileCall call(kLibrary, file_->name);
  const Stored stored = file_->dataset(dataset);
  const Type half(hdf5::half_type(), file_->name, dataset, "no half type");
  const std::pair<NumberType, hdf5::Id> types[] = {{NumberType::u8, H5T_STD_U8LE},
                                                   {NumberType::i32, H5T_STD_I32LE},
                                                   {NumberType::f16, half},
                                                   {NumberType::f32, H5T_IEEE_F32LE},
                                                   {NumberType::f64, H5T_IEEE_F64LE}};
  for (const auto& [type, id] : types)
    if (H5Tequal(stored.type, id) > 0) return type;
  file_->refuse(dataset, "a number type that shards do not use");
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
  const FragileCall call(kLibrary, file_->name);
  const std::vector<hsize_t> extents = file_->dataset(dataset).extents;
  return {extents.begin(), extents.end()};
}

std::string Hdf5Reader::read_frame(const std::string& dataset, std::size_t frame) const {
  const FragileCall call(kLibrary, file_->name);
  return file_->frame(dataset, file_->dataset(dataset), frame);
}

std::string Hdf5Reader::read(const std::string& dataset) const {
  const FragileCall call(kLibrary, file_->name);
  const Stored stored = file_->dataset(dataset);
  if (stored.size > kLargestWhole)
    file_->refuse(dataset, fmt::format("has {} bytes, at most {} are read at once", stored.size, kLargestWhole));
  std::string bytes;
  if (stored.packing) {
    bytes.reserve(stored.size);
    for (std::size_t t = 0; t < stored.extents[0]; ++t) bytes += file_->frame(dataset, stored, t);
    return bytes;
  }
  bytes.resize(stored.size);
  if (!bytes.empty() && H5Dread(stored.set, stored.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    file_->refuse(dataset, "cannot be read");
  return bytes;
}

}  // namespace tacipc
