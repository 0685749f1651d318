#include "common/base/json.h"

#include <fmt/core.h>

#include <cmath>

namespace tacipc {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  out += '"';
  return out;
}

/// Returns a number with a point or an exponent, so that readers that distinguish whole numbers from others use one
/// type.
std::string real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// Returns whether a list fits on a line: it contains no map at any depth.
bool holds_no_map(const Value& value) {
  if (std::holds_alternative<Value::Map>(value.data())) return false;
  if (const auto* list = std::get_if<Value::List>(&value.data())) {
    for (const Value& item : *list)
      if (!holds_no_map(item)) return false;
  }
  return true;
}

struct Write {
  std::string& out;
  int depth = 0;

  void operator()(bool value) const { out += value ? "true" : "false"; }
  void operator()(std::int64_t value) const { out += fmt::format("{}", value); }
  void operator()(double value) const { out += std::isfinite(value) ? real(value) : "null"; }
  void operator()(const std::string& value) const { out += quoted(value); }
  void operator()(const Value::List& list) const {
    const bool flat = holds_no_map(Value(list));
    items('[', ']', list.size(), flat, [&](std::size_t i, const Write& inner) { std::visit(inner, list[i].data()); });
  }
  void operator()(const Value::Map& map) const {
    items('{', '}', map.size(), false, [&](std::size_t i, const Write& inner) {
      out += quoted(map[i].first);
      out += ": ";
      std::visit(inner, map[i].second.data());
    });
  }

 private:
  void new_line(int blanks) const {
    out += '\n';
    out.append(static_cast<std::size_t>(2 * blanks), ' ');
  }
  template <typename Item>
  void items(char open, char close, std::size_t count, bool flat, Item&& item) const {
    out += open;
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) out += flat ? ", " : ",";
      if (!flat) new_line(depth + 1);
      item(i, Write{out, depth + 1});
    }
    if (!flat && count > 0) new_line(depth);
    out += close;
  }
};

}  // namespace

std::string to_json(const Value& value) {
  std::string out;
  std::visit(Write{out}, value.data());
  out += '\n';
  return out;
}

}  // namespace tacipc
