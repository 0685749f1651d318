#include "stages/dataset/pack/pack_config.h"

#include <algorithm>

#include "tacipc_pack_texts.h"

namespace tacipc {

bool PackConfig::packs(const Field& field) const {
  return std::find(packed.begin(), packed.end(), &field) != packed.end();
}

Value PackConfig::schema(bool with_ensemble) const {
  Value::List list;
  for (const Field& field : fields()) {
    if (field.section == Section::ensemble && !with_ensemble) continue;
    Value::Map lines{{"path", field.path()}};
    for (auto& line : attributes_of(field)) lines.push_back(line);
    lines.emplace_back("packed", packs(field));
    lines.emplace_back("in_variants", variants && field.from.in_variants && packs(field));
    list.emplace_back(std::move(lines));
  }
  ConfigReader texts = ConfigReader::from_text(kSchema, "schema.yaml");
  Value conventions = texts.section("conventions").content();
  if (with_ensemble) conventions.set("ensemble", texts.text("ensemble"));
  return Value::Map{{"format", "tactile-shard"},
                    {"version", 1},
                    {"sample_group", "data/<id>"},
                    {"conventions", conventions},
                    {"letters", texts.section("letters").content()},
                    {"fields", std::move(list)}};
}

PackConfig PackConfig::read(ConfigReader& in) {
  PackConfig config;
  config.variants = in.flag_or("variants", false);
  config.list_unmade = in.choice_or("unmade", "refuse", {"refuse", "list"}) == "list";
  for (const Section section : kSections) {
    // Fields for verdicts and labels are never left out.
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
