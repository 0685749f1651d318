// What a ConfigReader reads from: the parsed file with the place of every value, and the faults met so far.
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

/// Places of names in a list, found without looking at all of them. Of equal names the first counts.
class NameIndex {
 public:
  /// False if the name has a place already.
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
  std::unique_ptr<Places> places_;  // most values of a file are no maps
};

struct ConfigReader::Node {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  int line = 0;
  int column = 0;
  const Node* parent = nullptr;  // that holds it as its `place`th entry or item
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
  std::vector<std::string> asked;  // every key a reader asked for, to suggest a near one
  NameIndex asked_places;
  bool read = false;  // a reader looked inside this map
  Value::Map resolved;
  NameIndex resolved_places;
  std::vector<std::pair<std::size_t, Node*>> resolved_children;

  /// Keys and indices from the top to here. Not kept, as with long keys all paths together may be much larger than the
  /// file.
  std::string path() const;
  Entry* find(const std::string& key) {
    const auto at = entry_places.find(key);
    return at ? &entries[*at] : nullptr;
  }
  const Entry* find(const std::string& key) const {
    const auto at = entry_places.find(key);
    return at ? &entries[*at] : nullptr;
  }
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

struct ConfigReader::Document {
  std::string name;
  std::unique_ptr<Node> root;
  struct Fault {
    int line;
    int column;
    std::string text;
  };
  std::vector<Fault> faults;
  static constexpr std::size_t kMaxFaults = 100;  // that are told
  bool accepts_sources = false;

  /// \throw ConfigError if the text is not YAML, or more than the limits that docs/files.md names
  static std::unique_ptr<Document> parse(const std::string& text, const std::string& name);
  void add(int line, int column, const std::string& path, const std::string& reason);
  /// Throws what was collected, in file order.
  [[noreturn]] void raise();
  void collect_unknown(const Node& node);
  /// Whether an entry says where its sibling comes from; what it says wrongly becomes a fault.
  bool is_source(const Node& node, const Node::Entry& entry);
  static void collect_sources(const Node& node, const std::string& inherited,
                              std::vector<std::pair<std::string, std::string>>& out);
  static Value::Map resolve(const Node& node);
  static Value content(const Node& node);
};

/// path.key, or key at the top.
std::string joined_path(const std::string& path, const std::string& key);

}  // namespace tacipc
