// The dataset card: everything a new user needs.
#pragma once

#include <string>

#include "common/config/config.h"
#include "common/stage/record.h"
#include "stages/dataset/card/dataset_tables.h"
#include "stages/dataset/card/shard_records.h"

namespace tacipc {

/// Words of a dataset card.
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

struct CardContent {
  std::string name;
  CardConfig config;
  const ShardRecords& shards;
  const DatasetCounts& counts;
  const Record& schema;  // of schema.json
  std::string loader;    // Python source
  std::string citation;  // CITATION.cff, empty: none
};

/// Markdown. The same content gives the same text.
std::string dataset_card(const CardContent& content);

}  // namespace tacipc
