#include "stages/dataset/pack/schema.h"

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
  Value::Map conventions{
      {"frame_S",
       "origin at the centre of the undeformed front of the gel; x to image right, y to image down, z out of the gel "
       "towards the object; right-handed; the camera looks along +z from behind"},
      {"frame_world",
       "of a grasp: x from the left finger to the right one before the hand turns, z up, origin where the object is "
       "gripped in frame 0"},
      {"force", "on the gel by the object"},
      {"indentation", "positive into the gel"},
      {"quaternions", "x, y, z, w: scalar last, unit, scalar never negative"},
      {"images", "8-bit RGB, row 0 on top"},
      {"pixels", "column right, row down; pixel (0, 0) spans 0 to 1"},
      {"frame_0", "the gel without contact, always there"},
      {"missing",
       "a field that a sample has not is absent, and its group has an attribute absent_<field> with the "
       "reason; never zeros"},
      {"variants",
       "data/<id>/variants/<name>/ holds the fields with in_variants once more, of the same deformation "
       "under other light or of another sensor unit"}};
  if (with_ensemble)
    conventions.emplace_back(
        "ensemble",
        "data/<id>/ensemble/ tells how sure labels are: <label>_sigma is the standard deviation over presses by "
        "sensors "
        "that fit the measurements alike, <label>_mesh what a coarser gel changes; its attributes `members` and "
        "`missing` name who was pressed and who was not");
  const Value::Map letters{{"T", "packed frames"},
                           {"P", "frames of the press, rendered or not"},
                           {"H", "rows of the image"},
                           {"W", "columns of the image"},
                           {"h", "rows of the force grid"},
                           {"w", "columns of the force grid"},
                           {"N", "markers"},
                           {"V", "vertices of the gel's front"},
                           {"F", "triangles of the gel's front"}};
  return Value::Map{{"format", "tactile-shard"},  {"version", 1},       {"sample_group", "data/<id>"},
                    {"conventions", conventions}, {"letters", letters}, {"fields", std::move(list)}};
}

}  // namespace tacipc
