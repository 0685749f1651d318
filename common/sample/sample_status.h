// State of a sample of a planned dataset.
#pragma once

#include <filesystem>

namespace tacipc {

enum class SampleStatus { made, failed, running, unmade };
const char* status_word(SampleStatus status);

/// State of a sample, from which files are there and whether a make holds its lock; reads nothing.
SampleStatus status_of(const std::filesystem::path& sample_folder);

/// Whether `drop` removed what a stage wrote into its folder but the record, times and log.
bool was_dropped(const std::filesystem::path& stage_folder);

}  // namespace tacipc
