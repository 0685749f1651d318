// JSON text: escapes and numbers.
#include <gtest/gtest.h>

#include <limits>

#include "common/base/json.h"

namespace tacipc {
namespace json_test {

TEST(Json, ListsOfNumbersStandOnALineAndMapsDoNot) {
  const Value value = Value::Map{{"n", 1},
                                 {"x", 0.1},
                                 {"ok", true},
                                 {"rows", Value::List{Value::List{1, 2}, Value::List{3, 4}}},
                                 {"items", Value::List{Value::Map{{"a", "b"}}}},
                                 {"none", Value::Map{}}};
  EXPECT_EQ(to_json(value),
            "{\n  \"n\": 1,\n  \"x\": 0.1,\n  \"ok\": true,\n  \"rows\": [[1, 2], [3, 4]],\n  \"items\": [\n    {\n"
            "      \"a\": \"b\"\n    }\n  ],\n  \"none\": {}\n}\n");
}

TEST(Json, EscapesAndHasNoInfinity) {
  EXPECT_EQ(to_json(Value("a\"b\\c\nd\x01")), "\"a\\\"b\\\\c\\u000ad\\u0001\"\n");
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(to_json(Value(Value::List{inf, nan, 1e-9})), "[null, null, 1e-09]\n");
}

TEST(Json, DoublesAreNeverWrittenAsWholeNumbers) {
  EXPECT_EQ(to_json(Value(Value::List{0.0, -0.0, 3.0, -12.0, 1e22, 5e-324, 0.5})),
            "[0.0, -0.0, 3.0, -12.0, 1e+22, 5e-324, 0.5]\n");
  EXPECT_EQ(to_json(Value(Value::List{0, std::int64_t{1} << 62, std::size_t{7}})), "[0, 4611686018427387904, 7]\n");
}

}  // namespace json_test
}  // namespace tacipc
