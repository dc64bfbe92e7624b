#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "authoring/wrong_variants.h"

namespace rex::authoring::joined_variants_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kReference = R"(#include "exercise.h"

struct Half {
  double value;
};

namespace {
double helper(double x) { return x; }
}  // namespace

double turned(double x) { return helper(x); }

// Of two overloads.
[[nodiscard]] double size(const std::vector<double>& x, double scale) {
  // Braces } in text.
  return scale * std::size(x);
}

double size(double x) { return turned(x); }

int main() { std::printf("{%g\n", turned(1)); }
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kReference;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

std::size_t functionsOf(const std::string& variant) {
  return JoinedVariants(kReference, {variant}).functions(0);
}

TEST(JoinedVariants, HoldTheReferenceAndWhatDiffers) {
  const JoinedVariants joined(
      "// A.\nint f(int a) { return f(a); }\nint g() { return 1; }\nint main() {\n  f(1);\n}\n",
      {"// A.\nint f(int a) { return f(-a); }\nint g() { return 1; }\nint main() {\n  f(1);\n}\n",
       "int f(int a) {\n  return 2;\n}\nint g() { return 2; }\nint main() {\n  f(1);\n}\n"});
  EXPECT_EQ(joined.source(), R"(// A.
[[gnu::noipa]] int f(int a) { return f(a); }
int variant_0_f(int a) { return f(-a); }
int variant_1_f(int a) {
  return 2;
}
[[gnu::noipa]] int g() { return 1; }
int variant_1_g() { return 2; }
int main() {}
)");
  EXPECT_EQ(joined.functions(0), 1u);
  EXPECT_EQ(joined.functions(1), 2u);
  const std::vector<std::size_t> owners = {2, 2, 0, 1, 1, 1, 2, 1, 2};
  for (std::size_t line = 1; line <= owners.size(); ++line)
    EXPECT_EQ(joined.variantAt(static_cast<int>(line)), owners[line - 1]) << line;
  EXPECT_EQ(joined.variantAt(0), 2u);
}

TEST(JoinedVariants, TellOverloadsApart) {
  const JoinedVariants joined(kReference,
                              {with("turned(x); }", "2 * turned(x); }"), with("scale *", "scale +")});
  EXPECT_THAT(joined.source(), HasSubstr("[[gnu::noipa]] double size(double x) { return turned(x); }\n"
                                         "double variant_0_size(double x) { return 2 * turned(x); }\n"));
  EXPECT_THAT(joined.source(), HasSubstr("// Of two overloads.\n[[gnu::noipa]] [[nodiscard]] double size("));
  EXPECT_THAT(
      joined.source(),
      HasSubstr("\n[[nodiscard]] double variant_1_size(const std::vector<double>& x, double scale) {\n"
                "  // Braces } in text.\n  return scale + std::size(x);\n}\n"));
}

TEST(JoinedVariants, LeaveOutWhatNoLinkerCanSwap) {
  EXPECT_EQ(functionsOf(with("helper(x); }", "-helper(x); }")), 1u);
  EXPECT_EQ(functionsOf(kReference), 0u);
  EXPECT_EQ(functionsOf(with("double value", "int value")), 0u);
  EXPECT_EQ(functionsOf(with("return x;", "return -x;")), 0u);
  EXPECT_EQ(functionsOf(with("turned(double x)", "turned(float x)")), 0u);
  EXPECT_EQ(functionsOf(with("turned(double x)", "turned(const double x)")), 0u);
  EXPECT_EQ(functionsOf(with("\"exercise.h\"", "<cmath>")), 0u);
  EXPECT_EQ(functionsOf(with("int main() {", "int more() { return 1; }\nint main() {")), 0u);
  EXPECT_EQ(functionsOf(with("turned(1)", "turned(2)")), 0u);
  EXPECT_EQ(JoinedVariants(kReference, {kReference}).source(),
            with(" std::printf(\"{%g\\n\", turned(1)); ", ""));
}

TEST(JoinedVariants, AreSwappedByTheirSymbols) {
  const std::vector<std::string> symbols = {"_Z4sized",
                                            "_Z14variant_2_sized",
                                            "_Z15variant_12_sized",
                                            "_Z4sizeRKSt6vectorIdSaIdEEd",
                                            "_Z14variant_2_sizeRKSt6vectorIdSaIdEEd",
                                            "_Z16variant_2_turnedd",
                                            "_Z14variant_2_sizei",
                                            "_Z10variant_2_",
                                            "main",
                                            "_ZZ14variant_2_sizedE1k"};
  const std::vector<StandIn> found = standIns(symbols, 2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].own, "_Z14variant_2_sized");
  EXPECT_EQ(found[0].replaced, "_Z4sized");
  EXPECT_EQ(found[1].replaced, "_Z4sizeRKSt6vectorIdSaIdEEd");
  EXPECT_THAT(standIns(symbols, 1), IsEmpty());
}

}  // namespace rex::authoring::joined_variants_test
