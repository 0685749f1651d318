// Lookups in the record of another stage, where values may be absent but not malformed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// A map of a record. Looking into a map that is not there finds nothing, so lookups can be chained.
class Record {
 public:
  /// \throw DataError if the file cannot be read, ConfigError if it is not a YAML map.
  static Record from_file(const std::filesystem::path& path);

  Record section(const std::string& key) const;
  /// The maps of a list; empty where the key is absent.
  std::vector<Record> sections(const std::string& key) const;
  /// A map, or the maps of a list: what may be written either way. Empty where the key is absent.
  std::vector<Record> one_or_many(const std::string& key) const;
  bool has(const std::string& key) const { return reader_ && reader_->has(key); }
  /// The keys of this map, in file order.
  std::vector<std::string> keys() const { return reader_ ? reader_->keys() : std::vector<std::string>(); }

  /// Absent: nullopt. \throw DataError naming file and key if the value is of another type.
  std::optional<std::string> text(const std::string& key) const;
  std::optional<double> number(const std::string& key) const;
  std::optional<int> count(const std::string& key) const;  // a whole number ≥ 0
  std::optional<bool> flag(const std::string& key) const;
  /// The words of a list; empty where the key is absent.
  std::vector<std::string> texts(const std::string& key) const;
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t how_many) const;
  /// A number, or a list of two: lowest and highest. Of a number both are that.
  std::optional<std::pair<double, double>> range(const std::string& key) const;

  /// \throw DataError naming file and key if the value is absent.
  std::string required_text(const std::string& key) const { return present(text(key), key); }
  double required_number(const std::string& key) const { return present(number(key), key); }
  int required_count(const std::string& key) const { return present(count(key), key); }
  bool required_flag(const std::string& key) const { return present(flag(key), key); }

 private:
  Record(std::optional<ConfigReader> reader, std::string file, std::string path)
      : reader_(std::move(reader)), file_(std::move(file)), path_(std::move(path)) {}
  std::string place(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& reason) const;
  template <typename T>
  T present(std::optional<T> value, const std::string& key) const {
    if (!value) refuse(key, "missing");
    return *value;
  }

  std::optional<ConfigReader> reader_;  // its own list of faults is not used: it would also complain of unknown keys
  std::string file_;
  std::string path_;
};

}  // namespace tacipc
