// The pages of a dataset: which files they are, how they are framed and how one gets from one to the next.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sample/dataset_plan.h"

namespace tacipc {

/// Names of the pages, as seen from the folder of the first.
std::string list_page_name(std::size_t page);   // "list-001.html" for page 0
std::string sheet_page_name(std::size_t page);  // "sheet-001.html"
std::string sample_page_name(const std::string& id);
std::string picture_name(const std::string& id, const std::string& picture);

/// How a page in a folder below the first page's names it, or one beside: "" or "../".
struct SitePage {
  std::string dataset;   // its name
  std::string heading;   // of this page
  std::string up;        // "" or "../"
  std::string main;      // HTML
  std::string nav = "";  // of this page, under the site's
};

/// Links that all pages have, the page's own navigation, a link that skips both.
std::string site_page(const SitePage& page);

/// A link to the page before and after this one, as far as there are any; also by access keys p and n.
struct Neighbour {
  std::string link;
  std::string words;
};
std::string neighbours(const std::optional<Neighbour>& before, const std::optional<Neighbour>& after);

/// Of many numbered pages: to the first, those near `page`, and the last. \pre page < pages
std::string pager(std::size_t page, std::size_t pages, std::string (*name)(std::size_t));

/// A sample that has a page of its own, and what contact sheets and lists show of it.
struct SampleShot {
  PlannedRow plan;
  bool passed = true;
  std::optional<std::pair<int, int>> thumb_px = std::nullopt;  // width and height of pictures/<id>/thumb.jpg
};

/// The pictures of these samples as links to their pages.
std::string shots_list(const std::vector<SampleShot>& shots, std::size_t first, std::size_t count);

/// The style sheet of all pages, as a file of its own.
std::string site_style();

/// A table that is wider than a phone scrolls by itself, with the keyboard too. `label` says what it is.
std::string scroll_start(const std::string& label);

}  // namespace tacipc
