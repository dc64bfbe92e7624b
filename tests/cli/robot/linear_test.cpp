// `rex linear` as a user meets it.
#include <algorithm>
#include <complex>
#include <fstream>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/rex_command.h"
#include "support/needs_gnuplot.h"
#include "support/paths.h"

namespace rex::cli::linear_test {

using nlohmann::json;
using ::testing::HasSubstr;

class RiccatiCommand : public RexCommand {
 protected:
  std::string write(const std::string& text) const {
    const std::string file = in("problem.json").string();
    std::ofstream(file) << text;
    return file;
  }
};

Eigen::MatrixXd matrixOf(const json& rows) {
  Eigen::MatrixXd M(rows.size(), rows[0].size());
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index k = 0; k < M.cols(); ++k)
      M(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)].get<double>();
  return M;
}

// Each real problem as closely as the bar of the file, the complex ones refused.
TEST_F(RiccatiCommand, AgreesWithTheGoldenNumbers) {
  std::ifstream stream(sourcePath("tests/golden/riccati.json"));
  const json golden = json::parse(stream);
  int real = 0, complex = 0;
  for (const char* kind : {"care", "dare"}) {
    for (const json& one : golden[kind]) {
      json problem = one;
      if (std::string(kind) == "dare") problem["step"] = 1;
      const ProcessResult result = rex({"linear", write(problem.dump()), "--json"});
      if (!one["A"].is_array() || !one["B"].is_array()) {
        ++complex;
        EXPECT_EQ(result.exitCode, 64);
        EXPECT_THAT(flat(result.error), HasSubstr("found complex entries, wanted real ones"));
        continue;
      }
      ++real;
      ASSERT_EQ(result.exitCode, 0) << one["id"] << result.error;
      const json answer = json::parse(result.output)["regulator"];
      const Eigen::MatrixXd X = matrixOf(one["X"]);
      const double bar = std::max(1e-13, 10 * one["scipy_relerr"].get<double>());
      EXPECT_LE((matrixOf(answer["X"]) - X).norm(), bar * X.norm()) << one["id"];
      EXPECT_EQ(answer["eigenvalues"].size(), one["n"].get<std::size_t>());
      EXPECT_LT(answer["residual"].get<double>(), 1e-12);
      EXPECT_EQ(answer["mode"], nullptr);
    }
  }
  EXPECT_EQ(real, 19);
  EXPECT_EQ(complex, 2);
}

TEST_F(RiccatiCommand, TellsWhatItDoesNotUse) {
  const char* const text = R"({"A": [[1]], "B": [[1]], "Q": [[1]], "R": [[1]], "S": [[2]], "name": "one"})";
  const ProcessResult result = rex({"linear", write(text)});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(flat(result.error), HasSubstr("not used: S, name"));
}

TEST_F(RiccatiCommand, HasExamplesThatRun) {
  const json care = json::parse(rex({"linear", "data/control/cart-pole.json", "--json"}).output)["regulator"];
  EXPECT_EQ(care["status"], "solved");
  // Erratum 32: the gains of the correct linearisation, with the sign of slide 8:18.
  const double wanted[] = {-1.0000, -2.6088, -52.9484, -16.5952};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(care["K"][0][i].get<double>(), wanted[i], 1e-4);
  const ProcessResult text = rex({"linear", "data/control/cart-steps.json"});
  EXPECT_EQ(text.exitCode, 0) << text.error;
  EXPECT_THAT(text.output, HasSubstr("in steps of 0.02 s"));
  EXPECT_THAT(text.output, HasSubstr("LQR: solved: relative residual"));
  EXPECT_THAT(text.output, HasSubstr("\nX =\n"));
}

