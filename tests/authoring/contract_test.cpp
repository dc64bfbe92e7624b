// The declarations of an exercise.h, as `rex dev new` reads them.
#include "authoring/contract.h"

#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "authoring/new_exercise.h"
#include "base/text.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::authoring::contract_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

const std::string kCourse = "#include \"course/course.h\"\n";

TEST(Contract, HasPartsAndFunctionsWithTheirComments) {
  const Contract contract =
      readContract(fileText(sourcePath("tests/authoring/made/exercise.h")), "exercise.h");
  EXPECT_THAT(contract.parts, ElementsAre("turning", "poses"));
  ASSERT_EQ(contract.functions.size(), 5u);
  const ContractFunction& turned = contract.functions[0];
  EXPECT_EQ(turned.name, "turned");
  EXPECT_EQ(turned.result, "Eigen::Vector2d");
  EXPECT_EQ(
      turned.comment,
      "The point p [m] turned about the origin by `angle` [rad], counter-clockwise: the x axis turned by a "
      "quarter is the y axis.");
  ASSERT_EQ(turned.parameters.size(), 2u);
  EXPECT_EQ(turned.parameters[0].type, "const Eigen::Vector2d&");
  EXPECT_EQ(turned.parameters[0].name, "p");
  const ContractFunction& angles = contract.functions[1];
  EXPECT_EQ(angles.comment, turned.comment) << "it follows without a blank line";
  EXPECT_EQ(angles.parameters[1].name, "count") << "without the default";
  EXPECT_EQ(contract.functions[4].result, "std::vector<Eigen::VectorXd>") << "without the attribute";
  EXPECT_EQ(contract.functions[2].part, 0);
  EXPECT_EQ(contract.functions[3].part, 1);
}

TEST(Contract, MakesEachFunctionAPartWithoutHeadings) {
  const Contract contract = readContract(
      kCourse + "/// A.\ndouble handSpeed();\n/// B.\nstd::function<double(double, int)> law(double gain);\n",
      "exercise.h");
  EXPECT_THAT(contract.parts, ElementsAre("hand speed", "law"));
  EXPECT_EQ(contract.functions[1].result, "std::function<double(double, int)>");
  EXPECT_EQ(contract.functions[1].part, 1);
}

TEST(Contract, SaysWhatItCannotReadAndWhatItWouldRead) {
  const std::string plain = "a function such as `double area(double width, double height);`";
  const std::vector<std::pair<std::string, std::string>> table = {
      {"", "x.h: no function: wanted " + plain},
      {"namespace mine {\nint f();\n}\n", "x.h:2:1: cannot read this: found 'namespace mine ', wanted " +
                                              plain +
                                              ", a type, or an inline function that students are given"},
      {"template <class T>\nT f(T x);\n", "x.h:2:1: cannot read this: found 'template <class T>', wanted"},
      {"\nextern int count;\n", "x.h:3:1: cannot read this: found 'extern int count;', wanted"},
      {"/// A.\ndouble f(int k) { return k; }\n",
       "x.h:3:8: 'f' has a body: wanted a ';' behind its parameters, or the word inline before it"},
      {"double f(int k);\n",
       "x.h:2:8: 'f' has no comment: wanted lines with /// above it that say what it "
       "returns, with shapes, units and frames"},
      {"/// A.\n\ndouble f(int k);\n", "x.h:4:8: 'f' has no comment"},
      {"/// A.\nvoid f(int k);\n",
       "x.h:3:1: the value of f: found 'void', wanted the type of a value: only that comes back from a "
       "student's "
       "function"},
      {"/// A.\nauto f(int k);\n", "x.h:3:1: the value of f: found 'auto'"},
      {"/// A.\ndouble f(int, const Eigen::Vector2d&);\n",
       "x.h:3:10: a parameter of f without a name: found 'int', wanted a type and a name"},
      {"/// A.\ndouble f(Eigen::Vector2d);\n", "x.h:3:10: a parameter of f without a name"},
      {"/// A.\ndouble f(const double* numbers);\n",
       "x.h:3:22: numbers of f: found 'const double*', wanted no pointer, but a value such as std::vector or "
       "std::optional"},
      {"/// A.\nstd::map<int, int> f();\n",
       "x.h:3:6: the value of f: found 'std::map', wanted std::vector, array, pair, optional, string or "
       "function, "
       "or a struct of such values"},
      {"/// A.\ndouble f(Eigen::VectorXd& x);\n",
       "x.h:3:10: x of f: found 'Eigen::VectorXd&', wanted 'const Eigen::VectorXd&': changes to an argument "
       "are "
       "lost"},
      {"/// A.\ndouble f(int k);\n/// B.\ndouble f(double x);\n",
       "x.h:5:8: a second function 'f': wanted another name: a check calls functions by name"},
      {"// Part 2, turning.\n/// A.\ndouble f(int k);\n",
       "x.h:2:1: the heading of a part: found '// Part 2, turning.', wanted '// Part 1, TITLE.'"},
      {"// Part 1.\n", "x.h:2:1: the heading of a part: found '// Part 1.', wanted '// Part 1, TITLE.'"},
      {"/// A.\ndouble f(int k);\n// Part 1, turning.\n",
       "x.h:3:1: 'f' is in no part: wanted '// Part 1, TITLE.' before it, or no such line at all"}};
  for (const auto& [text, message] : table) EXPECT_REX_ERROR(readContract(kCourse + text, "x.h"), message);
  EXPECT_REX_ERROR(readContract("/// A.\ndouble f(int k);\n", "x.h"),
                   "x.h: no line `#include \"course/course.h\"`: wanted this line before the functions");
}

bool isInline(const std::string& header, const std::string& function) {
  for (const std::string_view line : splitLines(header))
    if (line.starts_with("inline") && line.substr(0, line.find_first_of("(;")).ends_with(" " + function))
      return true;
  return false;
}

// Their lines in exercises/CMakeLists.txt were written by hand. Checks also call some inline functions.
TEST(Contract, ReadsTheHeadersOfTheCourse) {
  const std::string lines = fileText(sourcePath("exercises/CMakeLists.txt"));
  int read = 0;
  for (const auto& entry : fs::directory_iterator(sourcePath("exercises"))) {
    if (!entry.is_directory()) continue;
    const std::string name = entry.path().filename(), header = fileText(entry.path() / "exercise.h");
    if (header.find("// Parts ") != header.npos) continue;  // several parts with one heading
    std::string line = lines.substr(lines.find("rex_exercise(" + name));
    line = line.substr(0, line.find(')'));
    std::string wanted = "rex_exercise(" + name + " FUNCTIONS";
    std::istringstream words(line.substr(line.find("FUNCTIONS") + 9));
    for (std::string word; words >> word;)
      if (!isInline(header, word)) wanted += ' ' + word;
    EXPECT_EQ(buildLine({{"exercise.h", header}}, name), wanted + ")\n");
    ++read;
  }
  EXPECT_GE(read, 18);
}

}  // namespace rex::authoring::contract_test
