// All frames of a motion as the gels saw it, side by side: for a video, and for the moving picture of a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/sample/render_folder.h"

namespace tacipc {

/// A gel's press folder and the folder of its images.
struct FilmedGel {
  std::filesystem::path press, render;
};

/// A row for each gel: its tactile image, the same with printed markers, its indentation in colours from 0 to the
/// deepest of all gels and frames. What the first frame of one gel lacks (markers that are not printed, a map that a
/// dataset leaves out) no row has.
class Film {
 public:
  struct Size {
    int width = 0, height = 0;
  };
  /// Pictures are shrunk by a whole factor, averaged, until they fit; width and height are even.
  /// \throw DataError if a render did not finish, is of another press, or has not all frames of it
  Film(std::vector<FilmedGel> gels, std::size_t frames, Size most);

  std::size_t frames() const { return frames_; }
  Size size() const { return size_; }
  int shrunk_by() const { return shrink_; }
  /// Names of the columns: "tactile", …
  std::vector<std::string> columns() const;
  /// RGB. \throw DataError if an image is missing, broken, or of another size than that of the first frame
  ByteImage picture(std::size_t frame) const;

 private:
  ByteImage panel(const FilmedGel& gel, FrameFile file, std::size_t frame) const;
  void find_columns();
  void find_sizes(Size most);
  void find_deepest();

  std::vector<FilmedGel> gels_;
  std::size_t frames_;
  std::vector<FrameFile> files_;  // of the columns
  std::vector<Size> cells_;       // of each gel's images
  Size size_;
  int shrink_ = 1;
  double deepest_m_ = 1e-6;
};

/// How long each frame is shown.
struct FilmTimes {
  std::vector<double> seconds;  // of each frame
  double slower = 1.0;          // than the motion; 0 where its times are not known
};

/// In proportion to the time until the next frame; the last one as long as the one before it. `slower`: than the
/// motion; 0: the least of 1, 2, 5, 10, 20, 50, … with which the median frame is seen for 0.08 s. Without times, 0.1 s
/// each. \throw DataError if a frame is not later than the one before
FilmTimes film_times(const std::vector<double>& times_s, std::size_t frames, double slower);

/// "10 times slower than the motion", "at the motion's own pace", "0.1 s a frame".
std::string pace_text(const FilmTimes& times);

}  // namespace tacipc
