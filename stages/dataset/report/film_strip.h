// A moving picture on a page: all frames of a motion one above the other in one JPEG, which the page shows in turn.
#pragma once

#include <string>
#include <vector>

#include "common/sample/film.h"

namespace tacipc {

struct FilmStrip {
  ByteImage sheet;  // equal frames one above the other, from the first on
  int frames = 0;
  std::vector<std::string> columns;  // of Film
  FilmTimes times;                   // of all frames, not only of those that are shown
};

/// Whether a folder has images of all frames of a press: of fewer nothing would move.
bool has_all_frames(const std::filesystem::path& render, std::size_t frames);

/// At most forty frames, evenly spread, of at most 720 x 480 pixels. \throw DataError as Film and film_times
FilmStrip film_strip(const std::vector<FilmedGel>& gels, const std::vector<double>& times_s);

/// HTML. `file`: source of the JPEG, as the page names it
std::string film_figure(const FilmStrip& strip, const std::string& file);

}  // namespace tacipc
