#include "common/config/config_text.h"

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <span>
#include <vector>

#include "common/base/error.h"
#include "common/base/printable.h"
#include "common/config/config.h"
#include "common/config/key_path.h"

namespace tacipc {
namespace {

/// Returns the whole content of a text.
/// \throw ConfigError if it is not valid
Value content_of(const std::string& text, const std::string& name) {
  ConfigReader in = ConfigReader::from_text(text, name);
  for (const std::string& key : in.keys()) in.ignore(key);  // any key may occur, but only once
  in.finish();
  return in.content();
}

bool equal(const Value& a, const Value& b) { return to_yaml(a) == to_yaml(b); }

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

struct Span {
  std::size_t begin;
  std::size_t end;
};

/// Finds ends of YAML words. Scans only text that was parsed before, so that brackets and quotes are known to close.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  std::size_t end_of_line(std::size_t at) const { return std::min(text_.find('\n', at), text_.size()); }
  std::size_t start_of_line(std::size_t at) const {
    const std::size_t before = at == 0 ? std::string::npos : text_.rfind('\n', at - 1);
    return before == std::string::npos ? 0 : before + 1;
  }
  std::size_t column(std::size_t at) const { return at - start_of_line(at); }
  std::size_t after_blanks(std::size_t at) const {
    while (at < text_.size() && is_blank(text_[at])) ++at;
    return at;
  }
  /// Returns whether `at` is at the end of a line, or at a comment.
  bool nothing_more(std::size_t at) const { return at >= text_.size() || text_[at] == '\n' || text_[at] == '#'; }

  std::size_t after_space(std::size_t at) const {
    while (true) {
      at = after_blanks(at);
      if (at >= text_.size() || !nothing_more(at)) return at;
      at = std::min(end_of_line(at) + 1, text_.size());
    }
  }

  std::size_t after_quoted(std::size_t at) const {
    const char quote = text_[at];
    for (++at; at < text_.size(); ++at) {
      if (quote == '"' && text_[at] == '\\') {
        ++at;
      } else if (text_[at] == quote) {
        if (quote == '"' || text_.compare(at, 2, "''") != 0) return at + 1;
        ++at;
      }
    }
    return at;
  }

  /// Returns the position after the bracket that closes the one at `at`.
  std::size_t after_brackets(std::size_t at) const {
    int depth = 0;
    bool word_begins = false;  // a quote inside a word is an ordinary character
    while (at < text_.size()) {
      const char c = text_[at];
      if (word_begins && (c == '"' || c == '\'')) {
        at = after_quoted(at);
        word_begins = false;
        continue;
      }
      if (c == '#' && (is_blank(text_[at - 1]) || text_[at - 1] == '\n')) {
        at = end_of_line(at);
        continue;
      }
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
      ++at;
      if (depth == 0) return at;
      if (!is_blank(c) && c != '\n') word_begins = c == '{' || c == '[' || c == ',' || c == ':';
    }
    return at;
  }

  /// Returns the position after a word without quotes, which may continue in the next line within brackets.
  std::size_t after_plain(std::size_t at, bool in_brackets) const {
    std::size_t end = at;
    for (; at < text_.size(); ++at) {
      const char c = text_[at];
      if (in_brackets ? c == ',' || c == '}' || c == ']' : c == '\n') break;
      if (c == '#' && at > 0 && (is_blank(text_[at - 1]) || text_[at - 1] == '\n')) break;
      if (!is_blank(c) && c != '\n') end = at + 1;
    }
    return end;
  }

  /// Returns the position after the lines, from the one at `at`, that are indented more than `column`; list items may
  /// be at it.
  std::size_t after_lines(std::size_t at, std::size_t column, bool list, bool comments_count) const {
    std::size_t end = at;
    for (at = end_of_line(at) + 1; at < text_.size(); at = end_of_line(at) + 1) {
      const std::size_t first = after_blanks(at);
      if (first >= text_.size() || text_[first] == '\n') continue;
      const bool deeper = first - at > column;
      if (text_[first] == '#' && !(comments_count && deeper)) continue;
      const bool item = list && first - at == column && text_[first] == '-';
      if (!deeper && !item) break;
      end = end_of_line(first);
    }
    while (end > 0 && text_[end - 1] == '\r') --end;
    return end;
  }

  /// Returns the range of the value that follows a colon or dash at `at`; empty if there is no value.
  /// \param column column of the key or dash
  Span value_after(std::size_t at, std::size_t column, const YAML::Node& value, bool in_brackets) const {
    if (value.IsNull() && nothing_more(after_blanks(at))) return {at, at};
    const std::size_t begin = after_space(at);
    if (begin == text_.size()) return {at, at};
    const char c = text_[begin];
    if (c == '"' || c == '\'') return {begin, after_quoted(begin)};
    if (c == '{' || c == '[') return {begin, after_brackets(begin)};
    if (in_brackets) {
      const std::size_t end = after_plain(begin, true);
      return end == begin ? Span{at, at} : Span{begin, end};
    }
    if (c == '|' || c == '>') return {begin, after_lines(end_of_line(begin), column, false, true)};
    const std::size_t first = value.IsScalar() ? after_plain(begin, false) : end_of_line(begin);
    const std::size_t next = after_blanks(first);
    if (next < text_.size() && text_[next] == '#') return {begin, first};  // a comment ends the word
    const std::size_t end = after_lines(first, column, value.IsSequence(), false);
    return {begin, std::max(first, end)};
  }

