#include "common/config/config.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/file_name.h"
#include "common/base/files.h"
#include "common/base/parse.h"
#include "common/base/printable.h"
#include "common/config/config_document.h"

namespace tacipc {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

bool Range::contains(double value) const {
  return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
}

std::string Range::text() const {
  const bool no_low = std::isinf(low), no_high = std::isinf(high);
  return fmt::format("{}{}, {}{}", open_low || no_low ? "(" : "[",
                     no_low ? std::string("-inf") : fmt::format("{}", low),
                     no_high ? std::string("inf") : fmt::format("{}", high), open_high || no_high ? ")" : "]");
}

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    // Words whose lengths differ this much cannot be nearer, and a word may be as long as a file.
    if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) >= best_distance) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

ConfigReader ConfigReader::from_file(const std::filesystem::path& path) {
  return from_text(read_file(path), path.lexically_normal().string());
}

ConfigReader ConfigReader::from_text(const std::string& text, const std::string& name) {
  std::shared_ptr<Document> document = Document::parse(text, name);
  Node* root = document->root.get();
  return ConfigReader(std::move(document), root);
}

std::string ConfigReader::source() const { return document_->name; }

std::string ConfigReader::path_of(const std::string& key) const { return joined_path(node_->path(), key); }

void ConfigReader::add_fault(const Node& node, const std::string& path, const std::string& reason) {
  document_->add(node.line, node.column, path, reason);
}

ConfigReader::Node* ConfigReader::find(const std::string& key, bool required) {
  if (node_->asked_places.add(key, node_->asked.size())) node_->asked.push_back(key);
  if (Node::Entry* entry = node_->find(key)) {
    entry->known = true;
    return entry->value.get();
  }
  if (required) add_fault(*node_, path_of(key), "missing");
  return nullptr;
}

template <typename T>
T ConfigReader::keep(const std::string& key, T value) {
  if (const auto place = node_->resolved_places.find(key))
    node_->resolved[*place].second = Value(value);
  else
    node_->resolve(key, Value(value));
  return value;
}

std::optional<std::string> ConfigReader::to_scalar(const Node& node, const std::string& key) {
  if (node.kind == Node::Kind::scalar) return node.scalar;
  add_fault(node, path_of(key), fmt::format("expected a single value, found {}", node.kind_name()));
  return std::nullopt;
}

namespace {

struct UnitBound {
  std::string_view unit;  // suffix of the key
  double largest;
};
// Bounds of at least a hundred times the values around a tactile sensor. Beyond them a motion would never end, or a
// square would overflow.
constexpr UnitBound kUnitBounds[] = {{"_mm", 1e4}, {"_um", 1e7},    {"_px", 1e5},   {"_deg", 3.6e4},
                                     {"_s", 1e9},  {"_n", 1e6},     {"_pa", 1e13},  {"_g", 1e6},
                                     {"_kg", 1e3}, {"_kg_m3", 1e7}, {"_m_s2", 1e4}, {"_hz", 1e6}};
constexpr double kLargest = 1e16;  // of numbers without one of these units, such as seeds up to 2^53

double largest_of(std::string_view key) {
  key = key.substr(0, key.find('['));  // key of the list, for an item
  for (const UnitBound& bound : kUnitBounds)
    if (key.ends_with(bound.unit)) return bound.largest;
  return kLargest;
}

}  // namespace

double ConfigReader::to_number(const Node& node, const std::string& key, const Range& range, double otherwise) {
  const auto scalar = to_scalar(node, key);
  if (!scalar) return otherwise;
  std::string_view digits = *scalar;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const auto value = parse_number<double>(digits);
  if (!value || !std::isfinite(*value)) {
    add_fault(node, path_of(key), fmt::format("expected a number, found '{}'", excerpt(*scalar)));
    return otherwise;
  }
  if (!range.contains(*value)) {
    add_fault(node, path_of(key), fmt::format("{} is outside {}", excerpt(*scalar), range.text()));
    return otherwise;
  }
  if (const double largest = largest_of(key); std::abs(*value) > largest) {
    add_fault(node, path_of(key), fmt::format("{} is beyond {}", excerpt(*scalar), largest));
    return otherwise;
  }
  return *value;
}

namespace {
double inside(const Range& range) {
  if (range.contains(1.0)) return 1.0;
  if (std::isinf(range.low)) return range.high - 1.0;
  return std::isinf(range.high) ? range.low + 1.0 : 0.5 * (range.low + range.high);
}
}  // namespace

// A missing required key is reported, then read like an optional one.
double ConfigReader::number(const std::string& key, const Range& range) {
  find(key, true);
  return number_or(key, inside(range), range);
}

double ConfigReader::number_or(const std::string& key, double fallback, const Range& range) {
  const Node* node = find(key, false);
  return keep(key, node ? to_number(*node, key, range, fallback) : fallback);
}

