#include "common/config/config_document.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <string_view>

#include "common/base/error.h"
#include "common/base/printable.h"

namespace tacipc {

std::string joined_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string ConfigReader::Node::path() const {
  if (!parent) return "";
  if (parent->kind == Kind::list) return fmt::format("{}[{}]", parent->path(), place);
  return joined_path(parent->path(), parent->entries[place].key);
}

namespace {

/// Replaces the escapes \N and \_ (U+0085, U+00A0), which yaml-cpp reads as one byte each, by their UTF-8 characters.
std::string with_whole_characters(std::string_view text) {
  std::string whole;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) whole += '\xC2';
    whole += text.substr(at, std::max<std::size_t>(length, 1));
    at += std::max<std::size_t>(length, 1);
  }
  return whole;
}

}  // namespace

/// Builds the tree from yaml-cpp's events, part by part, so that content beyond a limit is refused before it is built.
struct ConfigReader::Convert final : YAML::EventHandler {
  static constexpr std::size_t kMaxDepth = 32;
  static constexpr std::size_t kMaxValues = 1'000'000;
  static constexpr std::size_t kMaxText = std::size_t{64} << 20;  // bytes, of the file and of all values
  static constexpr std::size_t kMaxKey = 1024;                    // bytes

  explicit Convert(Document& document) : document_(document) {}

  void OnDocumentStart(const YAML::Mark&) override { ++documents_; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(Node::Kind::empty, mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string& text) override {
    add(Node::Kind::scalar, mark, anchor, text);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(add(Node::Kind::list, mark, anchor), mark);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(add(Node::Kind::map, mark, anchor), mark);
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapEnd() override { open_.pop_back(); }

  /// Handles an alias. yaml-cpp refuses aliases before their anchor, but not inside the map or list with the anchor.
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const Node* original = anchors_.at(anchor);
    if (std::ranges::any_of(open_, [&](const Open& o) { return o.node == original; }))
      refuse(mark, "an alias inside its own anchor");
    attach(copy(*original, mark, open_.size()), mark);
  }

 private:
  /// A map or list that has not ended.
  struct Open {
    Node* node;
    bool has_key = false;            // in a map: the next value belongs to `key`
    std::optional<Node::Entry> key;  // entry without value; empty if it was refused
  };

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& reason) {
    document_.add(mark.line + 1, mark.column + 1, open_.empty() ? "" : open_.back().node->path(), reason);
    document_.raise();
  }

  void count(const YAML::Mark& mark, std::size_t bytes) {
    text_ += bytes;
    if (++values_ > kMaxValues) refuse(mark, fmt::format("more than {} values, aliases written out", kMaxValues));
    if (text_ > kMaxText) refuse(mark, fmt::format("more than {} MiB of text, aliases written out", kMaxText >> 20));
  }

  Node* add(Node::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor, const std::string& text = "") {
    auto node = std::make_unique<Node>();
    node->kind = kind;
    node->line = mark.line + 1;  // yaml-cpp counts from zero
    node->column = mark.column + 1;
    node->scalar = with_whole_characters(text);
    count(mark, node->scalar.size());
    Node* added = attach(std::move(node), mark);
    if (anchor != YAML::NullAnchor) anchors_[anchor] = added;
    return added;
  }

  void open(Node* node, const YAML::Mark& mark) {
    if (open_.size() == kMaxDepth) refuse(mark, fmt::format("nested more than {} deep", kMaxDepth));
    open_.push_back({.node = node, .key = std::nullopt});
  }

  /// Attaches a value or a key to the open map or list.
  Node* attach(std::unique_ptr<Node> node, const YAML::Mark& mark) {
    if (documents_ > 1)
      throw ConfigError({fmt::format("{}:{}:1: a second document begins; only one is read", printable(document_.name),
                                     mark.line + 1)});
    Node* added = node.get();
    if (open_.empty()) {
      document_.root = std::move(node);
    } else if (Open& top = open_.back(); top.node->kind == Node::Kind::list) {
      adopt(*top.node, *added, top.node->items.size());
      top.node->items.push_back(std::move(node));
    } else if (!top.has_key) {
      top.has_key = true;
      top.key = key_of(*top.node, *node, mark);
      unused_.push_back(std::move(node));
    } else {
      top.has_key = false;
      if (!top.key) {
        unused_.push_back(std::move(node));
      } else {
        adopt(*top.node, *added, top.node->entries.size());
        top.key->value = std::move(node);
        top.node->entries.push_back(*std::exchange(top.key, std::nullopt));
      }
    }
    return added;
  }

