// Configurations written out in a test: what is read from them, and what a reader finds wrong.
#pragma once

#include <string>
#include <vector>

#include "common/base/error.h"
#include "common/config/config.h"

namespace tacipc {

/// The configuration that is all of a text; `name` stands for its file. \throw ConfigError
template <typename Config>
Config config_from_text(const std::string& text, const std::string& name) {
  ConfigReader in = ConfigReader::from_text(text, name);
  Config config = Config::read(in);
  in.finish();
  return config;
}

/// Faults of the ConfigError that `action` throws; empty if it throws none.
template <typename Action>
std::vector<std::string> faults_of(Action&& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.faults();
  }
  return {};
}

/// Faults of a text as a configuration.
template <typename Config>
std::vector<std::string> faults_in(const std::string& text, const std::string& name) {
  return faults_of([&] { config_from_text<Config>(text, name); });
}

}  // namespace tacipc
