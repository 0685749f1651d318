#include "common/config/config_text.h"

#include <gtest/gtest.h>

#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace config_text_test {

const std::string kPress =
    "# slow, µm apart\n"
    "solver:   # of Newton\n"
    "    tolerance: 1e-3     # m/s\n"
    "    limits:\n"
    "        iterations:   100\n"
    "\n"
    "        # not less\n"
    "        halvings: {step: 20, \"of\": [1, 2]}\n"
    "\n"
    "# how it moves\n"
    "motion:\n"
    "- kind: press\n"
    "  depth_mm: 0.5\n"
    "- {kind: hold, steps: 3}\n"
    "note: 'it''s # no comment'   # but this is\n"
    "empty:\n"
    "long: first\n"
    "  second\n"
    "last: \"x\"";

std::string set(const std::string& text, const std::string& path, const std::string& yaml) {
  ConfigText config(text, "in.yaml");
  config.set(path, yaml);
  return config.text();
}
std::string add(const std::string& text, const std::string& path, const std::string& yaml) {
  ConfigText config(text, "in.yaml");
  config.add(path, yaml);
  return config.text();
}
std::string remove(const std::string& text, const std::string& path) {
  ConfigText config(text, "in.yaml");
  config.remove(path);
  return config.text();
}
/// The text with `before`, which is there once, replaced.
std::string with(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  EXPECT_EQ(text.find(before, at + 1), std::string::npos) << before;
  return std::string(text).replace(at, before.size(), after);
}

TEST(ConfigText, SetChangesNothingButTheValue) {
  const auto changes = [&](const std::string& path, const std::string& yaml, const std::string& before,
                           const std::string& after) {
    EXPECT_EQ(set(kPress, path, yaml), with(kPress, before, after)) << path;
  };
  changes("solver.tolerance", "5", "1e-3", "5");
  changes("solver.limits.iterations", "7", "100", "7");
  changes("solver.limits.halvings.step", "[3, 4]", "20", "[3, 4]");
  changes("solver.limits.halvings.of", "{a: b}", "[1, 2]", "{a: b}");
  changes("solver.limits.halvings.of[1]", "-3", "[1, 2]", "[1, -3]");
  changes("solver.limits.halvings", "none", "{step: 20, \"of\": [1, 2]}", "none");
  changes("motion[0].depth_mm", "0.25", "0.5", "0.25");
  changes("motion[0].kind", "shear", "press", "shear");
  changes("motion[1].steps", "4", "3}", "4}");
  changes("motion[1]", "{kind: release}", "{kind: hold, steps: 3}", "{kind: release}");
  changes("motion[0]", "{kind: hold}", "kind: press\n  depth_mm: 0.5", "{kind: hold}");
  changes("note", "plain", "'it''s # no comment'", "plain");
  changes("empty", "full", "empty:", "empty: full");
  changes("long", "short", "first\n  second", "short");
  changes("last", "y", "\"x\"", "y");
}

TEST(ConfigText, ASectionGivesWayToAValueAndTheCommentsBesideItStay) {
  EXPECT_EQ(set("a: # why\n  b: 1\n  c: |\n    # text\n    more\n\n# end\nd: 2\n", "a", "{b: 3}"),
            "a: {b: 3} # why\n\n# end\nd: 2\n");
  EXPECT_EQ(set("a:\n- 1\n- 2\nd: 2\n", "a", "[3]"), "a: [3]\nd: 2\n");
  EXPECT_EQ(set("text: |\n  # text\n  more\n\nd: 2\n", "text", "short"), "text: short\n\nd: 2\n");
}

TEST(ConfigText, TakesLinesOfWindowsAndTheLastLineWithoutAnEnd) {
  EXPECT_EQ(set("a: 1\r\nb:\r\n  c: 2\r\n", "b.c", "3"), "a: 1\r\nb:\r\n  c: 3\r\n");
  EXPECT_EQ(set("a: 1\r\nb:\r\n  c: 2\r\n", "a", "3"), "a: 3\r\nb:\r\n  c: 2\r\n");
  EXPECT_EQ(add("a: 1", "b", "2"), "a: 1\nb: 2");
  EXPECT_EQ(remove("a: 1\nb: 2", "b"), "a: 1\n");
}

TEST(ConfigText, AddPutsAKeyBehindItsSiblings) {
  EXPECT_EQ(add(kPress, "solver.limits.seconds", "9"), with(kPress, "[1, 2]}\n", "[1, 2]}\n        seconds: 9\n"));
  EXPECT_EQ(add(kPress, "solver.note", "x"), with(kPress, "[1, 2]}\n", "[1, 2]}\n    note: x\n"));
  EXPECT_EQ(add(kPress, "solver.limits.halvings.a.b", "9"), with(kPress, "[1, 2]}", "[1, 2], a: {b: 9}}"));
  EXPECT_EQ(add(kPress, "motion[0].steps", "2"), with(kPress, "mm: 0.5\n", "mm: 0.5\n  steps: 2\n"));
  EXPECT_EQ(add(kPress, "motion[1].x", "2"), with(kPress, "steps: 3}", "steps: 3, x: 2}"));
  EXPECT_EQ(add(kPress, "empty.a.b", "2"), with(kPress, "empty:\n", "empty:\n  a:\n    b: 2\n"));
  EXPECT_EQ(add(kPress, "new.a", "2"), kPress + "\nnew:\n  a: 2");
  EXPECT_EQ(add("a: {}\n", "a.b", "1"), "a: {b: 1}\n");
  EXPECT_EQ(add("{a: }\n", "a.b", "1"), "{a: {b: 1} }\n");
}

