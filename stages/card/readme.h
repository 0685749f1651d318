// The dataset card: what someone needs who has never seen the project.
#pragma once

#include <string>

#include "common/record.h"
#include "stages/card/card_config.h"
#include "stages/card/dataset_tables.h"
#include "stages/card/shard_records.h"

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
