#include "common/config/config.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <ctime>

#include "tests/config_text.h"

namespace tacipc {
namespace config_test {

using ::testing::ElementsAre;

std::vector<std::string> faults_when(const std::string& text, const std::function<void(ConfigReader&)>& read) {
  return faults_of([&] {
    ConfigReader in = ConfigReader::from_text(text, "gel.yaml");
    read(in);
    in.finish();
  });
}

TEST(ConfigReader, ReportsFiveFaultsAtOnceEachAtItsPlace) {
  const std::string text =
      "gel:\n"
      "  young_modulus_pa: 1e5\n"
      "  poissons_ratio: 0.6\n"
      "  poissons_ratio: 0.4\n"
      "  layers: many\n"
      "steps: 2.5\n";
  const auto faults = faults_when(text, [](ConfigReader& in) {
    ConfigReader gel = in.section("gel");
    gel.number("youngs_modulus_pa", Range::positive());
    gel.number("poissons_ratio", Range::between(0.0, 0.4999));
    gel.integer("layers", 1);
    in.integer("steps", 1);
  });
  EXPECT_THAT(faults, ElementsAre("gel.yaml:2:3: gel.youngs_modulus_pa: missing",
                                  "gel.yaml:2:3: gel.young_modulus_pa: unknown key (did you mean youngs_modulus_pa?)",
                                  "gel.yaml:3:19: gel.poissons_ratio: 0.6 is outside [0, 0.4999]",
                                  "gel.yaml:4:3: gel.poissons_ratio: key given twice (first in line 3)",
                                  "gel.yaml:5:11: gel.layers: expected a whole number, found 'many'",
                                  "gel.yaml:6:8: steps: expected a whole number, found '2.5'"));
}

TEST(ConfigReader, RefusesNumbersWithoutAMeaningInTheirUnit) {
  const std::string text =
      "distance_mm: 1e9\n"
      "gravity_m_s2: -1e21\n"
      "by_mm: [0, 1e5, 0]\n"
      "turn_deg: 1e6\n"
      "scale: 1e300\n"
      "force_n: 1e6\n"
      "time_s: -1e8\n";
  const auto faults = faults_when(text, [](ConfigReader& in) {
    in.number("distance_mm", Range::positive());
    in.number("gravity_m_s2");
    in.vector3("by_mm");
    in.optional_number("turn_deg");
    in.number_or("scale", 1.0, Range::positive());
    EXPECT_EQ(in.number("force_n"), 1e6);
    EXPECT_EQ(in.number("time_s"), -1e8);
  });
  EXPECT_THAT(
      faults,
      ElementsAre("gel.yaml:1:14: distance_mm: 1e9 is beyond 10000",
                  "gel.yaml:2:15: gravity_m_s2: -1e21 is beyond 10000", "gel.yaml:3:12: by_mm[1]: 1e5 is beyond 10000",
                  "gel.yaml:4:11: turn_deg: 1e6 is beyond 36000", "gel.yaml:5:8: scale: 1e300 is beyond 1e+16"));
}

TEST(ConfigReader, TakesNamesOfFilesAlone) {
  const auto read = [](ConfigReader& in) {
    in.file_name("a");
    in.file_name("b");
  };
  EXPECT_THAT(faults_when("a: star_2\nb: x.y\n", read), ElementsAre());
  EXPECT_THAT(faults_when("a: ../star\n", read),
              ElementsAre("gel.yaml:1:1: b: missing", testing::StartsWith("gel.yaml:1:4: a: '../star': a name has")));
}

TEST(ConfigReader, RejectsWhatIsNotYaml) {
  EXPECT_THAT(faults_when("a: [1, 2", [](ConfigReader&) {}),
              ElementsAre("gel.yaml:1:1: not valid YAML: end of sequence flow not found"));
  EXPECT_THAT(faults_when("- 1\n- 2\n", [](ConfigReader&) {}),
              ElementsAre("gel.yaml:1:1: expected a map of keys, found a list"));
  EXPECT_THAT(faults_when("", [](ConfigReader&) {}),
              ElementsAre("gel.yaml:1:1: expected a map of keys, found nothing"));
}

TEST(ConfigReader, RefusesASecondDocumentAndAnAliasInsideItself) {
  EXPECT_THAT(faults_when("a: 1\n---\nb: 2\n", [](ConfigReader& in) { in.number("a"); }),
              ElementsAre("gel.yaml:3:1: a second document begins; only one is read"));
  EXPECT_THAT(faults_when("a: &x [*x]\n", [](ConfigReader& in) { in.numbers("a", 1); }),
              ::testing::Not(::testing::IsEmpty()));
}

TEST(ConfigReader, RefusesAliasesThatWriteOutMoreThanAFileMayHold) {
  // Nine lists, each of nine times the one before: 9^9 values of 400 bytes of text.
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string before = fmt::format("*a{}", i - 1);
    laughs += fmt::format("a{0}: &a{0} [{1}, {1}, {1}, {1}, {1}, {1}, {1}, {1}, {1}]\n", i, before);
  }
  EXPECT_THAT(
      faults_when(laughs, [](ConfigReader&) {}),
      ElementsAre(::testing::MatchesRegex("gel.yaml:7:[0-9]+: a6: more than 1000000 values, aliases written out")));
  std::string copies = "long: &long " + std::string(1 << 20, 'x') + "\nlist:\n";
  for (int i = 0; i < 100; ++i) copies += "  - *long\n";
  EXPECT_THAT(faults_when(copies, [](ConfigReader&) {}),
              ElementsAre("gel.yaml:65:5: list: more than 64 MiB of text, aliases written out"));
  EXPECT_THAT(faults_when("a: &x [*x]\n", [](ConfigReader&) {}),
              ElementsAre("gel.yaml:1:8: a: an alias inside its own anchor"));
}

TEST(ConfigReader, RefusesWhatIsNestedTooDeeplyAtItsPlace) {
  const auto nested = [](int lists) { return "a: " + std::string(lists, '[') + std::string(lists, ']') + "\n"; };
  const auto ignore = [](ConfigReader& in) { in.ignore("a"); };
  EXPECT_THAT(faults_when(nested(31), ignore), ElementsAre());
  for (const int deep : {32, 600, 100000}) {
    const auto faults = faults_when(nested(deep), ignore);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_THAT(faults.front(), ::testing::StartsWith("gel.yaml:1:35: a[0]"));
    EXPECT_THAT(faults.front(), ::testing::EndsWith("[0]: nested more than 32 deep"));
  }
  std::string aliases = "a0: &a0 [x]\n";
  for (int i = 1; i < 40; ++i) aliases += fmt::format("a{}: &a{} [*a{}]\n", i, i, i - 1);
  const auto faults = faults_when(aliases, [](ConfigReader&) {});
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults.front(), "gel.yaml:32:12: a31: nested more than 32 deep");
}

