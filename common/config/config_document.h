// Parsed file behind a ConfigReader: values with their locations, and the errors found so far.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Maps names to their indices in a list. Of equal names the first counts.
class NameIndex {
 public:
  /// Adds a name.
  /// \return false if the name has an index already
  bool add(const std::string& name, std::size_t place) {
    if (!places_) places_ = std::make_unique<Places>();
    return places_->emplace(name, place).second;
  }
  std::optional<std::size_t> find(const std::string& name) const {
    if (!places_) return std::nullopt;
    const auto found = places_->find(name);
    return found == places_->end() ? std::nullopt : std::optional(found->second);
  }

 private:
  using Places = std::unordered_map<std::string, std::size_t>;
  std::unique_ptr<Places> places_;  // null for values that are not maps, which are most
};

/// A value of the file, with its location and what readers did with it.
struct ConfigReader::Node {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  int line = 0;
  int column = 0;
  const Node* parent = nullptr;  // parent that holds this node as its `place`th entry or item
  std::size_t place = 0;
  std::string scalar;
  std::vector<std::unique_ptr<Node>> items;
  struct Entry {
    std::string key;
    int line;
    int column;
    std::unique_ptr<Node> value;
    bool known = false;
  };
  std::vector<Entry> entries;
  NameIndex entry_places;
  std::vector<std::string> asked;  // keys that readers asked for, used to suggest similar ones
  NameIndex asked_places;
  bool read = false;  // whether a reader looked inside this map
  Value::Map resolved;
  NameIndex resolved_places;
  std::vector<std::pair<std::size_t, Node*>> resolved_children;

  /// Returns keys and indices from the top to this node. Not stored, because with long keys all paths together may be
  /// much larger than the file.
  std::string path() const;
  Entry* find(const std::string& key) {
    const auto at = entry_places.find(key);
    return at ? &entries[*at] : nullptr;
  }
  const Entry* find(const std::string& key) const {
    const auto at = entry_places.find(key);
    return at ? &entries[*at] : nullptr;
  }
  /// Stores the value that a reader returned.
  void resolve(const std::string& key, Value value) {
    resolved_places.add(key, resolved.size());
    resolved.emplace_back(key, std::move(value));
  }
  const char* kind_name() const {
    switch (kind) {
      case Kind::empty: return "nothing";
      case Kind::scalar: return "a single value";
      case Kind::list: return "a list";
      case Kind::map: return "a map";
    }
    return "";
  }
};

/// The parsed file.
struct ConfigReader::Document {
  std::string name;
  std::unique_ptr<Node> root;
  struct Fault {
    int line;
    int column;
    std::string text;
  };
  std::vector<Fault> faults;
  static constexpr std::size_t kMaxFaults = 100;  // largest number of reported errors
  bool accepts_sources = false;

  /// Parses a text.
  /// \throw ConfigError if the text is not YAML, or exceeds the limits in docs/files.md
  static std::unique_ptr<Document> parse(const std::string& text, const std::string& name);
  void add(int line, int column, const std::string& path, const std::string& reason);
  /// Throws the collected errors, in file order.
  [[noreturn]] void raise();
  void collect_unknown(const Node& node);
  /// Returns whether an entry states the source of its sibling; an invalid source becomes an error.
  bool is_source(const Node& node, const Node::Entry& entry);
  static void collect_sources(const Node& node, const std::string& inherited,
                              std::vector<std::pair<std::string, std::string>>& out);
  static Value::Map resolve(const Node& node);
  static Value content(const Node& node);
};

/// Returns path.key, or key at the top.
std::string joined_path(const std::string& path, const std::string& key);

}  // namespace tacipc
