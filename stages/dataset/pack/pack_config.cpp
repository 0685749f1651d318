#include "stages/dataset/pack/pack_config.h"

#include <algorithm>

namespace tacipc {

bool PackConfig::packs(const Field& field) const {
  return std::find(packed.begin(), packed.end(), &field) != packed.end();
}

PackConfig PackConfig::read(ConfigReader& in) {
  PackConfig config;
  config.variants = in.flag_or("variants", false);
  config.list_unmade = in.choice_or("unmade", "refuse", {"refuse", "list"}) == "list";
  for (const Section section : kSections) {
    // What judges a sample, and what labels follow from, is never left out.
    if (section != Section::obs && section != Section::sim) {
      for (const Field& field : fields())
        if (field.section == section) config.packed.push_back(&field);
      continue;
    }
    auto names = in.optional_section(name_of(section));
    if (!names) continue;
    for (const Field& field : fields())
      if (field.section == section && names->flag_or(field.name, false)) config.packed.push_back(&field);
  }
  const auto observed = [](const Field* field) { return field->section == Section::obs; };
  if (std::none_of(config.packed.begin(), config.packed.end(), observed))
    in.fault("obs", "at least one field must be true");
  return config;
}

}  // namespace tacipc
