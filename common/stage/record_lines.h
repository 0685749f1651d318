// Maps a struct to lines of a record: writes them, and reads them back key by key.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/base/value.h"
#include "common/stage/record.h"

namespace tacipc {

/// A key of a record and the member of `Lines` that holds its value.
template <typename Lines, typename T>
struct Key {
  constexpr Key(const char* key, T Lines::*value) : name(key), member(value) {}
  const char* name;
  T Lines::*member;
};

/// Makes the key that has the name of a member of the struct `Lines`.
#define RECORD_KEY(member) Key(#member, &Lines::member)

/// A struct with a static keys(): a tuple of Key, one per member, in the order of the record.
template <typename T>
concept HasRecordKeys = requires {
  T::keys();
};

template <typename T>
struct WithoutOptional {
  using Type = T;
};
template <typename T>
struct WithoutOptional<std::optional<T>> {
  using Type = T;
};

/// Returns the key of a member.
template <typename Lines, typename T>
const char* key_of(T Lines::*member) {
  const char* name = nullptr;
  const auto compare = [&](const auto& key) {
    if constexpr (std::is_same_v<decltype(key.member), T Lines::*>) {
      if (key.member == member) name = key.name;
    }
  };
  std::apply([&](const auto&... keys) { (compare(keys), ...); }, Lines::keys());
  assert(name);
  return name;
}

/// Returns the lines as they are written. Optional members without a value are left out.
template <HasRecordKeys Lines>
Value::Map record_lines(const Lines& lines);

/// Converts a value, a struct with keys, or a list to a Value.
template <typename T>
Value record_value(const T& value) {
  if constexpr (HasRecordKeys<T>) {
    return record_lines(value);
  } else if constexpr (std::is_convertible_v<T, Value>) {
    return value;
  } else {
    Value::List list;
    for (const auto& item : value) list.push_back(record_value(item));
    return list;
  }
}

template <HasRecordKeys Lines>
Value::Map record_lines(const Lines& lines) {
  Value::Map map;
  const auto add = [&](const auto& key) {
    const auto& value = lines.*key.member;
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<T, typename WithoutOptional<T>::Type>) {
      map.emplace_back(key.name, record_value(value));
    } else {
      if (value) map.emplace_back(key.name, record_value(*value));
    }
  };
  std::apply([&](const auto&... keys) { (add(keys), ...); }, Lines::keys());
  return map;
}

/// A map of a record whose keys are those of `Lines`. Values are looked up one by one, because records of earlier
/// versions may lack some.
template <HasRecordKeys Lines>
class RecordLines {
  template <typename T>
  using Plain = typename WithoutOptional<T>::Type;
  /// Type in which a value is read: int for whole numbers.
  template <typename T>
  using Held = std::conditional_t<std::is_integral_v<Plain<T>> && !std::is_same_v<Plain<T>, bool>, int, Plain<T>>;

 public:
  explicit RecordLines(Record record) : record_(std::move(record)) {}

  /// Returns whether the key exists.
  const Record& record() const { return record_; }
  template <typename T>
  bool has(T Lines::*member) const {
    return record_.has(key_of(member));
  }
  /// Returns a value; nothing if the key is absent.
  /// \throw DataError naming file and key if the value has another type
  template <typename T>
  std::optional<Held<T>> find(T Lines::*member) const {
    const char* key = key_of(member);
    if constexpr (std::is_same_v<Held<T>, bool>) {
      return record_.flag(key);
    } else if constexpr (std::is_same_v<Held<T>, std::string>) {
      return record_.text(key);
    } else if constexpr (std::is_floating_point_v<Held<T>>) {
      return record_.number(key);
    } else if constexpr (std::is_same_v<Held<T>, int>) {
      return record_.count(key);
    } else {
      const auto numbers = record_.numbers(key, Held<T>::SizeAtCompileTime);
      if (!numbers) return std::nullopt;
      return Held<T>(numbers->data());
    }
  }
  /// Returns a value that must be present.
  /// \throw DataError naming file and key if it is absent or has another type
  template <typename T>
  Held<T> required(T Lines::*member) const {
    auto value = find(member);
    if (!value) record_.required_text(key_of(member));  // throws
    return *value;
  }
  /// Returns all lines; optional ones may be absent.
  /// \pre no member is a map or a list of maps
  /// \throw DataError as required()
  Lines all() const {
    Lines lines;
    const auto read = [&](const auto& key) {
      using T = std::remove_cvref_t<decltype(lines.*key.member)>;
      if constexpr (std::is_same_v<T, Plain<T>>)
        lines.*key.member = static_cast<T>(required(key.member));
      else if (const auto value = find(key.member))
        lines.*key.member = static_cast<Plain<T>>(*value);
    };
    std::apply([&](const auto&... keys) { (read(keys), ...); }, Lines::keys());
    return lines;
  }
  /// Returns a number of any type, including negative whole numbers.
  /// \throw DataError as required()
  template <typename T>
  double number(T Lines::*member) const {
    return record_.required_number(key_of(member));
  }
  /// Returns the map at a key.
  template <typename T>
  RecordLines<Held<T>> section(T Lines::*member) const {
    return RecordLines<Held<T>>(record_.section(key_of(member)));
  }
  /// Returns the maps of a list.
  template <typename T>
  std::vector<RecordLines<T>> sections(std::vector<T> Lines::*member) const {
    std::vector<RecordLines<T>> lines;
    for (Record& item : record_.sections(key_of(member))) lines.emplace_back(std::move(item));
    return lines;
  }

 private:
  Record record_;
};

/// Returns the summary of a stage's record.
template <HasRecordKeys Summary>
RecordLines<Summary> summary_of(const Record& record) {
  return RecordLines<Summary>(record.section("summary"));
}

}  // namespace tacipc
