// An ordered tree of plain values, for records, summaries and resolved configurations.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tacipc {

/// A scalar, a list or a map whose keys keep their order.
class Value {
 public:
  using List = std::vector<Value>;
  using Map = std::vector<std::pair<std::string, Value>>;

  Value() : data_(Map{}) {}
  Value(bool value) : data_(value) {}
  Value(int value) : data_(static_cast<std::int64_t>(value)) {}
  Value(std::int64_t value) : data_(value) {}
  Value(std::size_t value) : data_(static_cast<std::int64_t>(value)) {}
  Value(double value) : data_(value) {}
  Value(const char* value) : data_(std::string(value)) {}
  Value(std::string value) : data_(std::move(value)) {}
  Value(List value) : data_(std::move(value)) {}
  Value(Map value) : data_(std::move(value)) {}
  Value(const std::vector<double>& values) : data_(List(values.begin(), values.end())) {}

  /// Returns the map in this value.
  /// \pre the value is a map
  Map& map() { return std::get<Map>(data_); }
  const Map& map() const { return std::get<Map>(data_); }
  /// Sets or replaces a key of a map.
  void set(const std::string& key, Value value);

  const auto& data() const { return data_; }
  auto& data() { return data_; }

 private:
  std::variant<bool, std::int64_t, double, std::string, List, Map> data_;
};

/// Returns YAML text, one key per line, numbers in the shortest form that reads back to the same bits.
std::string to_yaml(const Value& value);

}  // namespace tacipc
