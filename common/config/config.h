// Reading configuration: one line declares key, type and bounds; all faults of a file are reported together.
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

/// Interval of allowed numbers; an open end excludes the bound itself. However wide it is, a reader refuses numbers
/// beyond what has a meaning in the unit with which their key ends (10 m, 100 turns, 1e13 Pa …).
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

/// One map of a YAML file. Reading a key marks it as known; `finish` turns unread keys, and every fault met, into
/// one ConfigError. After a fault a reader returns some value inside the bounds, so that reading continues and finds
/// the rest.
class ConfigReader {
 public:
  /// \throw DataError if the file cannot be read, ConfigError if it is not YAML or not a map.
  static ConfigReader from_file(const std::filesystem::path& path);
  /// The same from text; `name` stands for the file in messages.
  static ConfigReader from_text(const std::string& text, const std::string& name);

  double number(const std::string& key, const Range& range = Range::any());
  double number_or(const std::string& key, double fallback, const Range& range = Range::any());
  std::optional<double> optional_number(const std::string& key, const Range& range = Range::any());

  int integer(const std::string& key, int low, int high = std::numeric_limits<int>::max());
  int integer_or(const std::string& key, int fallback, int low, int high = std::numeric_limits<int>::max());

  bool flag(const std::string& key);
  bool flag_or(const std::string& key, bool fallback);

  std::string text(const std::string& key);
  /// A text that becomes a file's or folder's name (base/file_name.h).
  std::string file_name(const std::string& key);
  std::string text_or(const std::string& key, const std::string& fallback);
  std::optional<std::string> optional_text(const std::string& key);
  std::string choice(const std::string& key, const std::vector<std::string>& options);
  std::string choice_or(const std::string& key, const std::string& fallback, const std::vector<std::string>& options);

  /// A list of exactly `count` numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Range& range = Range::any());
  std::vector<double> numbers_or(const std::string& key, std::vector<double> fallback,
                                 const Range& range = Range::any());
  Vector3 vector3(const std::string& key);
  /// A list of different words, each one of `options`.
  std::vector<std::string> choices_or(const std::string& key, std::vector<std::string> fallback,
                                      const std::vector<std::string>& options);
  /// A list of any number of numbers (empty where the key is absent).
  std::vector<double> any_numbers(const std::string& key, const Range& range = Range::any());
  /// A list of words (empty where the key is absent).
  std::vector<std::string> texts(const std::string& key);

  bool has(const std::string& key) const;
  bool is_list(const std::string& key) const;
  /// The keys of this map, in file order.
  std::vector<std::string> keys() const;
  ConfigReader section(const std::string& key);
  /// The section as T, where T::read(ConfigReader&, …) declares its keys.
  template <typename T, typename... Arguments>
  T read(const std::string& key, const Arguments&... arguments) {
    ConfigReader in = section(key);
    return T::read(in, arguments...);
  }
  std::optional<ConfigReader> optional_section(const std::string& key);
  /// A list of maps (empty where the key is absent).
  std::vector<ConfigReader> sections(const std::string& key);
  /// A map, or a list of at least one map.
  std::vector<ConfigReader> one_or_more_sections(const std::string& key);
  /// Marks a key, whatever it holds, as known without reading it.
  void ignore(const std::string& key);

  /// From now on any key of the file may have a sibling `<key>_src` that says where its value comes from: known,
  /// derived or guess. Of a map or list it holds for everything inside that has none of its own.
  void accept_sources();
  /// Every value that was asked for and given, by path, with its source; `unstated` where there is none. In file order.
  std::vector<std::pair<std::string, std::string>> sources() const;

  /// Reports a fault of meaning at a key (at the map itself if the key is absent).
  void fault(const std::string& key, const std::string& reason);

  /// \throw ConfigError with every fault of the whole file, in file order, unknown keys included.
  void finish();

  /// Every value read so far, defaults included, as the record repeats it.
  Value resolved() const;
  /// Everything this map says, read or not, in file order: scalars as the text that stands there, aliases written out.
  Value content() const;
  /// The file, or the name given with the text.
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

/// The word of `known` nearest to `word` by edit distance, if near enough to be a likely slip.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace tacipc
