#include "common/format/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>

#include "common/base/byte_reader.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

constexpr std::string_view kMagic("\x93NUMPY", 6);
constexpr std::size_t kAlignment = 64;

std::string_view value_of(std::string_view header, std::string_view key, const std::string& name) {
  const std::size_t at = header.find(fmt::format("'{}':", key));
  if (at == std::string_view::npos) throw DataError("{}: the NPY header has no '{}'", name, key);
  header.remove_prefix(at + key.size() + 3);
  header.remove_prefix(std::min(header.find_first_not_of(' '), header.size()));
  return header;
}

std::vector<std::size_t> parse_shape(std::string_view text, const std::string& name) {
  const auto bad = [&] { throw DataError("{}: the NPY shape '{}' is malformed", name, shown(text)); };
  if (!text.starts_with("(")) bad();
  std::vector<std::size_t> shape;
  for (std::size_t at = 1; at < text.size();) {
    if (text[at] == ')') return shape;
    if (text[at] == ' ' || text[at] == ',') {
      ++at;
      continue;
    }
    std::size_t extent = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), extent);
    if (error != std::errc()) bad();
    shape.push_back(extent);
    at = static_cast<std::size_t>(end - text.data());
  }
  bad();
  return shape;
}

/// Returns the number of values; nothing if this number, or its size in bytes, overflows.
std::optional<std::size_t> volume(const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (const std::size_t extent : shape)
    if (__builtin_mul_overflow(count, extent, &count) || count > (std::size_t{1} << 56)) return std::nullopt;
  return count;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

/// Converts column-major to row-major: reads the source in order while counting up the indices, first index fastest.
std::vector<double> from_fortran(const std::vector<double>& source, const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> stride(shape.size(), 1);
  for (std::size_t d = shape.size(); d-- > 1;) stride[d - 1] = stride[d] * shape[d];
  std::vector<std::size_t> index(shape.size(), 0);
  std::vector<double> target(source.size());
  std::size_t at = 0;
  for (const double value : source) {
    target[at] = value;
    for (std::size_t d = 0; d < shape.size(); ++d) {
      at += stride[d];
      if (++index[d] < shape[d]) break;
      at -= stride[d] * shape[d];
      index[d] = 0;
    }
  }
  return target;
}

struct Header {
  std::vector<std::size_t> shape;
  std::string kind;  // "f8"
  bool big_endian = false;
  bool fortran = false;
  std::size_t data_at = 0;
  std::size_t count = 0;
};

/// Parses a header.
/// \param begin the file's beginning: at least the header, unless the file is shorter
Header parse_header(std::string_view begin, std::size_t file_size, const std::string& name) {
  if (!begin.starts_with(kMagic)) throw DataError("{}: is not an NPY file", name);
  ByteReader in(begin, name);
  in.skip(kMagic.size(), "the magic");
  const int major = in.read<std::uint8_t>("the version");
  const int minor = in.read<std::uint8_t>("the version");
  if (major < 1 || major > 3)
    throw DataError("{}: NPY version {}.{} is not supported (1.0 to 3.0 are)", name, major, minor);
  const std::size_t length =
      major == 1 ? in.read<std::uint16_t>("the header length") : in.read<std::uint32_t>("the header length");
  const std::size_t header_at = in.at();
  in.skip(length, "the header");
  const std::string_view header = begin.substr(header_at, length);

  std::string_view type = value_of(header, "descr", name);
  type = type.starts_with("'") ? type.substr(1, type.find('\'', 1) - 1) : type.substr(0, type.find(','));
  Header found;
  found.shape = parse_shape(value_of(header, "shape", name), name);
  found.fortran = value_of(header, "fortran_order", name).starts_with("True");
  found.data_at = header_at + length;
  constexpr std::string_view kKinds = "f8f4i8i4u1";
  const std::string_view kind = type.size() == 3 ? type.substr(1) : std::string_view("?");
  const std::size_t kind_at = kKinds.find(kind);
  if (kind_at == std::string_view::npos || kind_at % 2 != 0 ||
      std::string_view("<>|=").find(type[0]) == std::string_view::npos)
    throw DataError("{}: NPY type '{}' is not supported (f8, f4, i8, i4 and u1 are)", name, shown(type));
  found.kind = kind;
  found.big_endian = type[0] == '>';
  const std::size_t each = static_cast<std::size_t>(kind[1] - '0'), left = file_size - found.data_at;
  const std::optional<std::size_t> count = volume(found.shape);
  if (!count || *count * each != left)
    throw DataError("{}: shape {} of {} takes {} bytes, the file has {} after its header", name,
                    shape_text(found.shape), type, count ? fmt::format("{}", *count * each) : "too many", left);
  found.count = *count;
  return found;
}

std::vector<double> read_values(ByteReader& in, const std::string& kind, std::size_t count) {
  std::vector<double> data(count);
  const auto read = [&]<typename T>(T) {
    for (double& value : data) value = static_cast<double>(in.read<T>("the data"));
  };
  if (kind == "f8") read(double{});
  if (kind == "f4") read(float{});
  if (kind == "i8") read(std::int64_t{});
  if (kind == "i4") read(std::int32_t{});
  if (kind == "u1") read(std::uint8_t{});
  return data;
}

template <typename T>
void write_array(const std::filesystem::path& path, const std::vector<std::size_t>& shape, std::string_view type,
                 const T* data) {
  const std::optional<std::size_t> count = volume(shape);
  if (!count) throw DataError("{}: shape {} is too large", path.string(), shape_text(shape));
  write_file(path, npy_bytes(shape, type, {reinterpret_cast<const char*>(data), *count * sizeof(T)}));
}

}  // namespace

