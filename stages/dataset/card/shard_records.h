// Reads the records of all shards and checks that they belong to one dataset.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/stage/record.h"

namespace tacipc {

/// One shard, from its record.
struct PackedShard {
  std::string name;              // "train-00000-of-00004"
  std::filesystem::path folder;  // folder written by pack
  std::string file_hash;         // hash of the HDF5 file in the record
  std::string sha256;
  int samples = 0;
  int planned = 0;  // rows of its tables: samples, and those not made
  int frames = 0;
  double bytes = 0.0;
};

/// Source file of samples, to be published with the data.
struct OriginFile {
  std::filesystem::path path;
  std::string hash;
};

/// Records of all shards of one dataset.
struct ShardRecords {
  std::vector<PackedShard> shards;                                   // shards, sorted by name
  std::map<std::string, std::map<std::string, OriginFile>> sensors;  // sensor id → role → file
  std::map<std::string, std::map<std::string, OriginFile>> objects;
  std::set<std::string> versions;
  std::vector<Record> limits;  // each distinct set of limits once
  std::string ensemble;        // title of the ensemble; empty: no ensemble
  std::size_t members_pressed = 0, presses_missing = 0;
};

/// Reads the records.
/// \throw DataError if two shards have one name, were packed with different fields, or use one name for different files
ShardRecords read_shard_records(const std::vector<std::filesystem::path>& records);

}  // namespace tacipc
