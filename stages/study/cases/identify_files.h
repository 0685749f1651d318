// Inputs of the stages for identifying a sensor's mechanics.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/benchmark/identify_spec.h"

namespace tacipc {

/// Files by name: `<measurement>/indenter.yaml`, `motion_<run>.yaml`, and `cases.mk` with what a makefile has to know.
/// \param folder that paths of settings are relative to
std::vector<std::pair<std::string, std::string>> identify_files(const IdentifySpec& spec, const std::string& folder);

}  // namespace tacipc
