#include "authoring/shown_code.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::authoring::shown_code_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// "name(type name, ...) -> result" of each.
std::vector<std::string> written(const std::vector<ShownCode>& all) {
  std::vector<std::string> texts;
  for (const ShownCode& code : all) {
    std::string text = code.name + "(";
    for (const ShownParameter& parameter : code.parameters)
      text += parameter.type + " " + parameter.name + (parameter.isOptional ? "?" : "") +
              (parameter.isMutable ? "&" : "") + ",";
    texts.push_back(text + ") -> " + code.result);
  }
  return texts;
}

TEST(ShownCode, KnowsFunctionsByTheirTypes) {
  EXPECT_THAT(written(functionsIn(R"(
#include <vector>
namespace rex::maps {
/// f(int) is not meant.
[[nodiscard]] inline double at(const std::vector<Eigen::Vector2d>& points, std::size_t k = 0);
[[nodiscard]] inline double at(const std::vector<Eigen::Vector2d>& points, std::size_t k = 0) { return k; }
static constexpr int twice(int a) { return 2 * a; }
namespace {
Eigen::VectorXd sum(const Eigen::Ref<const Eigen::VectorXd>& a, rex::Rng& rng) { return a + rng.normal(); }
}
template <class T> T any(T a) { return a; }
struct Box { double size() const { return 1; } };
}
int main() { return twice(1); }
)")),
              ElementsAre("at(vector<Vector2d> points,size_t k?,) -> double", "twice(int a,) -> int",
                          "sum(VectorXd a,Rng rng&,) -> VectorXd"));
}

TEST(ShownCode, KnowsLambdasAndUnknownResults) {
  const std::vector<ShownCode> all = functionsIn(R"(
auto twice(double x) { return 2 * x; }
double sum(double a) {
  const auto half = [](const Eigen::Vector2d& p, int k) { return p / k; };
  const auto mine = [&](int k) { return a / k; };
  const double list[] = {1, 2};
  return half({1, 2}, 2).norm() + list[0] + mine(2);
}
)");
  EXPECT_THAT(written(all),
              ElementsAre("twice(double x,) -> ", "sum(double a,) -> double", "half(Vector2d p,int k,) -> "));
  EXPECT_EQ(all[0].lambda, "[&](double x) { return 2 * x; }");
  EXPECT_EQ(all[2].lambda, "[&](const Eigen::Vector2d& p, int k) { return p / k; }");
  EXPECT_TRUE(all[2].isLambda && !all[0].isLambda);
}

TEST(ShownCode, KnowsExpressionsOfSeveralLines) {
  const std::vector<ShownCode> all = longExpressionsIn(R"(
const Eigen::Vector3d kHome = Eigen::Vector3d(1, 2,
                                              3);
Eigen::Vector2d turned(const Eigen::Vector2d& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double length = p.norm();
  const auto half = [&](double x) {
    return x /
           2;
  };
  const double all = length *
                     half(angle);
  if (length > 1) return Eigen::Vector2d(c,
                                         s);
  return length * p +
         kHome.head<2>();
}
)");
  EXPECT_THAT(written(all),
              ElementsAre("() -> Vector3d", "(double x,) -> ", "(double length,double angle,) -> double",
                          "(double length,Vector2d p,) -> Vector2d"))
      << "the types of c and s are not beside them";
  EXPECT_EQ(all[2].text, "length *\n                     half(angle)");
}

TEST(ShownCode, KeepsWhatIsNeeded) {
  const std::string source = R"(#include "a.h"
namespace {
inline constexpr double kHalf = .5;
double unused(double x) { return x; }
double half(double x) { return kHalf * x; }
}
namespace shown {
double quarter(double x) { return half(half(x)); }
}
int main() { return 0; }
)";
  const std::vector<ShownCode> all = functionsIn(source);
  const std::string part = neededPart(source, {all.back()});
  EXPECT_THAT(part, HasSubstr("inline constexpr double kHalf = .5;"));
  EXPECT_THAT(part, HasSubstr("double half(double x)"));
  EXPECT_THAT(part, HasSubstr("double quarter(double x)"));
  for (const char* other : {"unused", "main", "include", "namespace shown"})
    EXPECT_THAT(part, Not(HasSubstr(other)));
  EXPECT_THAT(written(functionsIn(part)),
              ElementsAre("half(double x,) -> double", "quarter(double x,) -> double"));
}

TEST(ShownCode, FitsByTypes) {
  for (const auto& [type, wanted] : std::vector<std::pair<const char*, const char*>>{{"int", "double"},
                                                                                     {"size_t", "Index"},
                                                                                     {"Vector3d", "VectorXd"},
                                                                                     {"MatrixXd", "Matrix4d"},
                                                                                     {"Chain", "Chain"}})
    EXPECT_TRUE(fits(type, wanted)) << type << " " << wanted;
  for (const auto& [type, wanted] : std::vector<std::pair<const char*, const char*>>{{"bool", "double"},
                                                                                     {"Vector3d", "Vector2d"},
                                                                                     {"Vector3d", "Matrix3d"},
                                                                                     {"Pose", "Matrix4d"},
                                                                                     {"", ""}})
    EXPECT_FALSE(fits(type, wanted)) << type << " " << wanted;
}

TEST(ShownCode, ReadsTextThatIsNotCpp) {
  for (const char* text :
       {"", "}}}} ( {", "return\n", "= \n;", "double f(", "double f(int a = {, b) { return\n a; }"})
    EXPECT_NO_THROW(
        static_cast<void>(neededPart(text, functionsIn(text)).size() + longExpressionsIn(text).size()))
        << text;
  EXPECT_THAT(functionsIn("double f(int)"), IsEmpty());
}

}  // namespace rex::authoring::shown_code_test
