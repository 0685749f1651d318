// Writes a shard as WebDataset archives or as folders of plain files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "stages/dataset/repack/episodes.h"
#include "stages/dataset/repack/frame_files.h"
#include "stages/dataset/repack/tar_writer.h"

namespace tacipc {

/// Archives of a shard. `<shard>-<kind>.tar` holds the frames of samples of a kind, `<id>/frame_NNNN.<name>`, and
/// `samples/<shard>.tar` the files of whole samples, `<id>.<name>`. Readers take names up to the first dot as one
/// sample, so ids have "_" for dots there.
class FrameArchives {
 public:
  FrameArchives(const std::string& shard, const OutputPath& output);

  /// Adds a sample.
  /// \return number of files
  /// \throw DataError if its frames differ in form from earlier ones of its kind
  std::size_t add(const SampleFiles& sample);
  void close();

 private:
  struct Archive {
    TarWriter tar;
    std::vector<std::string> form;
    std::string first;  // first sample of that form
  };
  Archive& archive_of(const SampleFiles& sample);

  std::string shard_;
  OutputPath output_;
  TarWriter samples_;
  std::map<std::string, Archive> frames_;    // archive of each kind
  std::map<std::string, std::string> keys_;  // samples by their names in archives
};

/// Writes `<id>/frame_NNNN.<name>`, and for the sample `<id>/<name>` and `<id>/sample.json`.
/// \return number of files
std::size_t write_folder(const SampleFiles& sample, const OutputPath& output);

}  // namespace tacipc
