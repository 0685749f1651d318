// Reads the record of another stage. Values may be absent but not malformed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// A map of a record. An absent map behaves as an empty one, so that lookups can be chained.
class Record {
 public:
  /// Reads a record.
  /// \throw DataError if the file cannot be read
  /// \throw ConfigError if it is not a YAML map
  static Record from_file(const std::filesystem::path& path);

  /// Returns the map at a key.
  Record section(const std::string& key) const;
  /// Returns the maps of a list; empty if the key is absent.
  std::vector<Record> sections(const std::string& key) const;
  /// Returns a map as a list of one, or the maps of a list. Empty if the key is absent.
  std::vector<Record> one_or_many(const std::string& key) const;
  /// Returns whether the key exists.
  bool has(const std::string& key) const { return reader_ && reader_->has(key); }
  /// Returns the keys of this map, in file order.
  std::vector<std::string> keys() const { return reader_ ? reader_->keys() : std::vector<std::string>(); }

  /// Return a value; nothing if the key is absent.
  /// \throw DataError naming file and key if the value has another type
  std::optional<std::string> text(const std::string& key) const;
  std::optional<double> number(const std::string& key) const;
  std::optional<int> count(const std::string& key) const;  // a whole number ≥ 0
  std::optional<bool> flag(const std::string& key) const;
  /// Returns the texts of a list; empty if the key is absent.
  std::vector<std::string> texts(const std::string& key) const;
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t how_many) const;
  /// Returns lowest and highest of a list of two numbers; a single number counts as both.
  std::optional<std::pair<double, double>> range(const std::string& key) const;

  /// Return a value that must be present.
  /// \throw DataError naming file and key if it is absent
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

  std::optional<ConfigReader> reader_;  // errors of this reader are not used: they include unknown keys
  std::string file_;
  std::string path_;
};

}  // namespace tacipc