 private:
  const std::string& text_;
};

/// A key and its value, or an item of a list, in the text.
struct Place {
  YAML::Node value;
  YAML::Node holder;      // map or list that holds it
  bool in_brackets;       // the holder is written with brackets, or inside some
  std::size_t key = 0;    // start of the key or item
  std::size_t after = 0;  // position after the colon or dash
  std::size_t column = 0;
  Span span{};  // range of the value
};

Place place_of(const std::string& text, const YAML::Node& root, const std::vector<KeyStep>& steps) {
  const Scanner scan(text);
  Place place{.value = root, .holder = YAML::Node(), .in_brackets = false};
  for (const KeyStep& step : steps) {
    const YAML::Node holder = place.value;
    place.in_brackets = place.in_brackets || holder.Style() == YAML::EmitterStyle::Flow;
    place.holder.reset(holder);
    if (const auto* index = std::get_if<std::size_t>(&step)) {
      place.value.reset(holder[*index]);
      place.key = static_cast<std::size_t>(place.value.Mark().pos);
      place.after = place.key;
      place.column = 0;
      if (!place.in_brackets) {
        const std::size_t dash = text.rfind('-', place.key - 1);
        place.after = dash + 1;
        place.column = scan.column(dash);
      }
    } else {
      for (const auto& entry : holder) {
        if (entry.first.Scalar() != std::get<std::string>(step)) continue;
        place.key = static_cast<std::size_t>(entry.first.Mark().pos);
        place.value.reset(entry.second);
        break;
      }
      const std::string& key = std::get<std::string>(step);
      const bool quoted = text[place.key] == '"' || text[place.key] == '\'';
      const std::size_t colon =
          scan.after_blanks(quoted ? scan.after_quoted(place.key) : std::min(place.key + key.size(), text.size()));
      // For a key in another notation (`? key`) this position is wrong; reading back the text detects that.
      place.after = colon < text.size() ? colon + 1 : place.key;
      place.column = scan.column(place.key);
    }
    place.span = scan.value_after(place.after, place.column, place.value, place.in_brackets);
  }
  return place;
}

/// Returns the value at the end of the steps in a copy of the content.
Value& at_steps(Value& root, std::span<const KeyStep> steps) {
  Value* at = &root;
  for (const KeyStep& step : steps) {
    if (const auto* index = std::get_if<std::size_t>(&step)) {
      at = &std::get<Value::List>(at->data())[*index];
    } else {
      auto& map = at->map();
      at = &std::ranges::find_if(map, [&](const auto& e) { return e.first == std::get<std::string>(step); })->second;
    }
  }
  return *at;
}

/// Parses a value on one line.
/// \throw UsageError if it is not valid
Value value_of(const std::string& yaml, std::string_view path) {
  const std::string what = fmt::format("'{}'", yaml);
  if (yaml.find('\n') != std::string::npos || yaml.find_first_not_of(" \t") == std::string::npos)
    throw UsageError(fmt::format("{}: a value stands on one line and is not empty", path));
  try {
    return content_of(fmt::format("value: {}", yaml), what).map().front().second;
  } catch (const ConfigError&) {
    throw UsageError(fmt::format("{}: {} is not a value in YAML", path, what));
  }
}

std::vector<std::string> keys_of(std::string_view path) {
  std::vector<std::string> keys;
  while (true) {
    const std::size_t point = path.find('.');
    keys.emplace_back(path.substr(0, point));
    if (point == std::string_view::npos) return keys;
    path.remove_prefix(point + 1);
  }
}

}  // namespace

ConfigText::ConfigText(std::string text, std::string name)
    : text_(std::move(text)), name_(std::move(name)), content_(content_of(text_, name_)) {}

void ConfigText::refuse(std::size_t at, std::string_view path, std::string_view reason) const {
  at = std::min(at, text_.size());
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  throw ConfigError(
      {fmt::format("{}:{}:{}: {}: {}", name_, line, Scanner(text_).column(at) + 1, excerpt(path, 200), reason)});
}

void ConfigText::accept(std::string text, const Value& wanted, std::size_t at, std::string_view path) {
  try {
    Value content = content_of(text, name_);
    if (equal(content, wanted)) {
      text_ = std::move(text);
      content_ = std::move(content);
      return;
    }
  } catch (const ConfigError&) {
    // The text is not even readable any more.
  }
  refuse(at, path, "cannot be changed the way it is written here");
}

