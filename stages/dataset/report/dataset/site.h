// Pages of a dataset: file names, common frame, and navigation.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sample/dataset_plan.h"

namespace tacipc {

/// Names of the pages, relative to the folder of the first page.
std::string list_page_name(std::size_t page);   // "list-001.html" for page 0
std::string sheet_page_name(std::size_t page);  // "sheet-001.html"
std::string sample_page_name(const std::string& id);
std::string picture_name(const std::string& id, const std::string& picture);

/// Content of one page.
struct SitePage {
  std::string dataset;   // name of the dataset
  std::string heading;   // heading of this page
  std::string up;        // path to the first page's folder: "" or "../"
  std::string main;      // HTML
  std::string nav = "";  // navigation of this page, below that of the site
};

/// Complete page, with the links that all pages have, the page's own navigation, and a link that skips both.
std::string site_page(const SitePage& page);

/// Link to the previous or next page, if there is one; also by the access keys p and n.
struct Neighbour {
  std::string link;
  std::string words;
};
std::string neighbours(const std::optional<Neighbour>& before, const std::optional<Neighbour>& after);

/// Links to numbered pages: the first, those near `page`, and the last.
/// \pre page < pages
std::string pager(std::size_t page, std::size_t pages, std::string (*name)(std::size_t));

/// Sample with a page of its own, and its entry on contact sheets and lists.
struct SampleShot {
  PlannedRow plan;
  bool passed = true;
  std::optional<std::pair<int, int>> thumb_px = std::nullopt;  // width and height of pictures/<id>/thumb.jpg
};

/// Pictures of these samples as links to their pages.
std::string shots_list(const std::vector<SampleShot>& shots, std::size_t first, std::size_t count);

/// Style sheet of all pages, as a separate file.
std::string site_style();

/// Start of a block in which a wide table scrolls by itself, also by keyboard. `label` describes it.
std::string scroll_start(const std::string& label);

}  // namespace tacipc
