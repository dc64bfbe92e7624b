// `rex curves` as a user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "planning/dubins.h"
#include "planning/reeds_shepp.h"

namespace rex::cli::curves_test {

using ::testing::HasSubstr;

using CurvesCommand = RexCommand;

TEST_F(CurvesCommand, PrintsBothCurves) {
  const ProcessResult result =
      rex({"curves", "--from", "1,2,0.5", "--to", "-1,1,3", "--radius", "2", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.error;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  const Curve dubins = dubinsCurve({1, 2, .5}, {-1, 1, 3}, 2);
  const Curve reedsShepp = reedsSheppCurve({1, 2, .5}, {-1, 1, 3}, 2);
  EXPECT_EQ(json["dubins"]["length"], dubins.length());
  EXPECT_EQ(json["dubins"]["word"], dubins.word());
  EXPECT_EQ(json["reeds_shepp"]["length"], reedsShepp.length());
  ASSERT_EQ(json["reeds_shepp"]["segments"].size(), reedsShepp.segments().size());
  double sum = 0;
  for (const nlohmann::json& segment : json["reeds_shepp"]["segments"])
    sum += std::abs(segment[1].get<double>());
  EXPECT_NEAR(sum, reedsShepp.length(), 1e-12);

  const ProcessResult text = rex({"curves", "--to", "4,0,0"});
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_THAT(text.output, HasSubstr("Dubins          4.000000 m  S        4.0000\n"));
}

TEST_F(CurvesCommand, PrintsNoSegmentsWithoutLength) {
  const std::string none = rex({"curves", "--to", "0,0,0"}).output;
  EXPECT_THAT(none, HasSubstr("Dubins          0.000000 m  -    \n"));
  EXPECT_THAT(none, HasSubstr("Reeds-Shepp     0.000000 m  -    \n"));
  const std::string back = rex({"curves", "--to", "-3,0,0"}).output;
  EXPECT_THAT(back, HasSubstr("Reeds-Shepp     3.000000 m  S       -3.0000\n"));
  EXPECT_EQ(back.find("0.0000 "), std::string::npos) << back;
}

TEST_F(CurvesCommand, HasExamplesThatRun) {
  const auto examples = examplesOf("curves");
  EXPECT_EQ(examples.size(), 2u);
  for (const auto& example : examples) EXPECT_EQ(rex(example).exitCode, 0);
}

TEST_F(CurvesCommand, SaysWhatIsWrong) {
  const ProcessResult few = rex({"curves", "--to", "1,2"}), word = rex({"curves", "--to", "1,2,x"});
  const ProcessResult tight = rex({"curves", "--to", "1,2,3", "--radius", "0"}), none = rex({"curves"});
  for (const ProcessResult& result : {few, word, tight, none}) EXPECT_EQ(result.exitCode, 64) << result.error;
  EXPECT_THAT(few.error, HasSubstr("--to: found 2 numbers, wanted three: x,y,th"));
  EXPECT_THAT(word.error, HasSubstr("'x'"));
  EXPECT_THAT(flat(tight.error),
              HasSubstr("turning radius: found 0 m, wanted a positive, finite number of metres"));
  EXPECT_THAT(none.error, HasSubstr("--to is required"));
}

}  // namespace rex::cli::curves_test