TEST(ConfigReader, RefusesBytesThatAreNoText) {
  const auto none = [](ConfigReader&) {};
  EXPECT_THAT(faults_when(std::string("a: 1\nb: x\0y\n", 12), none),
              ElementsAre("gel.yaml:2:5: not valid YAML: a byte 0x00, which is a control character"));
  EXPECT_THAT(faults_when("a: \x1b[31m\n", none),
              ElementsAre("gel.yaml:1:4: not valid YAML: a byte 0x1b, which is a control character"));
  EXPECT_THAT(faults_when("# \xe9t\xe9\n", none),
              ElementsAre("gel.yaml:1:3: not valid YAML: a byte 0xe9, which is not UTF-8"));
}

TEST(ConfigReader, MessagesShowControlBytesEscapedAndLongTextsCut) {
  const auto number = [](ConfigReader& in) { in.number("a"); };
  EXPECT_THAT(faults_when("a: \"\\e[31mred\"\n", number),
              ElementsAre("gel.yaml:1:4: a: expected a number, found '\\x1b[31mred'"));
  EXPECT_THAT(faults_when("a: " + std::string(2'000'000, '7') + "x\n", number),
              ElementsAre("gel.yaml:1:4: a: expected a number, found '" + std::string(80, '7') + "… (2000001 bytes)'"));
  EXPECT_THAT(faults_when("? " + std::string(2000, 'k') + "\n: 1\na: 1\n", number),
              ElementsAre("gel.yaml:1:3: a key of more than 1024 bytes: '" + std::string(80, 'k') + "… (2000 bytes)'"));
  std::string many = "a: 1\n";
  for (int i = 0; i < 1000; ++i) many += fmt::format("key{}: 1\n", i);
  const auto faults = faults_when(many, number);
  ASSERT_EQ(faults.size(), 101u);
  EXPECT_EQ(faults.front(), "gel.yaml:2:1: key0: unknown key");
  EXPECT_EQ(faults.back(), "gel.yaml: and 900 more");
}

