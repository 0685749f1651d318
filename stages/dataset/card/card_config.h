// Text of a dataset card.
#pragma once

#include <string>

#include "common/config/config.h"

namespace tacipc {

struct CardConfig {
  std::string purpose;
  std::string licence;
  std::string contact;  // empty: none
  std::string notes;    // empty: none; Markdown

  static CardConfig read(ConfigReader& in) {
    return {.purpose = in.text("purpose"),
            .licence = in.text("licence"),
            .contact = in.text_or("contact", ""),
            .notes = in.text_or("notes", "")};
  }
};

}  // namespace tacipc
