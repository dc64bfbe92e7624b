#include "authoring/mutants.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::authoring::mutants_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string solutionWith(const std::string& lines) {
  return "double f(int n, double a) {\n  // <solution f>\n" + lines +
         "\n  // <todo>\n  //| return 1 + 2;\n  // </solution>\n}\n";
}

/// What the changes of one kind make of lines in a region.
std::vector<std::string> after(const std::string& kind, const std::string& lines) {
  std::vector<std::string> texts;
  for (const Mutant& mutant : mutantsOf(solutionWith(lines), "solution.cpp"))
    if (mutant.change == kind) texts.push_back(mutant.after);
  return texts;
}

/// A kind of change, lines, and what it makes of them.
struct Row {
  const char* kind;
  const char* lines;
  std::vector<std::string> after;
};

const std::vector<Row> kRows = {
    {"sign", "return -a * (-n);", {"return a * (-n);", "return -a * (n);"}},
    {"sign", "return a - n;", {"return -(a - n);"}},
    {"sign", "return a < n;", {}},
    {"plus and minus",
     "a += b + c - -d; p->x;",
     {"a -= b + c - -d; p->x;", "a += b - c - -d; p->x;", "a += b + c + -d; p->x;"}},
    {"times and over",
     "a *= b * c / *d; double* e;",
     {"a /= b * c / *d; double* e;", "a *= b / c / *d; double* e;", "a *= b * c * *d; double* e;"}},
    {"comparison",
     "return a < b == std::vector<int>(c) >= d;",
     {"return a <= b == std::vector<int>(c) >= d;", "return a < b != std::vector<int>(c) >= d;",
      "return a < b == std::vector<int>(c) > d;"}},
    {"index by one",
     "a[n] = b(0, 3) + c.head<2>()[1] + 1.5;",
     {"a[n + 1] = b(0, 3) + c.head<2>()[1] + 1.5;", "a[n] = b(1, 3) + c.head<2>()[1] + 1.5;",
      "a[n] = b(0, 4) + c.head<2>()[1] + 1.5;", "a[n] = b(0, 3) + c.head<2>()[2] + 1.5;"}},
    {"index by one", "const auto g = [n](int k) { return k; };", {}},
    {"previous for next",
     "a[n + 1] = path.back();",
     {"a[n + 1 - 1] = path.back();", "a[n + 1] = path.front();"}},
    {"x and y",
     "a = p.x() * p.z + x * V::UnitX();",
     {"a = p.y() * p.z + x * V::UnitX();", "a = p.x() * p.y + x * V::UnitX();",
      "a = p.x() * p.z + x * V::UnitY();"}},
    {"sine and cosine", "a = std::sin(b) + single;", {"a = std::cos(b) + single;"}},
    {"row and column", "a = b.row(n) / c.cols();", {"a = b.col(n) / c.cols();", "a = b.row(n) / c.rows();"}},
    {"transpose or inverse dropped",
     "a = b.transpose() * c.inverse() * inverse(d) * transpose;",
     {"a = b * c.inverse() * inverse(d) * transpose;", "a = b.transpose() * c * inverse(d) * transpose;",
      "a = b.transpose() * c.inverse() * (d) * transpose;"}},
    {"factor of two",
     "a = 2 * b / 2. + f(2, 0.5) * .5;",
     {"a = 1 * b / 2. + f(2, 0.5) * .5;", "a = 2 * b / 1. + f(2, 0.5) * .5;",
      "a = 2 * b / 2. + f(2, 0.5) * 1.;"}},
    {"least and most",
     "a = std::min(b, c.maxCoeff());",
     {"a = std::max(b, c.maxCoeff());", "a = std::min(b, c.minCoeff());"}},
    {"swapped arguments",
     "a = f(b.c[0], -d, g(e, e), h) + V{x, 1};",
     {"a = f(-d, b.c[0], g(e, e), h) + V{x, 1};", "a = f(b.c[0], -d, g(e, e), h) + V{1, x};"}},
    {"swapped arguments", "const auto g = [](int i, int k) { return 0; };", {}},
    {"statement dropped", "const int k = f(1);\nV<int> v(k), w;\nA& b = c;", {}},
    {"statement dropped",
     "if (f(a)) a = 1;\nfor (int t = 1; t < n; ++t) break;",
     {"if (f(a)) ;", "for (int t = 1; t < n; ++t) ;"}},
    {"statement dropped", "(n ? a : b) += 1;\nstd::f([] { return 1; });\n++n;", {";", ";", ";"}},
    {"condition negated",
     "if (a && f(b)) c = n ? true : d;",
     {"if (!(a && f(b))) c = n ? true : d;", "if (a || f(b)) c = n ? true : d;",
      "if (a && f(b)) c = n ? d : true;", "if (a && f(b)) c = n ? false : d;"}},
    {"condition negated",
     "a = f(b ? c ? 1 : 2 : d, 3);",
     {"a = f(b ? d : c ? 1 : 2, 3);", "a = f(b ? c ? 2 : 1 : d, 3);"}},
    {"degrees",
     "a = std::sin(b + c) + atan2(d, e);",
     {"a = std::sin(0.0174533 * (b + c)) + atan2(d, e);", "a = std::sin(b + c) + atan2(d, e) * 57.2958;"}},
    {"integer division",
     "a = 1. / n + n / 20. + a / 2. + 1.5 / n;",
     {"a = 1 / n + n / 20. + a / 2. + 1.5 / n;", "a = 1. / n + n / 20 + a / 2. + 1.5 / n;"}},
    {"integer division",
     "a = static_cast<double>(b) / n + static_cast<double>(n) * a;",
     {"a = (b) / n + static_cast<double>(n) * a;"}},
    {"constant by a tenth",
     "a = 20. + 1e-9 + 0.0 + 3 + 0.25;",
     {"a = 22. + 1e-9 + 0.0 + 3 + 0.25;", "a = 20. + 1e-9 + 0.1 + 3 + 0.25;",
      "a = 20. + 1e-9 + 0.0 + 3 + 0.275;"}},
};

