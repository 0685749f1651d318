// Reads configuration files: one call declares key, type and bounds; all errors of a file are reported together.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/types.h"
#include "common/base/value.h"

namespace tacipc {

/// Interval of allowed numbers; an open end excludes the bound itself. Independently of the interval, a reader refuses
/// numbers beyond the plausible range of the unit at the end of their key (10 m, 100 turns, 1e13 Pa …).
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;
  bool open_high = false;

  static Range any() { return {}; }
  static Range positive() { return {.low = 0.0, .open_low = true}; }
  static Range non_negative() { return {.low = 0.0}; }
  static Range between(double low, double high) { return {.low = low, .high = high}; }

  bool contains(double value) const;
  std::string text() const;
};

/// Reads one map of a YAML file. Reading a key marks it as known; finish() turns unread keys and all errors into one
/// ConfigError. After an error, a reader returns a value inside the bounds, so that reading continues and finds further
/// errors. Functions with a fallback return it if the key is absent; `optional_…` return nothing.
class ConfigReader {
 public:
  /// Opens a file.
  /// \throw DataError if the file cannot be read
  /// \throw ConfigError if it is not YAML or not a map
  static ConfigReader from_file(const std::filesystem::path& path);
  /// Reads from a text; `name` stands for the file in messages.
  static ConfigReader from_text(const std::string& text, const std::string& name);

  /// Read a number in a range.
  double number(const std::string& key, const Range& range = Range::any());
  double number_or(const std::string& key, double fallback, const Range& range = Range::any());
  std::optional<double> optional_number(const std::string& key, const Range& range = Range::any());

  /// Read a whole number from `low` to `high`.
  int integer(const std::string& key, int low, int high = std::numeric_limits<int>::max());
  int integer_or(const std::string& key, int fallback, int low, int high = std::numeric_limits<int>::max());

  /// Read true or false.
  bool flag(const std::string& key);
  bool flag_or(const std::string& key, bool fallback);

  /// Read a text.
  std::string text(const std::string& key);
  /// Reads a text that becomes the name of a file or folder (base/file_name.h).
  std::string file_name(const std::string& key);
  std::string text_or(const std::string& key, const std::string& fallback);
  std::optional<std::string> optional_text(const std::string& key);
  std::string choice(const std::string& key, const std::vector<std::string>& options);
  std::string choice_or(const std::string& key, const std::string& fallback, const std::vector<std::string>& options);

  /// Reads a list of exactly `count` numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Range& range = Range::any());
  std::vector<double> numbers_or(const std::string& key, std::vector<double> fallback,
                                 const Range& range = Range::any());
  Vector3 vector3(const std::string& key);
  /// Reads a list of different words, each one of `options`.
  std::vector<std::string> choices_or(const std::string& key, std::vector<std::string> fallback,
                                      const std::vector<std::string>& options);
  /// Reads a list of any number of numbers; empty if the key is absent.
  std::vector<double> any_numbers(const std::string& key, const Range& range = Range::any());
  /// Reads a list of texts; empty if the key is absent.
  std::vector<std::string> texts(const std::string& key);

  /// Return whether the key exists, and whether it holds a list.
  bool has(const std::string& key) const;
  bool is_list(const std::string& key) const;
  /// Returns the keys of this map, in file order.
  std::vector<std::string> keys() const;
  ConfigReader section(const std::string& key);
  /// Reads a section as T, where T::read(ConfigReader&, …) declares its keys.
  template <typename T, typename... Arguments>
  T read(const std::string& key, const Arguments&... arguments) {
    ConfigReader in = section(key);
    return T::read(in, arguments...);
  }
  /// Returns the map at a key; nothing if the key is absent.
  std::optional<ConfigReader> optional_section(const std::string& key);
  /// Returns the maps of a list; empty if the key is absent.
  std::vector<ConfigReader> sections(const std::string& key);
  /// Returns a map as a list of one, or the maps of a list with at least one.
  std::vector<ConfigReader> one_or_more_sections(const std::string& key);
  /// Marks a key as known without reading it, whatever it holds.
  void ignore(const std::string& key);

  /// Allows each key of the file to have a sibling `<key>_src` that states the source of its value: known, derived or
  /// guess. The source of a map or list applies to everything inside that has none.
  void accept_sources();
  /// Returns path and source of every given value that was read, in file order; `unstated` if it has no source.
  std::vector<std::pair<std::string, std::string>> sources() const;

  /// Reports an error at a key (at the map itself if the key is absent).
  void fault(const std::string& key, const std::string& reason);

  /// Ends reading.
  /// \throw ConfigError with every error of the whole file, in file order, including unknown keys
  void finish();

  /// Returns every value read so far, including defaults, as the record stores it.
  Value resolved() const;
  /// Returns the whole content of this map, read or not, in file order: scalars as their text, aliases expanded.
  Value content() const;
  /// Returns the file, or the name given with the text.
  std::string source() const;

 private:
  struct Node;
  struct Document;
  struct Convert;
  explicit ConfigReader(std::shared_ptr<Document> document, Node* node) : document_(std::move(document)), node_(node) {}

  Node* find(const std::string& key, bool required);
  void add_fault(const Node& node, const std::string& path, const std::string& reason);
  std::string path_of(const std::string& key) const;
  double to_number(const Node& node, const std::string& key, const Range& range, double otherwise);
  std::optional<std::string> to_scalar(const Node& node, const std::string& key);
  std::optional<std::string> to_choice(const Node& node, const std::string& key,
                                       const std::vector<std::string>& options);
  template <typename T>
  T keep(const std::string& key, T value);

  std::shared_ptr<Document> document_;
  Node* node_;
};

/// Reads a whole file as T, where T::read(ConfigReader&) declares the keys.
template <typename T>
T read_config(const std::filesystem::path& path) {
  ConfigReader in = ConfigReader::from_file(path);
  T config = T::read(in);
  in.finish();
  return config;
}

/// Returns the word of `known` nearest to `word` by edit distance, if near enough to be a likely typing error.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace tacipc
