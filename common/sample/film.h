// Combines the images of all gels, frame by frame, into pictures of a video.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/sample/render_folder.h"

namespace tacipc {

/// Folders of one gel: its press run and its images.
struct FilmedGel {
  std::filesystem::path press, render;
};

/// Pictures of a motion. Each gel has a row: its tactile image, that image with printed markers, and its indentation in
/// colours from 0 to the maximum over all gels and frames. A column is left out if the first frame of one gel lacks its
/// image (no printed markers, or a map that a dataset leaves out).
class Film {
 public:
  /// Width and height, pixels.
  struct Size {
    int width = 0, height = 0;
  };
  /// Shrinks the pictures by a whole factor, by averaging, until they fit into `most`. Width and height are even.
  /// \throw DataError if a render did not finish, belongs to another press run, or lacks frames
  Film(std::vector<FilmedGel> gels, std::size_t frames, Size most);

  /// Returns the number of frames.
  std::size_t frames() const { return frames_; }
  /// Returns the size of a picture, pixels.
  Size size() const { return size_; }
  /// Returns the factor by which pictures are shrunk.
  int shrunk_by() const { return shrink_; }
  /// Returns the names of the columns: "tactile", …
  std::vector<std::string> columns() const;
  /// Returns a picture, RGB.
  /// \throw DataError if an image is missing, damaged, or of another size than in the first frame
  ByteImage picture(std::size_t frame) const;

 private:
  ByteImage panel(const FilmedGel& gel, FrameFile file, std::size_t frame) const;
  void find_columns();
  void find_sizes(Size most);
  void find_deepest();

  std::vector<FilmedGel> gels_;
  std::size_t frames_;
  std::vector<FrameFile> files_;  // images of the columns
  std::vector<Size> cells_;       // size of each gel's images
  Size size_;
  int shrink_ = 1;
  double deepest_m_ = 1e-6;
};

/// Durations for which frames are shown.
struct FilmTimes {
  std::vector<double> seconds;  // duration of each frame
  double slower = 1.0;          // playback time over motion time; 0 if the motion's times are not known
};

/// Computes durations in proportion to the time until the next frame; the last frame takes as long as the one before.
/// Without times, each frame takes 0.1 s.
/// \param slower playback time over motion time; 0: the smallest of 1, 2, 5, 10, 20, 50, … that shows the median frame
/// for at least 0.08 s
/// \throw DataError if a frame is not later than the one before
FilmTimes film_times(const std::vector<double>& times_s, std::size_t frames, double slower);

/// Returns a description: "10 times slower than the motion", "at the motion's own pace", "0.1 s a frame".
std::string pace_text(const FilmTimes& times);

}  // namespace tacipc
