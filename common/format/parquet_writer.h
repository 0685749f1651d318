// Writes Apache Parquet files: flat columns, lists of fixed shape, and images, uncompressed, one row group at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tacipc {

/// Type of a column's values. `image` is a group of `bytes` (binary) and `path` (text).
enum class ParquetType { i64, f32, f64, text, image };

/// Declaration of a column.
struct ParquetColumn {
  std::string name;
  ParquetType type;
  std::vector<std::size_t> shape = {};  // empty: one value per row; otherwise lengths of nested lists, outermost first
};

/// An image: the bytes of its file, and a path that identifies it.
struct ParquetImage {
  std::string bytes, path;
};

/// Values of one column, row after row, lists row-major.
/// \pre the column's type; rows times shape values
using ParquetValues = std::variant<std::vector<std::int64_t>, std::vector<float>, std::vector<double>,
                                   std::vector<std::string>, std::vector<ParquetImage>>;

/// Writes a file whose bytes depend on its content alone: every value is required, pages are PLAIN (format version 1),
/// levels of lists are runs, and each column of a row group has one page. Written row groups do not stay in memory.
/// \throw DataError from every function, naming the file, for disk errors and for pages of 2 GiB or more
/// Source: the format's specification, parquet.thrift and Encodings.md of Apache Parquet; Thrift's compact protocol.
class ParquetWriter {
 public:
  using KeyValues = std::vector<std::pair<std::string, std::string>>;

  /// \param metadata key-value pairs of the footer
  ParquetWriter(std::filesystem::path path, std::vector<ParquetColumn> columns, KeyValues metadata = {});

  /// Writes a row group.
  void add_row_group(const std::vector<ParquetValues>& columns, std::size_t rows);
  std::size_t rows() const { return rows_; }
  /// Writes the footer, without which the file is not valid.
  void close();

 private:
  struct Chunk {
    std::int64_t offset, bytes, values;
  };
  Chunk write_page(const std::string& levels, const std::string& values, std::size_t count);
  void write(const std::string& bytes);

  std::filesystem::path path_;
  std::ofstream file_;
  std::vector<ParquetColumn> columns_;
  KeyValues metadata_;
  std::int64_t position_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::pair<std::size_t, std::vector<Chunk>>> groups_;  // rows, and a chunk for each leaf of the schema
};

}  // namespace tacipc
