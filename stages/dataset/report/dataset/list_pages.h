// Writes the list of all samples, over as many pages as needed, and the contact sheets.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "stages/dataset/report/dataset/sample_row.h"
#include "stages/dataset/report/dataset/site.h"

namespace tacipc {

/// Takes rows one by one and writes a page as soon as it is full, so that only one page is in memory.
class ListPages {
 public:
  using Write = std::function<void(const std::string& name, const std::string& html)>;
  /// \param samples number of rows to come
  /// \param with_page samples that are linked
  ListPages(std::string dataset, std::size_t samples, std::size_t rows_per_page, std::set<std::string> with_page,
            Write write);
  void add(const SampleRow& row);
  /// Writes the last page.
  /// \pre all rows were added
  void finish();

 private:
  void flush();

  std::string dataset_;
  std::size_t samples_, rows_per_page_;
  std::set<std::string> with_page_;
  Write write_;
  std::size_t page_ = 0, rows_ = 0;
  std::string table_;
};

/// Number of pages for `per_page` items each; at least one.
std::size_t pages_of(std::size_t items, std::size_t per_page);

/// Page with one contact sheet.
std::string sheet_page(const std::string& dataset, const std::vector<SampleShot>& shots, std::size_t page,
                       std::size_t per_page);

}  // namespace tacipc
