#include "common/stage/stage_timings.h"

#include "common/stage/record.h"

namespace tacipc {

StageTimings read_timings(const std::filesystem::path& file) {
  const Record record = Record::from_file(file);
  return {.stage = record.required_text("stage"),
          .processor_s = record.required_number("processor_s"),
          .wall_s = record.required_number("wall_s"),
          .peak_memory_mb = record.required_number("peak_memory_mb")};
}

StageTimings read_timings_of(const std::filesystem::path& record) {
  std::filesystem::path file = record;
  return read_timings(file.replace_extension(".timings.yaml"));
}

}  // namespace tacipc
