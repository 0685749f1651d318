#include "stages/dataset/card/dataset_tables.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <memory>

#include "common/base/error.h"
#include "common/format/csv.h"
#include "common/sample/dataset_plan.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Table written line by line.
class TableWriter {
 public:
  explicit TableWriter(const fs::path& path) : name_(path.string()), file_(path, std::ios::binary) {}
  void add(const std::string& line) { file_ << line; }
  void close() {
    file_.close();
    if (!file_) throw DataError("{}: cannot be written (is the disk full?)", name_);
  }

 private:
  std::string name_;
  std::ofstream file_;
};

/// One of a shard's tables, at the current sample of the plan.
class ShardTable {
 public:
  explicit ShardTable(const fs::path& path) : name_(path.string()), rows_(path) {}
  const CsvReader& row_of(const std::string& id) {
    if (!rows_.next() || rows_["id"] != id)
      throw DataError("{}: is of another plan: expected {} next (pack the shard again)", name_, id);
    return rows_;
  }
  const CsvReader& rows() const { return rows_; }

 private:
  std::string name_;
  CsvReader rows_;
};

/// Tables of one shard, open from its first sample to its last. A plan fills the shards of each split one after the
/// other, and a process can only have some thousand files open.
class ShardTables {
 public:
  struct Tables {
    ShardTable manifest;
    ShardTable failures;
    ShardTable timings;
    explicit Tables(const fs::path& folder)
        : manifest(folder / "manifest.csv"), failures(folder / "failures.csv"), timings(folder / "timings.csv") {}
  };

  explicit ShardTables(const PackedShard& shard) : folder_(shard.folder), left_(shard.planned) {}
  bool begun() const { return begun_; }
  /// Tables at the next sample.
  /// \throw DataError if there are no more
  Tables& next(const std::string& id) {
    if (left_ == 0)
      throw DataError("{}: is of another plan: expected {} next (pack the shard again)",
                      (folder_ / "manifest.csv").string(), id);
    if (!begun_) tables_ = std::make_unique<Tables>(folder_);
    begun_ = true;
    --left_;
    return *tables_;
  }
  /// Closes the tables after the last sample; must be called when a sample is complete.
  void close_after_last() {
    if (left_ == 0) tables_.reset();
  }

 private:
  fs::path folder_;
  int left_;
  bool begun_ = false;
  std::unique_ptr<Tables> tables_;
};

constexpr const char* kCounted[] = {"split", "sensor", "object", "motion", "outcome", "reason"};
constexpr const char* kMeasured[] = {"n_frames",
                                     "press_force_N",
                                     "tangential_force_N",
                                     "max_indentation_mm",
                                     "min_distance_mm",
                                     "min_volume_ratio",
                                     "max_force_balance_rel",
                                     "clipped_fraction",
                                     "mu",
                                     "object_mass_g",
                                     "grip_N",
                                     "friction_margin",
                                     "lever_mm",
                                     "end_slip_mm",
                                     "end_turn_deg",
                                     "first_slip_s",
                                     "gross_slip_s"};

void count(const CsvReader& row, DatasetCounts& counts) {
  ++counts.status[row["status"]];
  const bool made = row["status"] == "made";
  for (const char* column : kCounted) ++(made ? counts.made : counts.not_made)[column][row[column]];
  if (!made) return;
  if (!row["outcome"].empty()) ++counts.outcomes[row["outcome"]][row["split"]];
  for (const char* column : kMeasured) {
    const std::string& text = row[column];
    double value = 0.0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) continue;
    Extent& extent = counts.extents[column];
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  }
}

}  // namespace

DatasetCounts join_tables(const fs::path& plan, const ShardRecords& records,
                          const std::function<fs::path(const std::string&)>& output) {
  std::map<std::string, ShardTables> tables;
  for (const PackedShard& shard : records.shards) tables.emplace(shard.name, shard);
  TableWriter manifest(output("manifest.csv")), failures(output("failures.csv")), timings(output("timings.csv"));
  std::map<std::string, TableWriter> splits;
  for (const char* split : {"train", "val", "test"}) {
    splits.emplace(split, output(fmt::format("splits/{}.txt", split)));
    splits.emplace(std::string("pose_") + split, output(fmt::format("splits/pose/{}.txt", split)));
  }
  DatasetCounts counts;
  if (!records.shards.empty()) {
    const ShardTables::Tables first(records.shards.front().folder);
    manifest.add(csv_line(first.manifest.rows().columns()));
    failures.add(csv_line(first.failures.rows().columns()));
    timings.add(csv_line(first.timings.rows().columns()));
  }
  CsvReader planned(plan);
  while (planned.next()) {
    const PlannedRow sample = planned_row(planned, plan);
    const std::string &id = sample.id, &shard = sample.shard;
    const auto found = tables.find(shard);
    if (found == tables.end()) throw DataError("{}: shard {} has not been packed", plan.string(), shard);
    ShardTables::Tables& own = found->second.next(id);
    const CsvReader& row = own.manifest.row_of(id);
    count(row, counts);
    manifest.add(csv_line(row.row()));
    timings.add(csv_line(own.timings.row_of(id).row()));
    if (row["status"] != "made") {
      failures.add(csv_line(own.failures.row_of(id).row()));
    } else {
      for (const std::string& list : {row["split"], "pose_" + row["split_pose"]}) {
        const auto to = splits.find(list);
        if (to == splits.end()) throw DataError("{}:{}: '{}' is not a split", plan.string(), planned.line(), list);
        to->second.add(id + "\n");
      }
    }
    found->second.close_after_last();
  }
  for (const auto& [name, own] : tables)
    if (!own.begun()) throw DataError("{}: has no shard {}, which was packed", plan.string(), name);
  for (TableWriter* table : {&manifest, &failures, &timings}) table->close();
  for (auto& [name, table] : splits) table.close();
  return counts;
}

}  // namespace tacipc
