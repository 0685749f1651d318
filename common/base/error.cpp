#include "common/base/error.h"

#include <fmt/ranges.h>

namespace tacipc {

ConfigError::ConfigError(std::vector<std::string> faults)
    : std::runtime_error(fmt::format("{}", fmt::join(faults, "\n"))), faults_(std::move(faults)) {}

}  // namespace tacipc