TEST(ConfigReader, TakesTimeInProportionToTheNumberOfKeys) {
  // Not the clock is asked, which other programs slow down, but this program's own seconds for ten times the keys.
  const auto seconds = [](int keys) {
    std::string text = "s:\n";
    for (int i = 0; i < keys; ++i) text += fmt::format("  key{}: {}\n", i, i);
    const std::clock_t start = std::clock();
    ConfigReader in = ConfigReader::from_text(text, "f");
    ConfigReader section = in.section("s");
    for (const std::string& key : section.keys()) EXPECT_TRUE(section.has(key) && section.integer(key, 0) >= 0);
    in.finish();
    EXPECT_EQ(in.resolved().map().size(), 1u);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const double few = seconds(10'000), many = seconds(100'000);
  EXPECT_LT(many, 40.0 * few);  // 100 if each key were compared with every other
}

TEST(ConfigReader, ContentIsAllThatIsWritten) {
  const auto in = ConfigReader::from_text("a: &x 1.50\nb: {c: [*x, {d: }], a: yes}\n", "gel.yaml");
  EXPECT_EQ(to_yaml(in.content()), "a: 1.50\nb:\n  c:\n    - 1.50\n    - d: \"\"\n  a: yes\n");
}

TEST(ConfigReader, WhatIsWrittenIsReadBack) {
  // Two escapes that yaml-cpp reads as bytes that are no UTF-8, and a carriage return, which it would write plain.
  const auto in = ConfigReader::from_text("next line: \"a\\Nb\"\nblank: \"a\\_b\"\n\"k\\r\": \"a\\rb\"\n", "gel.yaml");
  const Value::Map content = in.content().map();
  EXPECT_EQ(std::get<std::string>(content[0].second.data()),
            "a\xC2\x85"
            "b");
  EXPECT_EQ(std::get<std::string>(content[1].second.data()),
            "a\xC2\xA0"
            "b");
  EXPECT_EQ(std::get<std::string>(content[2].second.data()), "a\rb");
  const auto again = ConfigReader::from_text(to_yaml(in.content()), "again.yaml");
  EXPECT_EQ(to_yaml(again.content()), to_yaml(in.content()));
  EXPECT_EQ(again.content().map()[2].first, "k\r");
}

TEST(ConfigReader, SuggestsTheNearestChoice) {
  EXPECT_THAT(
      faults_when("law: neo_hokean",
                  [](ConfigReader& in) {
                    in.choice("law", {"neo_hookean", "stvk"});
                  }),
      ElementsAre("gel.yaml:1:6: law: 'neo_hokean' is not one of neo_hookean, stvk (did you mean neo_hookean?)"));
}

TEST(ConfigReader, ListsOfChoicesNameTheWordThatIsNone) {
  const std::vector<std::string> maps{"depth", "normal"};
  const auto read = [&](ConfigReader& in) { return in.choices_or("maps", {"depth"}, maps); };
  EXPECT_THAT(faults_when("maps: [normal, dept]", read),
              ElementsAre("gel.yaml:1:16: maps[1]: 'dept' is not one of depth, normal (did you mean depth?)"));
  EXPECT_THAT(faults_when("maps:\n  - depth\n  - depth\n", read),
              ElementsAre("gel.yaml:3:5: maps[1]: depth is given twice"));
  EXPECT_THAT(faults_when("maps: depth", read),
              ElementsAre("gel.yaml:1:7: maps: expected a list of words, found a single value"));
  auto in = ConfigReader::from_text("maps: [normal, depth]\n", "gel.yaml"),
       empty = ConfigReader::from_text("{}", "gel.yaml");
  EXPECT_THAT(read(in), ElementsAre("normal", "depth"));
  EXPECT_THAT(read(empty), ElementsAre("depth"));
  EXPECT_EQ(to_yaml(empty.resolved()), "maps: [depth]\n");
}

TEST(ConfigReader, RefusesNumbersThatAreNone) {
  for (const std::string bad : {"nan", ".inf", "1.0.0", "1e999", "0x10", "''"}) {
    EXPECT_EQ(faults_when("a: " + bad, [](ConfigReader& in) { in.number("a"); }).size(), 1u) << bad;
  }
  for (const std::string good : {"1", "+1.5", "-2e-3", "1.23e5"}) {
    EXPECT_TRUE(faults_when("a: " + good, [](ConfigReader& in) { in.number("a"); }).empty()) << good;
  }
}

TEST(ConfigReader, RefusesListsOfTheWrongLengthAndMapsThatAreNone) {
  const auto faults = faults_when("size: [1, 2, 3]\ngel: 4\nleds: {a: 1}\n", [](ConfigReader& in) {
    in.numbers("size", 2);
    in.section("gel").number("radius");
    in.sections("leds");
  });
  EXPECT_THAT(faults, ElementsAre("gel.yaml:1:7: size: expected a list of 2 numbers, found a list of 3",
                                  "gel.yaml:2:6: gel: expected a map, found a single value",
                                  "gel.yaml:3:7: leds: expected a list of maps, found a map"));
}

TEST(ConfigReader, FindsUnknownKeysInsideListsOfMaps) {
  const auto faults = faults_when("leds:\n  - {index: 1, intesity: 2}\n", [](ConfigReader& in) {
    for (ConfigReader& led : in.sections("leds")) {
      led.integer("index", 0);
      led.number_or("intensity", 1.0);
    }
  });
  EXPECT_THAT(faults, ElementsAre("gel.yaml:2:16: leds[0].intesity: unknown key (did you mean intensity?)"));
}

TEST(ConfigReader, ResolvedHoldsEveryValueInTheOrderReadWithDefaults) {
  ConfigReader in = ConfigReader::from_text("b: 0.1\nlist: [{x: 1}, {x: 2}]\ns: {t: word}\n", "f");
  in.number("b");
  in.number_or("a", 1e-5);
  for (ConfigReader& item : in.sections("list")) item.integer("x", 0);
  in.section("s").text("t");
  in.finish();
  EXPECT_EQ(to_yaml(in.resolved()), "b: 0.1\na: 1.0e-05\nlist:\n  - x: 1\n  - x: 2\ns:\n  t: word\n");
}

}  // namespace config_test
}  // namespace tacipc