std::optional<double> ConfigReader::optional_number(const std::string& key, const Range& range) {
  const Node* node = find(key, false);
  if (!node) return std::nullopt;
  return keep(key, to_number(*node, key, range, inside(range)));
}

int ConfigReader::integer(const std::string& key, int low, int high) {
  find(key, true);
  return integer_or(key, low, low, high);
}

int ConfigReader::integer_or(const std::string& key, int fallback, int low, int high) {
  const Node* node = find(key, false);
  const auto scalar = node ? to_scalar(*node, key) : std::nullopt;
  if (!scalar) return keep(key, fallback);
  const auto value = parse_number<long long>(*scalar);
  if (!value) {
    add_fault(*node, path_of(key), fmt::format("expected a whole number, found '{}'", excerpt(*scalar)));
    return keep(key, fallback);
  }
  if (*value < low || *value > high) {
    const Range range{.low = static_cast<double>(low), .high = static_cast<double>(high)};
    add_fault(*node, path_of(key),
              high == std::numeric_limits<int>::max() ? fmt::format("{} is below {}", *value, low)
                                                      : fmt::format("{} is outside {}", *value, range.text()));
    return keep(key, fallback);
  }
  return keep(key, static_cast<int>(*value));
}

bool ConfigReader::flag(const std::string& key) {
  find(key, true);
  return flag_or(key, false);
}

bool ConfigReader::flag_or(const std::string& key, bool fallback) {
  const Node* node = find(key, false);
  const auto scalar = node ? to_scalar(*node, key) : std::nullopt;
  if (!scalar) return keep(key, fallback);
  if (*scalar == "true" || *scalar == "false") return keep(key, *scalar == "true");
  add_fault(*node, path_of(key), fmt::format("expected true or false, found '{}'", excerpt(*scalar)));
  return keep(key, fallback);
}

std::string ConfigReader::text(const std::string& key) {
  find(key, true);
  return text_or(key, "");
}

std::string ConfigReader::file_name(const std::string& key) {
  std::string name = text(key);
  if (has(key) && !is_file_name(name)) fault(key, fmt::format("'{}': {}", excerpt(name), kFileNameRule));
  return name;
}

std::string ConfigReader::text_or(const std::string& key, const std::string& fallback) {
  const Node* node = find(key, false);
  return keep(key, node ? to_scalar(*node, key).value_or(fallback) : fallback);
}

std::optional<std::string> ConfigReader::optional_text(const std::string& key) {
  const Node* node = find(key, false);
  if (!node) return std::nullopt;
  return keep(key, to_scalar(*node, key).value_or(""));
}

std::string ConfigReader::choice(const std::string& key, const std::vector<std::string>& options) {
  find(key, true);
  return choice_or(key, options.front(), options);
}

std::string ConfigReader::choice_or(const std::string& key, const std::string& fallback,
                                    const std::vector<std::string>& options) {
  const Node* node = find(key, false);
  return keep(key, node ? to_choice(*node, key, options).value_or(fallback) : fallback);
}

std::optional<std::string> ConfigReader::to_choice(const Node& node, const std::string& key,
                                                   const std::vector<std::string>& options) {
  auto scalar = to_scalar(node, key);
  if (!scalar || std::ranges::find(options, *scalar) != options.end()) return scalar;
  const auto near = nearest_word(*scalar, options);
  add_fault(node, path_of(key),
            fmt::format("'{}' is not one of {}{}", excerpt(*scalar), fmt::join(options, ", "),
                        near ? fmt::format(" (did you mean {}?)", *near) : std::string()));
  return std::nullopt;
}

std::vector<std::string> ConfigReader::choices_or(const std::string& key, std::vector<std::string> fallback,
                                                  const std::vector<std::string>& options) {
  std::vector<std::string> words = std::move(fallback);
  if (const Node* node = find(key, false)) {
    words.clear();
    if (node->kind != Node::Kind::list)
      add_fault(*node, path_of(key), fmt::format("expected a list of words, found {}", node->kind_name()));
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const std::string item = fmt::format("{}[{}]", key, i);
      const auto word = to_choice(*node->items[i], item, options);
      if (!word) continue;
      if (std::ranges::find(words, *word) != words.end())
        add_fault(*node->items[i], path_of(item), *word + " is given twice");
      words.push_back(*word);
    }
  }
  keep(key, Value::List(words.begin(), words.end()));
  return words;
}

std::vector<double> ConfigReader::numbers(const std::string& key, std::size_t count, const Range& range) {
  find(key, true);
  return numbers_or(key, std::vector<double>(count, inside(range)), range);
}