  static void adopt(const Node& parent, Node& child, std::size_t place) {
    child.parent = &parent;
    child.place = place;
  }

  std::optional<Node::Entry> key_of(Node& map, const Node& word, const YAML::Mark& mark) {
    const int line = mark.line + 1, column = mark.column + 1;
    if (word.kind != Node::Kind::scalar) {
      document_.add(line, column, map.path(), "a key must be a single word");
      return std::nullopt;
    }
    if (word.scalar.size() > kMaxKey) {
      document_.add(line, column, map.path(),
                    fmt::format("a key of more than {} bytes: '{}'", kMaxKey, excerpt(word.scalar)));
      return std::nullopt;
    }
    // yaml-cpp accepts both of two equal keys, silently.
    if (!map.entry_places.add(word.scalar, map.entries.size())) {
      document_.add(line, column, joined_path(map.path(), word.scalar),
                    fmt::format("key given twice (first in line {})", map.find(word.scalar)->line));
      return std::nullopt;
    }
    return Node::Entry{.key = word.scalar, .line = line, .column = column, .value = nullptr};
  }

  std::unique_ptr<Node> copy(const Node& original, const YAML::Mark& mark, std::size_t depth) {
    count(mark, original.scalar.size());
    auto node = std::make_unique<Node>();
    node->kind = original.kind;
    node->line = original.line;
    node->column = original.column;
    node->scalar = original.scalar;
    const bool holds = original.kind == Node::Kind::list || original.kind == Node::Kind::map;
    if (holds && depth == kMaxDepth) refuse(mark, fmt::format("nested more than {} deep", kMaxDepth));
    for (const auto& item : original.items) {
      node->items.push_back(copy(*item, mark, depth + 1));
      adopt(*node, *node->items.back(), node->items.size() - 1);
    }
    for (const Node::Entry& entry : original.entries) {
      count(mark, entry.key.size());
      node->entry_places.add(entry.key, node->entries.size());
      node->entries.push_back({entry.key, entry.line, entry.column, copy(*entry.value, mark, depth + 1)});
      adopt(*node, *node->entries.back().value, node->entries.size() - 1);
    }
    return node;
  }

  Document& document_;
  std::size_t documents_ = 0, values_ = 0, text_ = 0;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, const Node*> anchors_;
  std::vector<std::unique_ptr<Node>> unused_;  // keys, and content of refused keys, in which anchors may be
};

/// Checks the bytes.
/// \throw ConfigError at the first byte that YAML does not allow; yaml-cpp misreads some of them
static void check_bytes(std::string_view text, const std::string& name) {
  int line = 1;
  std::size_t line_start = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::size_t length = utf8_length(text.substr(at));
    const bool control = byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r';
    if (length == 0 || control)
      throw ConfigError({fmt::format("{}:{}:{}: not valid YAML: a byte 0x{:02x}, which is {}", printable(name), line,
                                     at - line_start + 1, byte, control ? "a control character" : "not UTF-8")});
    at += length;
    if (byte == '\n') {
      ++line;
      line_start = at;
    }
  }
}

std::unique_ptr<ConfigReader::Document> ConfigReader::Document::parse(const std::string& text,
                                                                      const std::string& name) {
  if (text.size() > Convert::kMaxText)
    throw ConfigError({fmt::format("{}:1:1: larger than {} MiB", printable(name), Convert::kMaxText >> 20)});
  check_bytes(text, name);
  auto document = std::make_unique<Document>();
  document->name = name;
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Convert convert(*document);
    while (parser.HandleNextDocument(convert)) {
    }
  } catch (const YAML::Exception& error) {
    throw ConfigError({fmt::format("{}:{}:{}: not valid YAML: {}", printable(name), error.mark.line + 1,
                                   error.mark.column + 1, printable(error.msg))});
  }
  if (!document->root) document->root = std::make_unique<Node>();
  if (document->root->kind != Node::Kind::map) {
    throw ConfigError(
        {fmt::format("{}:1:1: expected a map of keys, found {}", printable(name), document->root->kind_name())});
  }
  document->root->read = true;
  return document;
}

