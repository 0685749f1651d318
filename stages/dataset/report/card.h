// Shows one sample on the page: pictures, press curve, numbers, files.
#pragma once

#include <filesystem>
#include <string>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Id of a card, to which the page's table links: "sample-1" for index 0.
std::string card_id(std::size_t index);

/// "passed" or "FAILED", coloured.
std::string verdict_badge(const SampleReport& sample);

/// Time at which a browser fetches pictures. On a page of many samples, distant pictures load only when they come into
/// sight.
enum class Loading { at_once, in_sight };

/// Body of a sample: failure, pictures, curves, numbers, checks and files. `folder` is the page's final folder.
std::string sample_body(const SampleReport& sample, const std::filesystem::path& folder, Loading loading);

/// Body of a sample under its name, as one of many on a page.
std::string sample_card(const SampleReport& sample, std::size_t index, const std::filesystem::path& folder);

}  // namespace tacipc