std::vector<double> ConfigReader::numbers_or(const std::string& key, std::vector<double> fallback, const Range& range) {
  const Node* node = find(key, false);
  if (!node) return keep(key, fallback);
  if (node->kind != Node::Kind::list || node->items.size() != fallback.size()) {
    const std::string found =
        node->kind == Node::Kind::list ? fmt::format("a list of {}", node->items.size()) : node->kind_name();
    add_fault(*node, path_of(key), fmt::format("expected a list of {} numbers, found {}", fallback.size(), found));
    return keep(key, fallback);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    values.push_back(to_number(*node->items[i], fmt::format("{}[{}]", key, i), range, fallback[i]));
  }
  return keep(key, values);
}

std::vector<double> ConfigReader::any_numbers(const std::string& key, const Range& range) {
  const Node* node = find(key, false);
  if (node && node->kind == Node::Kind::list) return numbers(key, node->items.size(), range);
  return numbers_or(key, {}, range);
}

Vector3 ConfigReader::vector3(const std::string& key) {
  const auto values = numbers(key, 3);
  return {values[0], values[1], values[2]};
}

std::vector<std::string> ConfigReader::texts(const std::string& key) {
  std::vector<std::string> words;
  if (const Node* node = find(key, false)) {
    if (node->kind != Node::Kind::list)
      add_fault(*node, path_of(key), fmt::format("expected a list of words, found {}", node->kind_name()));
    for (std::size_t i = 0; i < node->items.size(); ++i)
      words.push_back(to_scalar(*node->items[i], fmt::format("{}[{}]", key, i)).value_or(""));
  }
  keep(key, Value::List(words.begin(), words.end()));
  return words;
}

bool ConfigReader::has(const std::string& key) const { return node_->find(key) != nullptr; }

bool ConfigReader::is_list(const std::string& key) const {
  const Node::Entry* entry = node_->find(key);
  return entry && entry->value->kind == Node::Kind::list;
}

std::vector<std::string> ConfigReader::keys() const {
  std::vector<std::string> names;
  for (const auto& entry : node_->entries) names.push_back(entry.key);
  return names;
}

void ConfigReader::ignore(const std::string& key) { find(key, false); }

ConfigReader ConfigReader::section(const std::string& key) {
  Node* node = find(key, true);
  if (node && node->kind == Node::Kind::map) {
    if (!node->read) {
      node->read = true;
      node_->resolved_children.emplace_back(node_->resolved.size(), node);
      node_->resolve(key, Value());
    }
    return ConfigReader(document_, node);
  }
  if (node) add_fault(*node, path_of(key), fmt::format("expected a map, found {}", node->kind_name()));
  // Reading continues inside an empty map of a separate document, whose errors would only repeat this one.
  return from_text("{}", document_->name);
}

std::optional<ConfigReader> ConfigReader::optional_section(const std::string& key) {
  if (!find(key, false)) return std::nullopt;
  return section(key);
}

std::vector<ConfigReader> ConfigReader::sections(const std::string& key) {
  std::vector<ConfigReader> readers;
  Node* node = find(key, false);
  if (!node) return readers;
  if (node->kind != Node::Kind::list) {
    add_fault(*node, path_of(key), fmt::format("expected a list of maps, found {}", node->kind_name()));
    return readers;
  }
  node_->resolved_children.emplace_back(node_->resolved.size(), node);
  node_->resolve(key, Value());
  for (const auto& item : node->items) {
    if (item->kind != Node::Kind::map) {
      add_fault(*item, item->path(), fmt::format("expected a map, found {}", item->kind_name()));
      continue;
    }
    item->read = true;
    readers.push_back(ConfigReader(document_, item.get()));
  }
  return readers;
}

std::vector<ConfigReader> ConfigReader::one_or_more_sections(const std::string& key) {
  const Node* node = find(key, true);
  if (!node) return {};
  if (node->kind == Node::Kind::map) return {section(key)};
  std::vector<ConfigReader> readers = sections(key);
  if (node->kind == Node::Kind::list && node->items.empty())
    add_fault(*node, path_of(key), "expected at least one map");
  return readers;
}

void ConfigReader::accept_sources() { document_->accepts_sources = true; }

std::vector<std::pair<std::string, std::string>> ConfigReader::sources() const {
  std::vector<std::pair<std::string, std::string>> out;
  Document::collect_sources(*node_, "unstated", out);
  return out;
}

void ConfigReader::fault(const std::string& key, const std::string& reason) {
  const Node* node = find(key, false);
  add_fault(node ? *node : *node_, path_of(key), reason);
}

void ConfigReader::finish() {
  document_->collect_unknown(*document_->root);
  if (!document_->faults.empty()) document_->raise();
}

Value ConfigReader::resolved() const { return Value(Document::resolve(*node_)); }

Value ConfigReader::content() const { return Document::content(*node_); }

}  // namespace tacipc
