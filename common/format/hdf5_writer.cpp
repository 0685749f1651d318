#include "common/format/hdf5_writer.h"

#include <Imath/half.h>
#include <hdf5.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>

#include "common/base/error.h"
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

constexpr int kDeflateLevel = 1;
constexpr std::size_t kMetadataCache = 1 << 20;

/// Calls use(T{}) for the C++ type of a number in the file.
template <typename Use>
auto with_type(NumberType type, const Use& use) {
  switch (type) {
    case NumberType::u8: return use(std::uint8_t{});
    case NumberType::i32: return use(std::int32_t{});
    case NumberType::f16: return use(half{});
    case NumberType::f32: return use(float{});
    case NumberType::f64: break;
  }
  return use(double{});
}

std::vector<hsize_t> extents(const std::vector<std::size_t>& shape) { return {shape.begin(), shape.end()}; }

/// Numbers of an attribute and their extents: none, one or two.
struct AttributeNumbers {
  std::vector<std::size_t> shape;
  std::vector<double> values;
  bool whole = true;
};

std::vector<std::size_t> shape_of(const Value& value) {
  const auto* rows = std::get_if<Value::List>(&value.data());
  if (!rows) return {};
  const auto* columns = rows->empty() ? nullptr : std::get_if<Value::List>(&rows->front().data());
  return columns ? std::vector{rows->size(), columns->size()} : std::vector{rows->size()};
}

void add_numbers(const Value& value, std::size_t depth, AttributeNumbers& numbers) {
  constexpr const char* kUneven = "an attribute must be a text, a number, or equally long lists of numbers";
  if (const auto* list = std::get_if<Value::List>(&value.data())) {
    if (depth >= numbers.shape.size() || list->size() != numbers.shape[depth]) throw DataError(kUneven);
    for (const Value& item : *list) add_numbers(item, depth + 1, numbers);
    return;
  }
  const auto* whole = std::get_if<std::int64_t>(&value.data());
  const auto* number = std::get_if<double>(&value.data());
  const auto* flag = std::get_if<bool>(&value.data());
  if (depth != numbers.shape.size() || (!whole && !number && !flag)) throw DataError(kUneven);
  numbers.values.push_back(whole ? static_cast<double>(*whole) : number ? *number : *flag ? 1.0 : 0.0);
  numbers.whole = numbers.whole && !number;
}

}  // namespace

void hdf5::begin() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5Lunregister(H5L_TYPE_EXTERNAL);
}

hdf5::Id hdf5::half_type() {
  // Sign in bit 15, five bits of exponent from bit 10, ten bits of mantissa, bias 15.
  const Id type = H5Tcopy(H5T_IEEE_F32LE);
  if (type < 0 || H5Tset_fields(type, 15, 10, 5, 0, 10) < 0 || H5Tset_size(type, 2) < 0 || H5Tset_ebias(type, 15) < 0)
    return -1;
  return type;
}

std::size_t size_of(NumberType type) {
  return with_type(type, [](auto number) { return sizeof(number); });
}

const char* name_of(NumberType type) {
  constexpr const char* kNames[] = {"uint8", "int32", "float16", "float32", "float64"};
  return kNames[static_cast<int>(type)];
}

const char* npy_type_of(NumberType type) {
  constexpr const char* kNames[] = {"|u1", "<i4", "<f2", "<f4", "<f8"};
  return kNames[static_cast<int>(type)];
}

std::string to_bytes(NumberType type, const std::vector<double>& values) {
  return with_type(type, [&]<typename T>(T) {
    std::string bytes(values.size() * sizeof(T), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) {
      T value;
      if constexpr (std::is_same_v<T, half>)
        value = half(static_cast<float>(values[i]));
      else
        value = static_cast<T>(values[i]);
      std::memcpy(bytes.data() + i * sizeof(T), &value, sizeof(T));
    }
    return bytes;
  });
}

std::vector<double> from_bytes(NumberType type, std::string_view bytes) {
  return with_type(type, [&]<typename T>(T value) {
    std::vector<double> values(bytes.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
      values[i] = static_cast<double>(value);
    }
    return values;
  });
}

struct Hdf5Writer::File {
  using Id = hdf5::Id;
  std::string name;
  Handle<&H5Fclose> id;
  Properties make_parents;  // link properties: create missing parent groups
  Type half;
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor{
      libdeflate_alloc_compressor(kDeflateLevel), &libdeflate_free_compressor};

