// Writing Apache Parquet files: flat columns, lists of fixed shape, and images, uncompressed, a row group at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tacipc {

/// How a column's values lie in the file. `image` is a group of `bytes` (binary) and `path` (text).
enum class ParquetType { i64, f32, f64, text, image };

struct ParquetColumn {
  std::string name;
  ParquetType type;
  std::vector<std::size_t> shape = {};  // none: a value a row; else nested lists of these lengths, the outermost first
};

struct ParquetImage {
  std::string bytes, path;
};

/// The values of one column, row after row, lists row-major. \pre of the column's type, as many as rows times shape
using ParquetValues = std::variant<std::vector<std::int64_t>, std::vector<float>, std::vector<double>,
                                   std::vector<std::string>, std::vector<ParquetImage>>;

/// A file whose bytes depend on its content alone: every value is required, pages are PLAIN (format version 1), levels
/// of lists are runs, one page a column and row group. What is written of a row group does not stay in memory. Errors
/// of the disk are DataErrors that name the file, as is a page of 2 GiB or more.
/// Source: the format's specification, parquet.thrift and Encodings.md of Apache Parquet; Thrift's compact protocol.
class ParquetWriter {
 public:
  using KeyValues = std::vector<std::pair<std::string, std::string>>;

  /// `metadata` goes into the footer.
  ParquetWriter(std::filesystem::path path, std::vector<ParquetColumn> columns, KeyValues metadata = {});

  void add_row_group(const std::vector<ParquetValues>& columns, std::size_t rows);
  std::size_t rows() const { return rows_; }
  /// The footer; without it the file is none.
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
  std::vector<std::pair<std::size_t, std::vector<Chunk>>> groups_;  // rows, a chunk for each leaf of the schema
};

}  // namespace tacipc
