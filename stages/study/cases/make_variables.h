// Writes the file cases.mk: variables for Make.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace tacipc {

/// Collects variables with a common prefix.
class MakeVariables {
 public:
  MakeVariables(std::string prefix, std::string folder) : prefix_(std::move(prefix)), folder_(std::move(folder)) {}

  void set(const std::string& name, const std::string& value) {
    text_ += fmt::format("{}_{} := {}\n", prefix_, name, value);
  }
  /// Sets the path of a configuration that is named relative to the benchmark's file.
  void set_path(const std::string& name, const std::string& path) {
    set(name, (folder_ / path).lexically_normal().generic_string());
  }
  const std::string& text() const { return text_; }

 private:
  std::string prefix_;
  std::filesystem::path folder_;
  std::string text_ = "# Made by the stage cases.\n";
};

}  // namespace tacipc