void ConfigText::set(std::string_view path, const std::string& yaml) {
  const Value value = value_of(yaml, path);
  const KeyPath found = follow(content_, path);
  const Place place = place_of(text_, YAML::Load(text_), found.steps);
  if (!found.rest.empty())
    refuse(place.key, path, "there is no such key" + suggestion(*found.at, first_key(found.rest)));
  const Scanner scan(text_);
  const auto [begin, end] = place.span;
  std::string text = text_;
  if (begin == end || scan.end_of_line(place.after) < begin) {
    // The value goes after the colon; lines below are removed, a comment after the colon stays.
    const std::size_t line_end = begin == end ? end : scan.end_of_line(place.after);
    text.erase(line_end, end - line_end).insert(place.after, fmt::format(" {}", yaml));
  } else {
    text.replace(begin, end - begin, yaml);
  }
  Value wanted = content_;
  at_steps(wanted, found.steps) = value;
  accept(std::move(text), wanted, place.key, path);
}

void ConfigText::add(std::string_view path, const std::string& yaml) {
  Value value = value_of(yaml, path);
  KeyPath found = follow(content_, path);
  const YAML::Node root = YAML::Load(text_);
  const Place place = place_of(text_, root, found.steps);
  if (found.rest.empty()) refuse(place.key, path, "exists already");
  if (!place.value.IsMap() && !place.value.IsNull()) refuse(place.key, path, to_text(found.steps) + " has no keys");

  const Scanner scan(text_);
  const std::vector<std::string> keys = keys_of(found.rest);
  const bool in_brackets = place.in_brackets || place.value.Style() == YAML::EmitterStyle::Flow;
  std::string text = text_, in_line = fmt::format("{}: {}", keys.back(), yaml);
  for (std::size_t i = keys.size() - 1; i-- > 0;) in_line = fmt::format("{}: {{{}}}", keys[i], in_line);
  const auto lines = [&](std::size_t column) {
    std::string result;
    for (const std::string& key : keys) {
      result += fmt::format("\n{:{}}{}:", "", column, key);
      column += 2;
    }
    return fmt::format("{} {}", result, yaml);
  };
  if (place.value.size() > 0) {
    std::vector<KeyStep> last = found.steps;
    last.emplace_back(found.at->map().back().first);
    const Place before = place_of(text_, root, last);
    if (in_brackets) {
      text.insert(before.span.end, fmt::format(", {}", in_line));
    } else {
      text.insert(scan.end_of_line(std::max(before.span.end, before.after)), lines(before.column));
    }
  } else if (place.value.IsMap()) {
    text.insert(static_cast<std::size_t>(place.value.Mark().pos) + 1, in_line);
  } else if (in_brackets) {
    text.insert(place.after, fmt::format(" {{{}}}", in_line));
  } else {
    text.insert(scan.end_of_line(place.after), lines(place.column + 2));
  }

  Value wanted = content_;
  for (std::size_t i = keys.size() - 1; i > 0; --i) value = Value(Value::Map{{keys[i], value}});
  Value& holder = at_steps(wanted, found.steps);
  if (place.value.IsNull()) holder = Value(Value::Map{});
  holder.set(keys.front(), value);
  accept(std::move(text), wanted, place.key, path);
}

void ConfigText::remove(std::string_view path) {
  const KeyPath found = follow(content_, path);
  const YAML::Node root = YAML::Load(text_);
  const Place place = place_of(text_, root, found.steps);
  if (!found.rest.empty())
    refuse(place.key, path, "there is no such key" + suggestion(*found.at, first_key(found.rest)));
  if (found.steps.empty()) refuse(place.key, path, "names no key");
  const auto* key = std::get_if<std::string>(&found.steps.back());
  if (!key) refuse(place.key, path, "is an item of a list; only keys can be taken out");

  const std::span<const KeyStep> to_holder = std::span(found.steps).first(found.steps.size() - 1);
  Value wanted = content_;
  Value::Map& map = at_steps(wanted, to_holder).map();
  const auto entry = std::ranges::find_if(map, [&](const auto& e) { return e.first == *key; });
  const auto place_beside = [&](const auto& beside) {
    std::vector<KeyStep> steps(to_holder.begin(), to_holder.end());
    steps.emplace_back(beside->first);
    return place_of(text_, root, steps);
  };
  const Scanner scan(text_);
  const std::size_t end = std::max(place.span.end, place.after), line = scan.start_of_line(place.key);
  std::string text = text_;
  if (map.size() == 1) {
    // A section without keys would no longer be a section.
    place.in_brackets ? text.erase(place.key, end - place.key) : text.replace(place.key, end - place.key, "{}");
  } else if (!place.in_brackets && scan.after_blanks(line) == place.key) {
    text.erase(line, scan.end_of_line(end) + 1 - line);
  } else if (entry + 1 != map.end()) {
    text.erase(place.key, place_beside(entry + 1).key - place.key);
  } else {
    const std::size_t before = place_beside(entry - 1).span.end;
    text.erase(before, end - before);
  }
  map.erase(entry);
  accept(std::move(text), wanted, place.key, path);
}

}  // namespace tacipc
