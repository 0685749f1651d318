// Changes single values in the text of a configuration; layout and comments of the rest stay.
#pragma once

#include <string>
#include <string_view>

#include "common/base/value.h"

namespace tacipc {

/// Text of a configuration. Paths are as in key_path.h; values are YAML on one line (`0.5`, `[1, 2]`, `{kind: press}`).
/// Every change is read back by ConfigReader and compared with the intended content.
class ConfigText {
 public:
  /// \param name stands for the file in messages
  /// \throw ConfigError as ConfigReader
  ConfigText(std::string text, std::string name);

  /// Changes a value.
  /// \throw ConfigError if it does not exist
  void set(std::string_view path, const std::string& yaml);
  /// Adds a key, and the sections that lead to it.
  /// \throw ConfigError if it exists
  void add(std::string_view path, const std::string& yaml);
  /// Removes a key.
  /// \throw ConfigError if it does not exist
  void remove(std::string_view path);

  const std::string& text() const { return text_; }

 private:
  /// Accepts `text` if its content equals `wanted`.
  /// \throw ConfigError at the location of the change otherwise
  void accept(std::string text, const Value& wanted, std::size_t at, std::string_view path);
  /// Fails at an offset in the text.
  /// \throw ConfigError `FILE:LINE:COLUMN: path: reason`
  [[noreturn]] void refuse(std::size_t at, std::string_view path, std::string_view reason) const;

  std::string text_;
  std::string name_;
  Value content_;
};

}  // namespace tacipc