std::string npy_bytes(const std::vector<std::size_t>& shape, std::string_view type, std::string_view values) {
  static_assert(std::endian::native == std::endian::little, "written as it lies in memory");
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape_text(shape));
  // Magic, version, header length and header together fill whole blocks, so that the data is aligned.
  const std::size_t before = kMagic.size() + 4;
  header.append(kAlignment - (before + header.size() + 1) % kAlignment, ' ');
  header.push_back('\n');
  if (header.size() > 0xffff) throw DataError("NPY: {} dimensions are too many", shape.size());
  std::string bytes(kMagic);
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
  bytes += header;
  bytes += values;
  return bytes;
}

void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const double* data) {
  write_array(path, shape, "<f8", data);
}

void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const std::int32_t* data) {
  write_array(path, shape, "<i4", data);
}

void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const std::uint8_t* data) {
  write_array(path, shape, "|u1", data);
}

NpyArray read_npy(const std::filesystem::path& path) { return read_npy_bytes(read_file(path), path.string()); }

NpyArray read_npy_bytes(std::string_view bytes, const std::string& name) {
  const Header header = parse_header(bytes, bytes.size(), name);
  ByteReader in(bytes, name, header.big_endian ? std::endian::big : std::endian::little);
  in.seek(header.data_at);
  NpyArray array{.shape = header.shape, .data = read_values(in, header.kind, header.count)};
  if (header.fortran) array.data = from_fortran(array.data, array.shape);
  return array;
}

NpyArray read_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape) {
  NpyArray array = read_npy(path);
  if (array.shape != shape)
    throw DataError("{}: has the shape ({}), expected ({})", path.string(), fmt::join(array.shape, ", "),
                    fmt::join(shape, ", "));
  return array;
}

NpyFrames::NpyFrames(const std::filesystem::path& path) : name_(path.string()), file_(path, std::ios::binary) {
  constexpr std::size_t kLongestHeader = (1 << 16) + 16;
  if (!file_ || std::filesystem::is_directory(path)) throw DataError("{}: cannot be read", name_);
  std::string begin(kLongestHeader, '\0');
  file_.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(file_.gcount());
  const Header header = parse_header(begin, std::filesystem::file_size(path), name_);
  if (header.fortran || header.shape.empty())
    throw DataError("{}: cannot be read by its first axis: {}", name_,
                    header.fortran ? "it is in Fortran order" : "it has none");
  shape_ = header.shape;
  kind_ = header.kind;
  big_endian_ = header.big_endian;
  data_at_ = header.data_at;
  frame_values_ = shape_[0] == 0 ? 0 : header.count / shape_[0];
}

std::vector<double> NpyFrames::frame(std::size_t frame) {
  const std::size_t size = frame_values_ * static_cast<std::size_t>(kind_[1] - '0');
  std::string bytes(size, '\0');
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(data_at_ + frame * size));
  file_.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::size_t>(file_.gcount()) != size) throw DataError("{}: ends inside frame {}", name_, frame);
  ByteReader in(bytes, name_, big_endian_ ? std::endian::big : std::endian::little);
  return read_values(in, kind_, frame_values_);
}

}  // namespace tacipc
