// A configuration of which single values are changed in its text, so that layout and comments of the rest stay.
#pragma once

#include <string>
#include <string_view>

#include "common/base/value.h"

namespace tacipc {

/// Paths are those of key_path.h, values are YAML on one line (`0.5`, `[1, 2]`, `{kind: press}`). Every change is read
/// back by ConfigReader and compared with what was asked for.
class ConfigText {
 public:
  /// `name` stands for the file in messages. \throw ConfigError as ConfigReader
  ConfigText(std::string text, std::string name);

  /// Changes a value. \throw ConfigError if it is not there
  void set(std::string_view path, const std::string& yaml);
  /// Adds a key, and the sections that lead to it. \throw ConfigError if it is there
  void add(std::string_view path, const std::string& yaml);
  /// Takes a key out. \throw ConfigError if it is not there
  void remove(std::string_view path);

  const std::string& text() const { return text_; }

 private:
  /// Takes `text` if it says what `wanted` does. \throw ConfigError at the place of the change
  void accept(std::string text, const Value& wanted, std::size_t at, std::string_view path);
  /// \throw ConfigError `FILE:LINE:COLUMN: path: reason` with the place of an offset
  [[noreturn]] void refuse(std::size_t at, std::string_view path, std::string_view reason) const;

  std::string text_;
  std::string name_;
  Value content_;
};

}  // namespace tacipc
