// What a ConfigReader reads from: the parsed file with the place of every value, and the faults met so far.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

struct ConfigReader::Node {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  int line = 0;
  int column = 0;
  std::string path;
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
  std::vector<std::string> asked;  // every key a reader asked for, to suggest a near one
  bool read = false;               // a reader looked inside this map
  Value::Map resolved;
  std::vector<std::pair<std::size_t, Node*>> resolved_children;

  const char* kind_name() const {
    switch (kind) {
      case Kind::empty:
        return "nothing";
      case Kind::scalar:
        return "a single value";
      case Kind::list:
        return "a list";
      case Kind::map:
        return "a map";
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
  bool accepts_sources = false;

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
