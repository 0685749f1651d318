// One sample on the page: pictures, press curve, numbers, files.
#pragma once

#include <filesystem>
#include <string>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Where the page's table finds the card: "sample-1" for index 0.
std::string card_id(std::size_t index);

/// "passed" or "FAILED", coloured.
std::string verdict_badge(const SampleReport& sample);

/// When a browser fetches pictures: those far down a page of many samples only when they come into sight.
enum class Loading { at_once, in_sight };

/// What went wrong, pictures, curves, numbers, checks and files; `folder` is where the page will lie.
std::string sample_body(const SampleReport& sample, const std::filesystem::path& folder, Loading loading);

/// The same under the sample's name, as one of many on a page.
std::string sample_card(const SampleReport& sample, std::size_t index, const std::filesystem::path& folder);

}  // namespace tacipc