  static Id create(const std::filesystem::path& path) {
    hdf5::begin();
    const std::string name = path.string();
    const Properties access(H5Pcreate(H5P_FILE_ACCESS), name, "/", "no file properties");
    const Properties creation(H5Pcreate(H5P_FILE_CREATE), name, "/", "no file properties");
    H5AC_cache_config_t cache{};
    cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
    if (H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18) < 0 || H5Pset_obj_track_times(creation, 0) < 0 ||
        H5Pget_mdc_config(access, &cache) < 0)
      return -1;
    // By default the cache of groups and attributes grows with the file, up to 32 MB.
    cache.set_initial_size = true;
    cache.initial_size = cache.max_size = kMetadataCache;
    cache.min_size = kMetadataCache;
    if (H5Pset_mdc_config(access, &cache) < 0) return -1;
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
  }

  explicit File(const std::filesystem::path& path)
      : name(path.string()),
        id(create(path), name, "/", "the file cannot be created"),
        make_parents(H5Pcreate(H5P_LINK_CREATE), name, "/", "no link properties"),
        half(hdf5::half_type(), name, "/", "no half type") {
    if (H5Pset_create_intermediate_group(make_parents, 1) < 0) throw DataError("{}: no link properties", name);
  }

  Id file_type(NumberType type) const {
    switch (type) {
      case NumberType::u8: return H5T_STD_U8LE;
      case NumberType::i32: return H5T_STD_I32LE;
      case NumberType::f16: return half;
      case NumberType::f32: return H5T_IEEE_F32LE;
      case NumberType::f64: return H5T_IEEE_F64LE;
    }
    return -1;
  }

  Space space(const std::vector<std::size_t>& shape, const std::string& object) const {
    const auto dims = extents(shape);
    const Id made =
        dims.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
    return Space(made, name, object, "has an impossible shape");
  }

  Properties creation(Id of_class, const std::string& object) const {
    Properties list(H5Pcreate(of_class), name, object, "no creation properties");
    if (H5Pset_obj_track_times(list, 0) < 0) throw DataError("{}: {}: no creation properties", name, object);
    return list;
  }

  /// Writes one chunk of numbers of `size` bytes as HDF5's shuffle and gzip filters would, in a third of the time.
  /// \return false if it cannot be written
  bool write_chunk(Id set, const std::vector<hsize_t>& start, std::string_view bytes, std::size_t size) const {
    const std::size_t count = bytes.size() / size,
                      room = libdeflate_zlib_compress_bound(compressor.get(), bytes.size());
    const auto chunk = std::make_unique_for_overwrite<char[]>(room);
    const auto shuffled = std::make_unique_for_overwrite<char[]>(size > 1 ? bytes.size() : 0);
    for (std::size_t b = 0; size > 1 && b < size; ++b)
      for (std::size_t i = 0; i < count; ++i) shuffled[b * count + i] = bytes[i * size + b];
    const std::size_t packed = libdeflate_zlib_compress(compressor.get(), size > 1 ? shuffled.get() : bytes.data(),
                                                        bytes.size(), chunk.get(), room);
    return packed > 0 && H5Dwrite_chunk(set, H5P_DEFAULT, 0, start.data(), packed, chunk.get()) >= 0;
  }

  Dataset create_dataset(const std::string& path, Id type, const std::vector<std::size_t>& shape, bool chunked) const {
    const Properties list = creation(H5P_DATASET_CREATE, path);
    if (chunked) {
      auto chunk = extents(shape);
      chunk[0] = 1;
      if (H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data()) < 0 || H5Pset_shuffle(list) < 0 ||
          H5Pset_deflate(list, kDeflateLevel) < 0)
        throw DataError("{}: {}: cannot be chunked", name, path);
    }
    return Dataset(H5Dcreate2(id, path.c_str(), type, space(shape, path), make_parents, list, H5P_DEFAULT), name, path,
                   "cannot be created");
  }

  void write_attribute(const std::string& object, const std::string& attribute, Id type, const Space& at,
                       const void* data) const {
    const Object owner(H5Oopen(id, object.c_str(), H5P_DEFAULT), name, object, "is not there");
    const Attribute made(H5Acreate2(owner, attribute.c_str(), type, at, H5P_DEFAULT, H5P_DEFAULT), name, object,
                         "an attribute cannot be created");
    if (H5Awrite(made, type, data) < 0)
      throw DataError("{}: {}: attribute {} cannot be written", name, object, attribute);
  }
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path) : file_(std::make_unique<File>(path)) {}
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::group(const std::string& path) {
  if (path.empty() || path == "/") return;
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    if (H5Lexists(file_->id, part.c_str(), H5P_DEFAULT) <= 0) {
      const Properties list = file_->creation(H5P_GROUP_CREATE, part);
      const Group made(H5Gcreate2(file_->id, part.c_str(), H5P_DEFAULT, list, H5P_DEFAULT), file_->name, part,
                       "cannot be created");
    }
    if (end == std::string::npos) return;
  }
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value.data())) {
    const Type type(H5Tcopy(H5T_C_S1), file_->name, object, "no text type");
    if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
      throw DataError("{}: {}: no text type", file_->name, object);
    const char* data = text->c_str();
    file_->write_attribute(object, name, type, file_->space({}, object), &data);
    return;
  }
  AttributeNumbers numbers{.shape = shape_of(value), .values = {}};
  try {
    add_numbers(value, 0, numbers);
  } catch (const DataError& error) {
    throw DataError("{}: {}: {}: {}", file_->name, object, name, error.what());
  }
  const Space space = file_->space(numbers.shape, object);
  if (numbers.whole) {
    const std::vector<std::int64_t> whole(numbers.values.begin(), numbers.values.end());
    file_->write_attribute(object, name, H5T_STD_I64LE, space, whole.data());
  } else {
    file_->write_attribute(object, name, H5T_IEEE_F64LE, space, numbers.values.data());
  }
}