TEST(Mutants, ChangeWhatTheirKindSays) {
  for (const Row& row : kRows)
    EXPECT_EQ(after(row.kind, row.lines), row.after) << row.kind << ": " << row.lines;
}

TEST(Mutants, OfEachKindAreTested) {
  std::set<std::string> tested;
  for (const Row& row : kRows)
    if (!row.after.empty()) tested.insert(row.kind);
  const std::vector<std::string> all = kindsOfChanges();
  EXPECT_EQ(tested, std::set<std::string>(all.begin(), all.end()));
}

constexpr const char* kSolution = R"(#include <cmath>
namespace {
// <solution helper>
constexpr double kHalf = .5;
double helper(double x, double y) { return std::pow(x, y); }
// <todo>
// </solution>
}  // namespace
template <class T> T any(T a) {
  // <solution any>
  return a + 1;
  // <todo>
  // </solution>
}
double f(double a) {
  const double b = a + 1;
  // <solution f>
  // One + one.
  return helper(a,
                -b);  // the power
  // <todo>
  //| return 1 + 1;
  // </solution>
}
int main() { return 1 + 1; }
)";

TEST(Mutants, AreInRegionsOfPlainFunctionsOnly) {
  const std::vector<Mutant> all = mutantsOf(kSolution, "solution.cpp");
  std::vector<std::string> places;
  for (const Mutant& m : all) places.push_back(m.function + ":" + std::to_string(m.line) + " " + m.change);
  EXPECT_THAT(places, ElementsAre("helper:5 sign", "helper:5 swapped arguments", "f:19 sign",
                                  "f:19 swapped arguments", "f:20 sign"));
  EXPECT_EQ(all[3].before, "return helper(a, -b); // the power");
  EXPECT_EQ(all[3].after, "return helper(-b, a); // the power");
  EXPECT_EQ(all[3].column, 17);
  EXPECT_THAT(mutated(kSolution, all[4]), HasSubstr("helper(a,\n                b);"));
}

TEST(Mutants, NeedFunctionsThatOtherFilesMayCall) {
  const std::string open = withoutUnnamedNamespaces(kSolution);
  EXPECT_THAT(open, HasSubstr("<cmath>\n           \n// <solution helper>"));
  EXPECT_THAT(open, HasSubstr("\n   // namespace\n"));
  EXPECT_EQ(open.size(), std::string(kSolution).size());
  EXPECT_EQ(withoutUnnamedNamespaces("namespace rex {\n}\n"), "namespace rex {\n}\n");
}

TEST(Mutants, ReadTextThatIsNotCpp) {
  for (const char* text : {"}}}} ( {", "return", "a ? b", "a[", "if (", "x ? : ;", "f(a, ", "-",
                           "static_cast<", ") + ] ; a ? b : c", "V<int", "inverse("})
    EXPECT_NO_THROW(static_cast<void>(mutantsOf(solutionWith(text), "solution.cpp"))) << text;
  EXPECT_THAT(mutantsOf("", "solution.cpp"), IsEmpty());
}

}  // namespace rex::authoring::mutants_test
