// Writes the dataset card: all information for a new user.
#pragma once

#include <string>

#include "common/config/config.h"
#include "common/stage/record.h"
#include "stages/dataset/card/dataset_tables.h"
#include "stages/dataset/card/shard_records.h"

namespace tacipc {

/// Texts of a dataset card.
struct CardConfig {
  std::string purpose;
  std::string licence;
  std::string contact;  // empty: no contact
  std::string notes;    // additional Markdown; empty: no notes

  static CardConfig read(ConfigReader& in) {
    return {.purpose = in.text("purpose"),
            .licence = in.text("licence"),
            .contact = in.text_or("contact", ""),
            .notes = in.text_or("notes", "")};
  }
};

/// Inputs of the dataset card.
struct CardContent {
  std::string name;
  CardConfig config;
  const ShardRecords& shards;
  const DatasetCounts& counts;
  const Record& schema;  // content of schema.json
  std::string loader;    // Python source
  std::string citation;  // content of CITATION.cff; empty: no citation
};

/// Dataset card as Markdown. The same content gives the same text.
std::string dataset_card(const CardContent& content);

}  // namespace tacipc
