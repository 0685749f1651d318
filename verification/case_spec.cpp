#include "verification/case_spec.h"

#include "common/base/units.h"
#include "verification/judge.h"
#include "verification/measure.h"
#include "verification/shared_files.h"

namespace tacipc::verify {
namespace {

/// Reads a word that must be one of the names of a list.
template <typename Named>
std::string one_of(ConfigReader& in, const std::string& key, const std::vector<Named>& known) {
  std::vector<std::string> names;
  for (const Named& entry : known) names.push_back(entry.name);
  return in.choice(key, names);
}

}  // namespace

FrameChoice FrameChoice::read(ConfigReader& in) {
  FrameChoice choice;
  if (const auto index = in.optional_number("frame", Range::non_negative())) choice.index = static_cast<int>(*index);
  if (in.has("phase")) choice.phase = in.text("phase");
  if (const auto depth = in.optional_number("depth_mm", Range::positive())) choice.depth_m = kMillimetre * *depth;
  if (choice.index.has_value() + choice.phase.has_value() + choice.depth_m.has_value() > 1)
    in.fault("frame", "give at most one of frame, phase, depth_mm");
  return choice;
}

Expectation Expectation::read(ConfigReader& in) {
  Expectation e;
  e.quantity = one_of(in, "quantity", quantities());
  e.label = in.text_or("label", e.quantity);
  e.frame = FrameChoice::read(in);
  e.value = in.optional_number("value");
  if (in.has("formula")) e.formula = one_of(in, "formula", formulas());
  e.with_standoff = in.flag_or("with_standoff", false);
  e.within_percent = in.optional_number("within_percent", Range::positive());
  e.within = in.optional_number("within", Range::positive());
  e.at_most = in.optional_number("at_most");
  e.at_least = in.optional_number("at_least");
  const int limits =
      e.within_percent.has_value() + e.within.has_value() + e.at_most.has_value() + e.at_least.has_value();
  const bool against = e.value.has_value() || e.formula.has_value();
  if (e.value && e.formula) in.fault("formula", "give value or formula, not both");
  if (limits != 1) in.fault("quantity", "give one of within_percent, within, at_most, at_least");
  if ((e.within_percent || e.within) && !against) in.fault("quantity", "give the value or formula it must be near");
  if ((e.at_most || e.at_least) && against) in.fault("quantity", "a bound needs no value or formula");
  if (e.with_standoff && !e.formula) in.fault("with_standoff", "belongs to a formula");
  return e;
}

Fit Fit::read(ConfigReader& in) {
  Fit fit;
  fit.frame = FrameChoice::read(in);
  fit.press_force_n = in.number("press_force_n", Range::positive());
  return fit;
}

ReferenceSpec ReferenceSpec::read(ConfigReader& in) {
  ReferenceSpec r;
  r.displacement = in.text("displacement");
  r.largest_m = 1e-6 * in.number("largest_um", Range::positive());
  r.share_percent = in.number_or("share_percent", 100.0, Range::between(50.0, 100.0));
  r.rms_m = 1e-6 * in.number("rms_um", Range::positive());
  r.first_frame = in.integer_or("first_frame", 1, 0);
  r.all_frames = in.choice_or("frames", "last", {"last", "all"}) == "all";
  return r;
}

CaseSpec CaseSpec::read(ConfigReader& in) {
  CaseSpec spec;
  spec.title = in.text("title");
  spec.source = in.text("source");
  spec.gel = in.read<GelSpec>("gel");
  spec.material = in.read<Material>("material");
  spec.object = in.read<ObjectShape>("shape");
  spec.press = in.read<PressConfig>("press");
  spec.sample = SampleSpec::read(in);
  for (ConfigReader& row : in.sections("expect")) spec.expect.push_back(Expectation::read(row));
  if (auto fit = in.optional_section("fit")) spec.fit = Fit::read(*fit);
  if (auto reference = in.optional_section("reference")) spec.reference = ReferenceSpec::read(*reference);
  if (spec.expect.empty() && !spec.reference) in.fault("expect", "nothing is expected: give expect or reference");
  return spec;
}

std::vector<std::string> CaseSpec::shared_paths() const {
  std::vector<std::string> out;
  if (const auto* file = std::get_if<FileGel>(&gel.shape)) out.push_back(file->path);
  if (object.kind == ObjectShape::Kind::file) out.push_back(object.path);
  if (reference) out.push_back(reference->displacement);
  std::erase_if(out, [](const std::string& path) { return !is_shared(path); });
  return out;
}

}  // namespace tacipc::verify
