#include "common/format/parquet_writer.h"

#include <bit>
#include <cassert>
#include <limits>
#include <span>

#include "common/base/error.h"

namespace tacipc {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr const char* kParquetMagic = "PAR1";
// Enumerations of parquet.thrift.
constexpr int kInt64 = 2, kFloat = 4, kDouble = 5, kByteArray = 6;
constexpr int kRequired = 0, kRepeated = 2;
constexpr int kUtf8 = 0, kList = 3;
constexpr int kPlain = 0, kRle = 3;
constexpr int kUncompressed = 0, kDataPage = 0;

std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>((value & 0x7f) | 0x80);
  return bytes + static_cast<char>(value);
}

/// A struct in Thrift's compact protocol, field after field in ascending order of their numbers.
class Struct {
 public:
  Struct& i32(int field, std::int32_t value) { return number(field, 5, value); }
  Struct& i64(int field, std::int64_t value) { return number(field, 6, value); }
  Struct& text(int field, const std::string& value) {
    header(field, 8);
    bytes_ += varint(value.size()) + value;
    return *this;
  }
  Struct& child(int field, const Struct& value) {
    header(field, 12);
    bytes_ += value.bytes();
    return *this;
  }
  Struct& structs(int field, const std::vector<Struct>& values) {
    list(field, 12, values.size());
    for (const Struct& value : values) bytes_ += value.bytes();
    return *this;
  }
  Struct& texts(int field, const std::vector<std::string>& values) {
    list(field, 8, values.size());
    for (const std::string& value : values) bytes_ += varint(value.size()) + value;
    return *this;
  }
  Struct& i32s(int field, const std::vector<int>& values) {
    list(field, 5, values.size());
    for (const int value : values) bytes_ += zigzag(value);
    return *this;
  }
  std::string bytes() const { return bytes_ + '\0'; }

