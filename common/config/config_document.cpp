#include "common/config/config_document.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <string_view>

#include "common/base/error.h"

namespace tacipc {

std::string joined_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

/// Builds the tree from what yaml-cpp parsed.
struct ConfigReader::Convert {
  static constexpr int kMaxDepth = 32;

  static std::unique_ptr<Node> convert(Document& document, const YAML::Node& yaml, const std::string& path,
                                       int depth = 0) {
    auto node = std::make_unique<Node>();
    node->line = yaml.Mark().line + 1;  // yaml-cpp counts from zero
    node->column = yaml.Mark().column + 1;
    node->path = path;
    if (depth > kMaxDepth) {
      document.add(node->line, node->column, path, "nested too deeply (an alias inside its own anchor?)");
      return node;
    }
    if (yaml.IsScalar()) {
      node->kind = Node::Kind::scalar;
      node->scalar = yaml.Scalar();
    } else if (yaml.IsSequence()) {
      node->kind = Node::Kind::list;
      for (std::size_t i = 0; i < yaml.size(); ++i)
        node->items.push_back(convert(document, yaml[i], fmt::format("{}[{}]", path, i), depth + 1));
    } else if (yaml.IsMap()) {
      node->kind = Node::Kind::map;
      for (const auto& pair : yaml) {
        if (!pair.first.IsScalar()) {
          document.add(pair.first.Mark().line + 1, pair.first.Mark().column + 1, path, "a key must be a single word");
          continue;
        }
        const std::string key = pair.first.Scalar();
        const int line = pair.first.Mark().line + 1, column = pair.first.Mark().column + 1;
        // yaml-cpp keeps both of two equal keys and answers with the first, silently.
        const auto same =
            std::find_if(node->entries.begin(), node->entries.end(), [&](const auto& e) { return e.key == key; });
        if (same != node->entries.end()) {
          document.add(line, column, joined_path(path, key),
                       fmt::format("key given twice (first in line {})", same->line));
          continue;
        }
        node->entries.push_back({key, line, column, convert(document, pair.second, joined_path(path, key), depth + 1)});
      }
    }
    return node;
  }
};

std::unique_ptr<ConfigReader::Document> ConfigReader::Document::parse(const std::string& text,
                                                                      const std::string& name) {
  auto document = std::make_unique<Document>();
  document->name = name;
  try {
    const std::vector<YAML::Node> parts = YAML::LoadAll(text);
    if (parts.size() > 1) {
      throw ConfigError(
          {fmt::format("{}:{}:1: a second document begins; only one is read", name, parts[1].Mark().line + 1)});
    }
    document->root = Convert::convert(*document, parts.empty() ? YAML::Node() : parts[0], "");
  } catch (const YAML::Exception& error) {
    throw ConfigError(
        {fmt::format("{}:{}:{}: not valid YAML: {}", name, error.mark.line + 1, error.mark.column + 1, error.msg)});
  }
  if (document->root->kind != Node::Kind::map) {
    throw ConfigError({fmt::format("{}:1:1: expected a map of keys, found {}", name, document->root->kind_name())});
  }
  document->root->read = true;
  return document;
}

void ConfigReader::Document::add(int line, int column, const std::string& path, const std::string& reason) {
  faults.push_back(
      {line, column, fmt::format("{}:{}:{}: {}{}{}", name, line, column, path, path.empty() ? "" : ": ", reason)});
}

void ConfigReader::Document::raise() {
  std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  });
  std::vector<std::string> texts;
  for (const Fault& fault : faults) texts.push_back(fault.text);
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
    const auto near = nearest_word(entry.key, node.asked);
    add(entry.line, entry.column, joined_path(node.path, entry.key),
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
  const bool there =
      std::any_of(node.entries.begin(), node.entries.end(), [&](const auto& e) { return e.key == of && e.known; });
  if (!there) {
    add(entry.line, entry.column, joined_path(node.path, entry.key),
        fmt::format("there is no {} whose source this could be", of));
  } else if (std::find(kSourceWords.begin(), kSourceWords.end(), entry.value->scalar) == kSourceWords.end()) {
    add(entry.value->line, entry.value->column, joined_path(node.path, entry.key),
        fmt::format("'{}' is not one of {}", entry.value->scalar, fmt::join(kSourceWords, ", ")));
  }
  return true;
}

void ConfigReader::Document::collect_sources(const Node& node, const std::string& inherited,
                                             std::vector<std::pair<std::string, std::string>>& out) {
  for (const Node::Entry& entry : node.entries) {
    if (!entry.known) continue;
    std::string source = inherited;
    for (const Node::Entry& sibling : node.entries) {
      if (sibling.key == entry.key + std::string(kSourceSuffix)) source = sibling.value->scalar;
    }
    const Node& value = *entry.value;
    const bool maps_inside = std::any_of(value.items.begin(), value.items.end(),
                                         [](const auto& item) { return item->kind == Node::Kind::map; });
    if (value.kind == Node::Kind::map) {
      collect_sources(value, source, out);
    } else if (maps_inside) {
      for (const auto& item : value.items) collect_sources(*item, source, out);
    } else {
      out.emplace_back(value.path, source);
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
