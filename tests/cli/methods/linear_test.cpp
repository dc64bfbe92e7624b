// `rex linear` as a user meets it.
#include <complex>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "support/needs_gnuplot.h"

namespace rex::cli::linear_test {

using nlohmann::json;
using ::testing::HasSubstr;

class LinearCommand : public RexCommand {
 protected:
  std::string write(const std::string& text) const {
    const std::string file = in("system.json").string();
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(LinearCommand, JudgesTheCartPoleAndDrawsIt) {
  REX_NEEDS_GNUPLOT();
  const json found = json::parse(
      rex({"linear", "data/control/cart-pole-seen.json", "-o", in("figures").string(), "--json"}).output);
  EXPECT_TRUE(found["controllable"]["complete"].get<bool>());
  EXPECT_TRUE(found["observable"]["complete"].get<bool>());
  EXPECT_THAT(found["stability"].get<std::string>(), HasSubstr("unstable"));
  // The same gain as from `rex care`.
  const json care = json::parse(rex({"care", "data/control/cart-pole.json", "--json"}).output);
  EXPECT_EQ(found["regulator"]["K"], care["K"]);
  for (const json& pole : found["filter"]["eigenvalues"]) EXPECT_LT(pole[0].get<double>(), 0);
  ASSERT_EQ(found["files"].size(), 5u);
  for (const json& file : found["files"]) EXPECT_TRUE(std::filesystem::exists(file.get<std::string>()));
  const ProcessResult text = rex({"linear", "data/control/cart-pole-seen.json"});
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_THAT(text.output, HasSubstr("4 states, 1 control, 2 measurements; in continuous time"));
}

TEST_F(LinearCommand, SaysWhatCannotBeSeenOrMoved) {
  // The second state neither reaches y nor is reached by u, and grows.
  const ProcessResult result =
      rex({"linear", write(R"({"A": [[-1, 0], [0, 2]], "B": [[1], [0]], "C": [[1, 0]], "Q": [[1, 0], [0, 1]],
                               "R": [[1]], "W": [[1, 0], [0, 1]], "V": [[1]], "name": "x"})")});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(flat(result.output), HasSubstr("LQR: not stabilizable"));
  EXPECT_THAT(flat(result.output), HasSubstr("Kalman filter: not detectable"));
  EXPECT_THAT(flat(result.output), HasSubstr("LQG: regulator: not stabilizable"));
  EXPECT_THAT(flat(result.error), HasSubstr("not used: name"));
  const json discrete = json::parse(
      rex({"linear", write(R"({"A": [[0.5]], "B": [[1]], "step": 0.1, "Q": [[1]], "R": [[1]]})"), "--json"})
          .output);
  EXPECT_LT(discrete["regulator"]["eigenvalues"][0][0].get<double>(), 0.5);
  EXPECT_EQ(discrete["filter"], nullptr);
}

TEST_F(LinearCommand, RefusesWhatIsNoSystem) {
  const auto complaint = [&](const std::string& text, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"linear", write(text)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = rex(arguments);
    EXPECT_EQ(result.exitCode, 64);
    return flat(result.error);
  };
  EXPECT_THAT(complaint("[]"),
              HasSubstr("found a JSON value of type array, wanted an object with the fields A, B, C, D"));
  EXPECT_THAT(complaint(R"({"A": [[1]], "b": [[1]]})"), HasSubstr("matrix B: found no field with this name"));
  EXPECT_THAT(complaint(R"({"A": [[1]], "B": [[1], [2]]})"),
              HasSubstr("system.json: rows of B: found a vector of size 2"));
  EXPECT_THAT(complaint(R"({"A": [[1]], "B": [[1]], "step": -1})"), HasSubstr("system.json: "));
  EXPECT_THAT(complaint(R"({"A": [[1]], "B": [[1]], "step": "x"})"),
              HasSubstr("step: found a value of type string, wanted a number"));
  EXPECT_THAT(complaint(R"({"A": [[1]], "B": [[1]], "Q": [[1]]})"),
              HasSubstr("matrix R: found no field with this name"));
  EXPECT_THAT(complaint(R"({"A": [[1]], "B": [[1]]})", {"--input", "2"}),
              HasSubstr("--input: found 2, wanted 1 to 1"));
  EXPECT_THAT(complaint(R"({"A": [[1]], "B": [[1]]})", {"--output", "0"}),
              HasSubstr("--output: found 0, wanted 1 to 1"));
}

}  // namespace rex::cli::linear_test
