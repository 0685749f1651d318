// Animation on a page: frames of a motion stacked in one JPEG, which the page shows in turn.
#pragma once

#include <string>
#include <vector>

#include "common/sample/film.h"

namespace tacipc {

/// Frames of an animation, and how to show them.
struct FilmStrip {
  ByteImage sheet;  // equal frames, stacked from the first on
  int frames = 0;
  std::vector<std::string> columns;  // columns as in Film
  FilmTimes times;                   // times of all frames, also of those that are not shown
};

/// True if a folder has images of all frames of a press; with fewer the animation is omitted.
bool has_all_frames(const std::filesystem::path& render, std::size_t frames);

/// Strip of at most forty frames, evenly spread, of at most 720 x 480 pixels.
/// \throw DataError as Film and film_times
FilmStrip film_strip(const std::vector<FilmedGel>& gels, const std::vector<double>& times_s);

/// Animation as HTML. `file` is the source of the JPEG, relative to the page.
std::string film_figure(const FilmStrip& strip, const std::string& file);

}  // namespace tacipc