void ConfigReader::Document::add(int line, int column, const std::string& path, const std::string& reason) {
  constexpr std::size_t kLongestPath = 200, kLongest = 600;  // bytes; both contain text of the file
  faults.push_back({line, column,
                    fmt::format("{}:{}:{}: {}{}{}", printable(name), line, column, excerpt(path, kLongestPath),
                                path.empty() ? "" : ": ", excerpt(reason, kLongest))});
}

void ConfigReader::Document::raise() {
  std::ranges::stable_sort(
      faults, [](const Fault& a, const Fault& b) { return a.line != b.line ? a.line < b.line : a.column < b.column; });
  std::vector<std::string> texts;
  for (const Fault& fault : std::span(faults).first(std::min(faults.size(), kMaxFaults))) texts.push_back(fault.text);
  if (faults.size() > kMaxFaults)
    texts.push_back(fmt::format("{}: and {} more", printable(name), faults.size() - kMaxFaults));
  throw ConfigError(texts);
}

void ConfigReader::Document::collect_unknown(const Node& node) {
  for (const Node::Entry& entry : node.entries) {
    if (entry.known) {
      if (entry.value->read) collect_unknown(*entry.value);
      for (const auto& item : entry.value->items) {
        if (item->read) collect_unknown(*item);
      }
      continue;
    }
    if (accepts_sources && is_source(node, entry)) continue;
    const auto near = faults.size() < kMaxFaults ? nearest_word(entry.key, node.asked) : std::nullopt;
    add(entry.line, entry.column, joined_path(node.path(), entry.key),
        near ? fmt::format("unknown key (did you mean {}?)", *near) : std::string("unknown key"));
  }
}

namespace {
constexpr std::string_view kSourceSuffix = "_src";
const std::vector<std::string> kSourceWords = {"known", "derived", "guess"};
}  // namespace

bool ConfigReader::Document::is_source(const Node& node, const Node::Entry& entry) {
  if (!entry.key.ends_with(kSourceSuffix)) return false;
  const std::string of = entry.key.substr(0, entry.key.size() - kSourceSuffix.size());
  const Node::Entry* sibling = node.find(of);
  const bool there = sibling && sibling->known;
  if (!there) {
    add(entry.line, entry.column, joined_path(node.path(), entry.key),
        fmt::format("there is no {} whose source this could be", of));
  } else if (std::ranges::find(kSourceWords, entry.value->scalar) == kSourceWords.end()) {
    add(entry.value->line, entry.value->column, joined_path(node.path(), entry.key),
        fmt::format("'{}' is not one of {}", excerpt(entry.value->scalar), fmt::join(kSourceWords, ", ")));
  }
  return true;
}

void ConfigReader::Document::collect_sources(const Node& node, const std::string& inherited,
                                             std::vector<std::pair<std::string, std::string>>& out) {
  for (const Node::Entry& entry : node.entries) {
    if (!entry.known) continue;
    const Node::Entry* said = node.find(entry.key + std::string(kSourceSuffix));
    const std::string source = said ? said->value->scalar : inherited;
    const Node& value = *entry.value;
    const bool maps_inside =
        std::ranges::any_of(value.items, [](const auto& item) { return item->kind == Node::Kind::map; });
    if (value.kind == Node::Kind::map) {
      collect_sources(value, source, out);
    } else if (maps_inside) {
      for (const auto& item : value.items) collect_sources(*item, source, out);
    } else {
      out.emplace_back(value.path(), source);
    }
  }
}

Value::Map ConfigReader::Document::resolve(const Node& node) {
  Value::Map map = node.resolved;
  for (const auto& [index, child] : node.resolved_children) {
    if (child->kind == Node::Kind::list) {
      Value::List list;
      for (const auto& item : child->items) list.emplace_back(resolve(*item));
      map[index].second = Value(std::move(list));
    } else {
      map[index].second = Value(resolve(*child));
    }
  }
  return map;
}

Value ConfigReader::Document::content(const Node& node) {
  if (node.kind == Node::Kind::list) {
    Value::List list;
    for (const auto& item : node.items) list.push_back(content(*item));
    return list;
  }
  if (node.kind != Node::Kind::map) return node.scalar;
  Value::Map map;
  for (const Node::Entry& entry : node.entries) map.emplace_back(entry.key, content(*entry.value));
  return map;
}

}  // namespace tacipc
