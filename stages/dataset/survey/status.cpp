#include "stages/dataset/survey/status.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/ensemble.h"
#include "common/sample/sample_status.h"
#include "stages/dataset/survey/plan_lock.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr double kRecent_s = 600.0;

/// Time of a file's last change, in seconds; nothing if it is gone.
std::optional<double> time_of(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return std::nullopt;
  return static_cast<double>(found.st_mtim.tv_sec) + 1e-9 * static_cast<double>(found.st_mtim.tv_nsec);
}

bool lies_in(const std::string& index, const IndexRange& range) {
  const std::size_t value = std::stoul(index);
  return value >= range.first && (!range.end || value < *range.end);
}

}  // namespace

DatasetStatus dataset_status(const fs::path& dataset, const IndexRange& range, std::time_t now) {
  const fs::path table = samples_table(dataset);
  const double time = static_cast<double>(now);
  DatasetStatus status;
  const auto ensemble = ensemble_of_dataset(dataset);
  double first_recent = time;
  for_each_planned(table, std::nullopt, [&](const PlannedRow& row) {
    if (!lies_in(row.index, range)) return;
    ++status.samples;
    const fs::path folder = dataset / row.folder;
    switch (status_of(folder)) {
      case SampleStatus::made: {
        ++status.made;
        if (ensemble && row.sensor == ensemble->sensor && !is_finger(folder)) {
          for (const std::string& press : ensemble->presses()) {
            const fs::path of_member = member_press(folder, press);
            ++status.presses;
            if (fs::exists(of_member / "press.yaml"))
              ++status.presses_made;
            else if (fs::exists(of_member / "press.failed.yaml"))
              ++status.presses_failed;
          }
        }
        const auto made = time_of(folder / "render/render.yaml");
        if (made && *made > time - kRecent_s) {
          ++status.made_recently;
          first_recent = std::min(first_recent, *made);
        }
        break;
      }
      case SampleStatus::failed: ++status.failed; break;
      case SampleStatus::running: ++status.running; break;
      case SampleStatus::unmade: break;
    }
  });
  const std::size_t expected = range.end ? *range.end - range.first : std::max<std::size_t>(status.samples, 1);
  if (status.samples != expected)
    throw DataError(
        "{} has {} rows where there should be {}: it is damaged or being made again; if this persists: make -f "
        "Makefile.data clean-plan CONFIG=...",
        table.string(), status.samples, expected);
  status.recent_seconds = time - first_recent;
  return status;
}

std::string to_text(const DatasetStatus& status, const fs::path& dataset) {
  std::string text = fmt::format("{}: {} samples: {} made, {} failed, {} running, {} left\n", name_of_dataset(dataset),
                                 status.samples, status.made, status.failed, status.running, status.left());
  if (status.presses > 0)
    text += fmt::format("  ensemble: {} presses beside the samples made: {} made, {} failed, {} left\n", status.presses,
                        status.presses_made, status.presses_failed,
                        status.presses - status.presses_made - status.presses_failed);
  if (status.made_recently > 1 && status.left() > 0) {
    const double seconds = std::max(status.recent_seconds, 1.0), late = static_cast<double>(status.made_recently);
    text += fmt::format("  {:.1f} per minute recently; the rest takes {:.2f} hours at this rate\n",
                        60.0 * late / seconds, static_cast<double>(status.left()) * seconds / late / 3600.0);
  }
  if (status.failed > 0 || status.presses_failed > 0)
    text +=
        fmt::format("  reasons in {}/failures.csv; again: make -f Makefile.data retry CONFIG=...\n", dataset.string());
  return text;
}

}  // namespace tacipc