void Hdf5Writer::dataset(const std::string& path, NumberType type, const std::vector<std::size_t>& shape,
                         bool chunk_by_frame) {
  group(path.substr(0, path.rfind('/')));
  file_->create_dataset(path, file_->file_type(type), shape, chunk_by_frame);
}

void Hdf5Writer::write_frame(const std::string& path, std::size_t frame, std::string_view bytes) {
  const Dataset set(H5Dopen2(file_->id, path.c_str(), H5P_DEFAULT), file_->name, path, "is not there");
  const Space all(H5Dget_space(set), file_->name, path, "has no shape");
  const Type type(H5Dget_type(set), file_->name, path, "has no type");
  const int dimensions = H5Sget_simple_extent_ndims(all);
  if (dimensions < 1) throw DataError("{}: {}: has no frames", file_->name, path);
  std::vector<hsize_t> count(dimensions);
  H5Sget_simple_extent_dims(all, count.data(), nullptr);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = frame;
  count[0] = 1;
  std::size_t size = H5Tget_size(type);
  for (const hsize_t extent : count) size *= extent;
  if (size != bytes.size())
    throw DataError("{}: {}: a frame of {} bytes was given, it takes {}", file_->name, path, bytes.size(), size);
  const Properties list(H5Dget_create_plist(set), file_->name, path, "has no creation properties");
  if (H5Pget_layout(list) == H5D_CHUNKED) {
    if (!file_->write_chunk(set, start, bytes, H5Tget_size(type)))
      throw DataError("{}: {}: frame {} cannot be written", file_->name, path, frame);
    return;
  }
  const Space one(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), file_->name, path, "shape");
  if (H5Sselect_hyperslab(all, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
      H5Dwrite(set, type, one, all, H5P_DEFAULT, bytes.data()) < 0)
    throw DataError("{}: {}: frame {} cannot be written", file_->name, path, frame);
}

void Hdf5Writer::write(const std::string& path, NumberType type, const std::vector<std::size_t>& shape,
                       std::string_view bytes) {
  group(path.substr(0, path.rfind('/')));
  const Dataset set = file_->create_dataset(path, file_->file_type(type), shape, false);
  if (!bytes.empty() && H5Dwrite(set, file_->file_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    throw DataError("{}: {}: cannot be written", file_->name, path);
}

void Hdf5Writer::write_texts(const std::string& path, const std::vector<std::string>& texts) {
  group(path.substr(0, path.rfind('/')));
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string bytes;
  for (const std::string& text : texts) bytes += text + std::string(longest - text.size(), '\0');
  const Type type(H5Tcopy(H5T_C_S1), file_->name, path, "no text type");
  if (H5Tset_size(type, longest) < 0 || H5Tset_strpad(type, H5T_STR_NULLPAD) < 0)
    throw DataError("{}: {}: no text type", file_->name, path);
  const Dataset set = file_->create_dataset(path, type, {texts.size()}, false);
  if (!texts.empty() && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    throw DataError("{}: {}: cannot be written", file_->name, path);
}

void Hdf5Writer::close() {
  if (H5Fflush(file_->id, H5F_SCOPE_GLOBAL) < 0 || !file_->id.close())
    throw DataError("{}: cannot be written (is the disk full?)", file_->name);
}

}  // namespace tacipc