TEST(ConfigText, RemoveTakesTheKeyAndWhatItHolds) {
  EXPECT_EQ(remove(kPress, "solver.tolerance"), with(kPress, "    tolerance: 1e-3     # m/s\n", ""));
  EXPECT_EQ(remove(kPress, "solver.limits.iterations"), with(kPress, "        iterations:   100\n", ""));
  EXPECT_EQ(remove(kPress, "solver.limits.halvings.step"), with(kPress, "step: 20, ", ""));
  EXPECT_EQ(remove(kPress, "solver.limits.halvings.of"), with(kPress, ", \"of\": [1, 2]", ""));
  EXPECT_EQ(remove(kPress, "motion"),
            with(kPress, "motion:\n- kind: press\n  depth_mm: 0.5\n- {kind: hold, steps: 3}\n", ""));
  EXPECT_EQ(remove(kPress, "motion[0].kind"), with(kPress, "kind: press\n  ", ""));
  EXPECT_EQ(remove(kPress, "long"), with(kPress, "long: first\n  second\n", ""));
  EXPECT_EQ(remove("a:\n  b: 1\nc: 2\n", "a.b"), "a:\n  {}\nc: 2\n");
  EXPECT_EQ(remove("a: {b: 1}\n", "a.b"), "a: {}\n");
}

TEST(ConfigText, SaysWhereAKeyIsMissing) {
  using Faults = std::vector<std::string>;
  EXPECT_EQ(faults_of([] { set(kPress, "solver.tolerence", "1"); }),
            Faults{"in.yaml:2:1: solver.tolerence: there is no such key (did you mean tolerance?)"});
  EXPECT_EQ(faults_of([] { set(kPress, "solver.limits.x.y", "1"); }),
            Faults{"in.yaml:4:5: solver.limits.x.y: there is no such key"});
  EXPECT_EQ(faults_of([] { set(kPress, "motions", "1"); }),
            Faults{"in.yaml:1:1: motions: there is no such key (did you mean motion?)"});
  EXPECT_EQ(faults_of([] { set(kPress, "motion[2].kind", "1"); }),
            Faults{"in.yaml:11:1: motion[2].kind: there is no such key"});
  EXPECT_EQ(faults_of([] { remove(kPress, "nota"); }),
            Faults{"in.yaml:1:1: nota: there is no such key (did you mean note?)"});
  EXPECT_EQ(faults_of([] { remove(kPress, "motion[0]"); }),
            Faults{"in.yaml:12:3: motion[0]: is an item of a list; only keys can be taken out"});
  EXPECT_EQ(faults_of([] { add(kPress, "solver.limits", "1"); }), Faults{"in.yaml:4:5: solver.limits: exists already"});
  EXPECT_EQ(faults_of([] { add(kPress, "note.x", "1"); }), Faults{"in.yaml:15:1: note.x: note has no keys"});
}

TEST(ConfigText, RefusesWhatWouldSayAnythingElse) {
  using Faults = std::vector<std::string>;
  // Both keys hold the same map.
  EXPECT_EQ(faults_of([] { set("a: &x {b: 1}\nc: *x\n", "c.b", "2"); }),
            Faults{"in.yaml:1:8: c.b: cannot be changed the way it is written here"});
  EXPECT_EQ(faults_of([] { set("? a\n: 1\n", "a", "2"); }),
            Faults{"in.yaml:1:3: a: cannot be changed the way it is written here"});
  // Within braces the comma would end the value.
  EXPECT_EQ(faults_of([] { set("a: {b: 1}\n", "a.b", "2, c"); }),
            Faults{"in.yaml:1:5: a.b: cannot be changed the way it is written here"});
  EXPECT_EQ(faults_of([] { set("a: 1\na: 2\n", "a", "2"); }),
            Faults{"in.yaml:2:1: a: key given twice (first in line 1)"});
  EXPECT_EQ(faults_of([] { set("a: [1\n", "a", "2"); }).size(), 1u);
  EXPECT_EQ(message_of<UsageError>([] { set("a: 1\n", "a", "[2"); }), "a: '[2' is not a value in YAML");
  EXPECT_EQ(message_of<UsageError>([] { set("a: 1\n", "a", "b: 2"); }), "a: 'b: 2' is not a value in YAML");
  EXPECT_EQ(message_of<UsageError>([] { set("a: 1\n", "a", ""); }), "a: a value stands on one line and is not empty");
}

}  // namespace config_text_test
}  // namespace tacipc
