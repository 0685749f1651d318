#include "common/base/value.h"

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

namespace tacipc {
namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  std::string text = fmt::format("{}", value);
  // A mantissa with a point keeps YAML 1.1 readers from reading 1e-05 as a string.
  if (const auto e = text.find('e'); e != std::string::npos && text.find('.') == std::string::npos)
    text.insert(e, ".0");
  return text;
}

struct Emit {
  YAML::Emitter& out;

  void operator()(bool value) const { out << value; }
  void operator()(std::int64_t value) const { out << value; }
  void operator()(double value) const { out << number_text(value); }
  void operator()(const std::string& value) const {
    // yaml-cpp would write it plain, and read it back as a line end.
    if (value.find('\r') != std::string::npos) out << YAML::DoubleQuoted;
    out << value;
  }
  void operator()(const Value::List& list) const {
    bool scalars = true;
    for (const Value& item : list) scalars = scalars && item.data().index() < 4;
    if (scalars) out << YAML::Flow;
    out << YAML::BeginSeq;
    for (const Value& item : list) std::visit(*this, item.data());
    out << YAML::EndSeq;
  }
  void operator()(const Value::Map& map) const {
    out << YAML::BeginMap;
    for (const auto& [key, item] : map) {
      out << YAML::Key;
      (*this)(key);
      out << YAML::Value;
      std::visit(*this, item.data());
    }
    out << YAML::EndMap;
  }
};

}  // namespace

void Value::set(const std::string& key, Value value) {
  for (auto& [name, item] : map()) {
    if (name == key) {
      item = std::move(value);
      return;
    }
  }
  map().emplace_back(key, std::move(value));
}

std::string to_yaml(const Value& value) {
  YAML::Emitter out;
  std::visit(Emit{out}, value.data());
  return std::string(out.c_str()) + "\n";
}

}  // namespace tacipc
