// State of a sample of a planned dataset, as its files show it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tacipc {

/// State of a sample: finished, failed, in progress, or not started.
enum class SampleStatus { made, failed, running, unmade };
/// Returns the word for a state.
const char* status_word(SampleStatus status);

/// Returns whether a sample is one finger of a grasp: its folder, `left` or `right`, lies in the grasp's folder, whose
/// press run both fingers share.
bool is_finger(const std::filesystem::path& sample_folder);
/// Returns the folder in which a stage of a sample runs, with its lock, log and times, and the reason if it failed.
std::filesystem::path stage_folder(const std::filesystem::path& sample_folder, const std::string& stage);
/// Returns the path of the stage's file with an ending: .log, .timings.yaml, .failed.yaml.
std::filesystem::path stage_file(const std::filesystem::path& sample_folder, const std::string& stage,
                                 const std::string& ending);
/// Returns the file with the times of a stage of a sample, or nothing if it does not exist. The press times of a grasp
/// belong to its left finger.
std::optional<std::filesystem::path> timings_file(const std::filesystem::path& sample_folder, const std::string& stage);

/// Returns the state of a sample from the existence of files and a held lock, without reading any file.
SampleStatus status_of(const std::filesystem::path& sample_folder);

/// Returns whether `drop` removed a stage's files except the record, times and log.
bool was_dropped(const std::filesystem::path& stage_folder);

}  // namespace tacipc
