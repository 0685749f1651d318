// State of a sample of a planned dataset.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tacipc {

enum class SampleStatus { made, failed, running, unmade };
const char* status_word(SampleStatus status);

/// Whether a sample is one finger of a grasp: its folder, `left` or `right`, lies in that of the grasp, whose press is
/// the press of both.
bool is_finger(const std::filesystem::path& sample_folder);
/// Where a stage of a sample runs, with its lock, log and times, and the reason if it failed.
std::filesystem::path stage_folder(const std::filesystem::path& sample_folder, const std::string& stage);
/// Such a file, of this ending: .log, .timings.yaml, .failed.yaml.
std::filesystem::path stage_file(const std::filesystem::path& sample_folder, const std::string& stage,
                                 const std::string& ending);
/// Times of a stage of a sample; those of a grasp's press are its left finger's. Nothing where there are none.
std::optional<std::filesystem::path> timings_file(const std::filesystem::path& sample_folder, const std::string& stage);

/// State of a sample, from which files are there and whether a make holds its lock; reads nothing.
SampleStatus status_of(const std::filesystem::path& sample_folder);

/// Whether `drop` removed what a stage wrote into its folder but the record, times and log.
bool was_dropped(const std::filesystem::path& stage_folder);

}  // namespace tacipc