 private:
  static std::string zigzag(std::int64_t value) {
    return varint((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
  }
  Struct& number(int field, int type, std::int64_t value) {
    header(field, type);
    bytes_ += zigzag(value);
    return *this;
  }
  void header(int field, int type) {
    assert(field > last_ && field - last_ < 16);
    bytes_ += static_cast<char>(((field - last_) << 4) | type);
    last_ = field;
  }
  void list(int field, int type, std::size_t size) {
    header(field, 9);
    if (size < 15)
      bytes_ += static_cast<char>((size << 4) | static_cast<std::size_t>(type));
    else
      bytes_ += static_cast<char>(0xf0 | type) + varint(size);
  }

  std::string bytes_;
  int last_ = 0;
};

/// A leaf of the schema: its path, and the repetition of lists above it.
struct Leaf {
  std::vector<std::string> path;
  int type;
};

int physical_type(ParquetType type) {
  switch (type) {
    case ParquetType::i64: return kInt64;
    case ParquetType::f32: return kFloat;
    case ParquetType::f64: return kDouble;
    default: return kByteArray;
  }
}

/// Appends the schema's elements of a column, depth first, and its leaves.
void add_schema(const ParquetColumn& column, std::vector<Struct>& schema, std::vector<Leaf>& leaves) {
  if (column.type == ParquetType::image) {
    schema.push_back(Struct().i32(3, kRequired).text(4, column.name).i32(5, 2));
    schema.push_back(Struct().i32(1, kByteArray).i32(3, kRequired).text(4, "bytes"));
    schema.push_back(Struct().i32(1, kByteArray).i32(3, kRequired).text(4, "path").i32(6, kUtf8));
    leaves.push_back({{column.name, "bytes"}, kByteArray});
    leaves.push_back({{column.name, "path"}, kByteArray});
    return;
  }
  std::vector<std::string> path;
  std::string name = column.name;
  for (std::size_t depth = 0; depth < column.shape.size(); ++depth) {
    schema.push_back(Struct().i32(3, kRequired).text(4, name).i32(5, 1).i32(6, kList));
    schema.push_back(Struct().i32(3, kRepeated).text(4, "list").i32(5, 1));
    path.insert(path.end(), {name, "list"});
    name = "element";
  }
  path.push_back(name);
  Struct leaf;
  leaf.i32(1, physical_type(column.type)).i32(3, kRequired).text(4, name);
  if (column.type == ParquetType::text) leaf.i32(6, kUtf8);
  schema.push_back(leaf);
  leaves.push_back({path, physical_type(column.type)});
}

/// Encodes runs of equal levels, preceded by their length in bytes.
class Levels {
 public:
  void add(std::uint64_t count, int level) {
    if (count > 0 && level == level_) {
      count_ += count;
      return;
    }
    flush();
    count_ = count;
    level_ = level;
  }
  std::string bytes() {
    flush();
    const auto size = static_cast<std::uint32_t>(runs_.size());
    return std::string(reinterpret_cast<const char*>(&size), sizeof(size)) + runs_;
  }

 private:
  void flush() {
    if (count_ > 0) runs_ += varint(count_ << 1) + static_cast<char>(level_);  // value of at most 255: one byte
    count_ = 0;
  }
  std::string runs_;
  std::uint64_t count_ = 0;
  int level_ = -1;
};

/// Returns repetition and definition levels of full lists: the list at which each value starts anew, and that all
/// exist.
std::string levels_of(const std::vector<std::size_t>& shape, std::size_t rows) {
  if (shape.empty()) return "";
  const int depth = static_cast<int>(shape.size());
  std::size_t values = rows;
  for (const std::size_t extent : shape) values *= extent;
  Levels repetition, definition;
  for (std::size_t v = 0; v < values; v += shape.back()) {
    // Number of inner lists that end before this value.
    int level = depth - 1;
    std::size_t block = shape.back();
    for (; level > 0; --level) {
      block *= shape[level - 1];
      if (v % block != 0) break;
    }
    repetition.add(1, level);
    repetition.add(shape.back() - 1, depth);
  }
  definition.add(values, depth);
  return repetition.bytes() + definition.bytes();
}

template <typename T>
std::string plain(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

void append_bytes(std::string& page, const std::string& value) {
  const auto size = static_cast<std::uint32_t>(value.size());
  page.append(reinterpret_cast<const char*>(&size), sizeof(size));
  page += value;
}

std::string plain(const std::vector<std::string>& values) {
  std::string page;
  for (const std::string& value : values) append_bytes(page, value);
  return page;
}

}  // namespace

ParquetWriter::ParquetWriter(std::filesystem::path path, std::vector<ParquetColumn> columns, KeyValues metadata)
    : path_(std::move(path)),
      file_(path_, std::ios::binary | std::ios::trunc),
      columns_(std::move(columns)),
      metadata_(std::move(metadata)) {
  for ([[maybe_unused]] const ParquetColumn& column : columns_)
    for ([[maybe_unused]] const std::size_t extent : column.shape) assert(extent > 0);
  write(kParquetMagic);
}

void ParquetWriter::write(const std::string& bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file_) throw DataError("{}: cannot be written", path_.string());
  position_ += static_cast<std::int64_t>(bytes.size());
}

ParquetWriter::Chunk ParquetWriter::write_page(const std::string& levels, const std::string& values,
                                               std::size_t count) {
  const std::size_t size = levels.size() + values.size();
  if (size > std::numeric_limits<std::int32_t>::max())
    throw DataError("{}: {} bytes of one column in a row group; pages of Parquet have less than 2 GiB", path_.string(),
                    size);
  const auto bytes = static_cast<std::int32_t>(size);
  const Chunk begin{.offset = position_, .bytes = 0, .values = static_cast<std::int64_t>(count)};
  write(Struct()
            .i32(1, kDataPage)
            .i32(2, bytes)
            .i32(3, bytes)
            .child(5, Struct().i32(1, static_cast<std::int32_t>(count)).i32(2, kPlain).i32(3, kRle).i32(4, kRle))
            .bytes());
  write(levels);
  write(values);
  return {.offset = begin.offset, .bytes = position_ - begin.offset, .values = begin.values};
}

void ParquetWriter::add_row_group(const std::vector<ParquetValues>& columns, std::size_t rows) {
  assert(columns.size() == columns_.size());
  std::vector<Chunk> chunks;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::size_t count = rows;
    for (const std::size_t extent : columns_[c].shape) count *= extent;
    assert(std::visit([](const auto& values) { return values.size(); }, columns[c]) == count);
    const std::string levels = levels_of(columns_[c].shape, rows);
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&columns[c])) {
      chunks.push_back(write_page(levels, plain<std::int64_t>(*whole), count));
    } else if (const auto* real = std::get_if<std::vector<float>>(&columns[c])) {
      chunks.push_back(write_page(levels, plain<float>(*real), count));
    } else if (const auto* wide = std::get_if<std::vector<double>>(&columns[c])) {
      chunks.push_back(write_page(levels, plain<double>(*wide), count));
    } else if (const auto* texts = std::get_if<std::vector<std::string>>(&columns[c])) {
      chunks.push_back(write_page(levels, plain(*texts), count));
    } else {
      std::string bytes, paths;
      for (const ParquetImage& image : std::get<std::vector<ParquetImage>>(columns[c])) {
        append_bytes(bytes, image.bytes);
        append_bytes(paths, image.path);
      }
      chunks.push_back(write_page("", bytes, count));
      chunks.push_back(write_page("", paths, count));
    }
  }
  groups_.emplace_back(rows, std::move(chunks));
  rows_ += rows;
}

void ParquetWriter::close() {
  std::vector<Struct> schema{Struct().text(4, "schema").i32(5, static_cast<std::int32_t>(columns_.size()))};
  std::vector<Leaf> leaves;
  for (const ParquetColumn& column : columns_) add_schema(column, schema, leaves);
  std::vector<Struct> groups;
  for (const auto& [rows, chunks] : groups_) {
    std::vector<Struct> columns;
    std::int64_t total = 0;
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      const Chunk& chunk = chunks[c];
      total += chunk.bytes;
      columns.push_back(Struct()
                            .i64(2, chunk.offset)
                            .child(3, Struct()
                                          .i32(1, leaves[c].type)
                                          .i32s(2, {kPlain, kRle})
                                          .texts(3, leaves[c].path)
                                          .i32(4, kUncompressed)
                                          .i64(5, chunk.values)
                                          .i64(6, chunk.bytes)
                                          .i64(7, chunk.bytes)
                                          .i64(9, chunk.offset)));
    }
    groups.push_back(Struct().structs(1, columns).i64(2, total).i64(3, static_cast<std::int64_t>(rows)));
  }
  std::vector<Struct> metadata;
  for (const auto& [key, value] : metadata_) metadata.push_back(Struct().text(1, key).text(2, value));
  Struct footer;
  footer.i32(1, 1).structs(2, schema).i64(3, static_cast<std::int64_t>(rows_)).structs(4, groups);
  if (!metadata.empty()) footer.structs(5, metadata);
  footer.text(6, "tacipc");
  const std::string bytes = footer.bytes();
  write(bytes);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  write(std::string(reinterpret_cast<const char*>(&size), sizeof(size)) + kParquetMagic);
  file_.close();
  if (!file_) throw DataError("{}: cannot be written", path_.string());
}

}  // namespace tacipc
