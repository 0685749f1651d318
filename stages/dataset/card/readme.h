// The dataset card: everything a new user needs.
#pragma once

#include <string>

#include "common/stage/record.h"
#include "stages/dataset/card/card_config.h"
#include "stages/dataset/card/dataset_tables.h"
#include "stages/dataset/card/shard_records.h"

namespace tacipc {

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