TEST_F(RiccatiCommand, SaysWhichModeIsInTheWay) {
  const ProcessResult unreachable =
      rex({"linear", write(R"({"A": [[1, 0], [0, -1]], "B": [[0], [1]], "Q": [[1, 0], [0, 1]], "R": [[1]]})"),
           "--json"});
  EXPECT_EQ(unreachable.exitCode, 1);
  const json answer = json::parse(unreachable.output)["regulator"];
  EXPECT_EQ(answer["X"], nullptr);
  EXPECT_EQ(answer["residual"], nullptr);
  EXPECT_EQ(answer["status"], "not stabilizable");
  EXPECT_EQ(answer["mode"], json::parse("[1.0, 0.0]"));
  EXPECT_THAT(answer["message"].get<std::string>(),
              HasSubstr("the control cannot reach the mode of eigenvalue 1"));
  const ProcessResult unseen = rex(
      {"linear", write(R"({"A": [[0, 2], [-2, 0]], "B": [[0], [1]], "Q": [[0, 0], [0, 0]], "R": [[1]]})")});
  EXPECT_EQ(unseen.exitCode, 1);
  EXPECT_THAT(unseen.output, HasSubstr("not detectable: the cost does not see the mode of eigenvalue 0"));
  const ProcessResult stopped =
      rex({"linear", write(R"({"A": [[1]], "B": [[1]], "Q": [[0]], "R": [[1]]})"), "--json"});
  EXPECT_EQ(stopped.exitCode, 0);
  EXPECT_EQ(json::parse(stopped.output)["regulator"]["mode"], json::parse("[1.0, 0.0]"));
  const ProcessResult axis = rex({"linear", write(R"({"A": [[1]], "B": [[1]], "Q": [[-100]], "R": [[1]]})")});
  EXPECT_EQ(axis.exitCode, 1);
  EXPECT_THAT(axis.output, HasSubstr("on the imaginary axis"));
}

TEST_F(RiccatiCommand, SaysWhatIsWrong) {
  const auto expect = [&](const std::string& text, const char* message) {
    const ProcessResult result = rex({"linear", write(text)});
    EXPECT_EQ(result.exitCode, 64) << result.output;
    EXPECT_THAT(flat(result.error), HasSubstr(message));
  };
  const auto problem = [](const char* A, const char* B, const char* Q, const char* R) {
    return std::string(R"({"A": )") + A + R"(, "B": )" + B + R"(, "Q": )" + Q + R"(, "R": )" + R + "}";
  };
  EXPECT_EQ(rex({"linear"}).exitCode, 64);
  EXPECT_THAT(flat(rex({"linear", "none.json"}).error), HasSubstr("none.json: cannot read this file"));
  expect("{\"A\": [[1]],\n \"B\": [[1],\n}",
         "problem.json:3:1: not valid JSON: wanted an object with the fields A, B,");
  expect("{\"A\": [[nan]]}", "problem.json:1:10: not valid JSON");
  expect("", "problem.json:1:1: not valid JSON");
  expect("[1]", "matrices: found a JSON value of type array");
  expect("{\"A\": [[1]]}", "matrix B: found no field with this name, wanted a list of rows");
  expect("{\"a\": [[1]]}", "no field with this name, wanted a list of rows (did you mean 'a'?)");
  expect(problem("5", "[[1]]", "[[1]]", "[[1]]"), "matrix A: found no list of rows");
  expect(problem("[[1, 2], [3]]", "[[1]]", "[[1]]", "[[1]]"),
         "matrix A, row 2: found 1 numbers, wanted 2 numbers, as in row 1");
  expect(problem("[[1, 2], 3]", "[[1]]", "[[1]]", "[[1]]"), "matrix A, row 2: found no list of numbers");
  expect(problem("[[1, null], [3, 4]]", "[[1]]", "[[1]]", "[[1]]"),
         "matrix A, row 1, column 2: found null, wanted a number");
  expect(problem("[[\"1\"]]", "[[1]]", "[[1]]", "[[1]]"), "found a value of type string, wanted a number");
  expect(problem("[[1, 2]]", "[[1]]", "[[1]]", "[[1]]"),
         "columns of A: found a vector of size 2, wanted size 1");
  expect(problem("[[1]]", "[[1]]", "[[1]]", "[[0]]"),
         "matrix R: found the eigenvalue 0, wanted a positive definite matrix");
  expect(problem("[[1]]", "[[1]]", "[[1]]", "[[-1]], \"step\": 1"),
         "matrix R: found the eigenvalue -1, wanted no negative");
  expect(problem("[[1e999]]", "[[1]]", "[[1]]", "[[1]]"),
         "problem.json: JSON: found a number that is too large");
}

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
  // The same gain as without measurements.
  const json alone = json::parse(rex({"linear", "data/control/cart-pole.json", "--json"}).output);
  EXPECT_EQ(found["regulator"]["K"], alone["regulator"]["K"]);
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
              HasSubstr("--output: found 0, wanted 1 to "));
}

}  // namespace rex::cli::linear_test
