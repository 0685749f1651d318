#include "common/format/hdf5_reader.h"

#include <hdf5.h>

#include <algorithm>
#include <optional>

#include "common/base/error.h"
#include "common/format/hdf5_handle.h"

namespace tacipc {

using hdf5::Handle;
using Space = Handle<&H5Sclose>;
using Type = Handle<&H5Tclose>;
using Dataset = Handle<&H5Dclose>;
using Attribute = Handle<&H5Aclose>;
using Group = Handle<&H5Gclose>;
using Object = Handle<&H5Oclose>;

namespace {

hdf5::Id open_file(const std::filesystem::path& path) {
  hdf5::begin();
  return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
}

std::vector<hsize_t> extents_of(const Space& space) {
  std::vector<hsize_t> extents(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return extents;
}

template <typename T>
Value number_value(T value) {
  if constexpr (std::is_same_v<T, double>) return Value(value);
  return Value(static_cast<std::int64_t>(value));
}

/// A number, a list or a list of lists, row-major.
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

}  // namespace

struct Hdf5Reader::File {
  std::string name;
  Handle<&H5Fclose> id;

  explicit File(const std::filesystem::path& path)
      : name(path.string()), id(open_file(path), name, "/", "is not a readable HDF5 file") {}

  Dataset dataset(const std::string& path) const {
    return {H5Dopen2(id, path.c_str(), H5P_DEFAULT), name, path, "is not a dataset"};
  }

  Value read_attribute(const Object& owner, const std::string& object, const std::string& attribute) const {
    const Attribute open(H5Aopen(owner, attribute.c_str(), H5P_DEFAULT), name, object, "has no such attribute");
    const Type type(H5Aget_type(open), name, object, "an attribute has no type");
    const Space space(H5Aget_space(open), name, object, "an attribute has no shape");
    const auto extents = extents_of(space);
    const auto unknown = [&] { throw DataError("{}: {}: attribute {} is of another kind", name, object, attribute); };
    if (extents.size() > 2) unknown();
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    const auto read = [&](hid_t memory, void* to) {
      if (H5Aread(open, memory, to) < 0)
        throw DataError("{}: {}: attribute {} cannot be read", name, object, attribute);
    };
    if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) > 0 && extents.empty()) {
      char* text = nullptr;
      read(type, &text);
      const std::string copy = text ? text : "";
      H5Dvlen_reclaim(type, space, H5P_DEFAULT, &text);
      return copy;
    }
    if (H5Tget_class(type) == H5T_INTEGER) {
      std::vector<std::int64_t> values(count);
      read(H5T_NATIVE_INT64, values.data());
      return shaped(values, extents);
    }
    if (H5Tget_class(type) != H5T_FLOAT) unknown();
    std::vector<double> values(count);
    read(H5T_NATIVE_DOUBLE, values.data());
    return shaped(values, extents);
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : file_(std::make_unique<File>(path)) {}
Hdf5Reader::~Hdf5Reader() = default;

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
  const Group open(H5Gopen2(file_->id, group.c_str(), H5P_DEFAULT), file_->name, group, "is not a group");
  std::vector<std::string> names;
  if (H5Literate(open, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) < 0)
    throw DataError("{}: {}: cannot be listed", file_->name, group);
  std::ranges::sort(names);
  return names;
}

bool Hdf5Reader::has(const std::string& path) const {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(file_->id, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

Value::Map Hdf5Reader::attributes(const std::string& object) const {
  const Object owner(H5Oopen(file_->id, object.c_str(), H5P_DEFAULT), file_->name, object, "is not there");
  std::vector<std::string> names;
  hsize_t from = 0;
  if (H5Aiterate2(owner, H5_INDEX_NAME, H5_ITER_INC, &from, add_attribute_name, &names) < 0)
    throw DataError("{}: {}: attributes cannot be listed", file_->name, object);
  std::ranges::sort(names);
  Value::Map map;
  for (const std::string& name : names) map.emplace_back(name, file_->read_attribute(owner, object, name));
  return map;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Object owner(H5Oopen(file_->id, object.c_str(), H5P_DEFAULT), file_->name, object, "is not there");
  const Value value = file_->read_attribute(owner, object, name);
  const auto* text = std::get_if<std::string>(&value.data());
  if (!text) throw DataError("{}: {}: attribute {} is not a text", file_->name, object, name);
  return *text;
}

NumberType Hdf5Reader::type(const std::string& dataset) const {
  const Dataset set = file_->dataset(dataset);
  const Type type(H5Dget_type(set), file_->name, dataset, "has no type");
  const auto size = H5Tget_size(type);
  std::optional<NumberType> found;
  if (H5Tget_class(type) == H5T_INTEGER && size == 1) found = NumberType::u8;
  if (H5Tget_class(type) == H5T_INTEGER && size == 4) found = NumberType::i32;
  if (H5Tget_class(type) == H5T_FLOAT && size == 2) found = NumberType::f16;
  if (H5Tget_class(type) == H5T_FLOAT && size == 4) found = NumberType::f32;
  if (H5Tget_class(type) == H5T_FLOAT && size == 8) found = NumberType::f64;
  if (!found || H5Tget_order(type) == H5T_ORDER_BE)
    throw DataError("{}: {}: a number type that shards do not use", file_->name, dataset);
  return *found;
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
  const Dataset set = file_->dataset(dataset);
  const auto extents = extents_of(Space(H5Dget_space(set), file_->name, dataset, "has no shape"));
  return {extents.begin(), extents.end()};
}

std::string Hdf5Reader::read_frame(const std::string& dataset, std::size_t frame) const {
  const Dataset set = file_->dataset(dataset);
  const Type type(H5Dget_type(set), file_->name, dataset, "has no type");
  const Space all(H5Dget_space(set), file_->name, dataset, "has no shape");
  auto count = extents_of(all);
  if (count.empty() || frame >= count[0]) throw DataError("{}: {}: has no frame {}", file_->name, dataset, frame);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = frame;
  count[0] = 1;
  std::size_t size = H5Tget_size(type);
  for (const hsize_t extent : count) size *= extent;
  std::string bytes(size, '\0');
  const Space one(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), file_->name, dataset,
                  "shape");
  if (H5Sselect_hyperslab(all, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
      H5Dread(set, type, one, all, H5P_DEFAULT, bytes.data()) < 0)
    throw DataError("{}: {}: frame {} cannot be read", file_->name, dataset, frame);
  return bytes;
}

std::string Hdf5Reader::read(const std::string& dataset) const {
  const Dataset set = file_->dataset(dataset);
  const Type type(H5Dget_type(set), file_->name, dataset, "has no type");
  const Space all(H5Dget_space(set), file_->name, dataset, "has no shape");
  std::string bytes(H5Tget_size(type) * static_cast<std::size_t>(H5Sget_simple_extent_npoints(all)), '\0');
  if (!bytes.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    throw DataError("{}: {}: cannot be read", file_->name, dataset);
  return bytes;
}

}  // namespace tacipc
