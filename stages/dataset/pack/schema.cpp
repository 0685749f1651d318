#include "stages/dataset/pack/schema.h"

#include "tacipc_pack_texts.h"

namespace tacipc {

Value schema(const PackConfig& config, bool with_ensemble) {
  Value::List list;
  for (const Field& field : fields()) {
    if (field.section == Section::ensemble && !with_ensemble) continue;
    Value::Map lines{{"path", field.path()}};
    for (auto& line : attributes_of(field)) lines.push_back(line);
    lines.emplace_back("packed", config.packs(field));
    lines.emplace_back("in_variants", config.variants && field.from.in_variants && config.packs(field));
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

}  // namespace tacipc
