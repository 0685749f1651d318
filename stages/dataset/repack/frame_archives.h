// A shard as WebDataset archives or as folders of plain files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "stages/dataset/repack/episodes.h"
#include "stages/dataset/repack/frame_files.h"
#include "stages/dataset/repack/tar_writer.h"

namespace tacipc {

/// `<shard>-<kind>.tar` with the frames of samples of a kind, `<id>/frame_NNNN.<name>`, and `samples/<shard>.tar` with
/// what belongs to whole samples, `<id>.<name>`. Readers take names up to the first dot as one sample, so ids have "_"
/// for dots there.
class FrameArchives {
 public:
  FrameArchives(const std::string& shard, const OutputPath& output);

  /// \return how many files \throw DataError if its frames are not like those of its kind so far
  std::size_t add(const SampleFiles& sample);
  void close();

 private:
  struct Archive {
    TarWriter tar;
    std::vector<std::string> form;
    std::string first;  // the sample with that form
  };
  Archive& archive_of(const SampleFiles& sample);

  std::string shard_;
  OutputPath output_;
  TarWriter samples_;
  std::map<std::string, Archive> frames_;    // by kind
  std::map<std::string, std::string> keys_;  // samples by their names in archives
};

/// `<id>/frame_NNNN.<name>` and, of the sample, `<id>/<name>` and `<id>/sample.json`; \return how many files.
std::size_t write_folder(const SampleFiles& sample, const OutputPath& output);

}  // namespace tacipc
