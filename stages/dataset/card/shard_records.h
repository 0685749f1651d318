// What the records of all shards say, checked to be of one dataset.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/stage/record.h"

namespace tacipc {

struct PackedShard {
  std::string name;              // "train-00000-of-00004"
  std::filesystem::path folder;  // that pack wrote
  std::string file_hash;         // of the HDF5 file, as the record has it
  std::string sha256;
  int samples = 0;
  int planned = 0;  // samples and those not made: rows of its tables
  int frames = 0;
  double bytes = 0.0;
};

/// A file that samples were made from, to be given away with the data.
struct OriginFile {
  std::filesystem::path path;
  std::string hash;
};

struct ShardRecords {
  std::vector<PackedShard> shards;                                   // by name
  std::map<std::string, std::map<std::string, OriginFile>> sensors;  // id → role → file
  std::map<std::string, std::map<std::string, OriginFile>> objects;
  std::set<std::string> versions;
  std::vector<Record> limits;  // each different one once
  std::string ensemble;        // its title; empty: there is none
  std::size_t members_pressed = 0, presses_missing = 0;
};

/// \throw DataError if two shards have one name, were packed with different fields, or mean different files by one name
ShardRecords read_shard_records(const std::vector<std::filesystem::path>& records);

}  // namespace tacipc
