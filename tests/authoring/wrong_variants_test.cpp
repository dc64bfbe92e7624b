#include "authoring/wrong_variants.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/text.h"
#include "support/file_text.h"
#include "support/template_exercise.h"

namespace rex::authoring::wrong_variants_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// The solution of the template includes what a variant calls.
class WrongVariantsTest : public TemplateExercise {
 protected:
  void SetUp() override {
    fs::remove(exercise() / "seen.txt");
    const std::string wrong = fileText(exercise() / "wrong.cpp");
    std::string description = fileText(exercise() / "exercise.toml");
    description.replace(description.find("\"private\""), 9, "\"public\"");
    write("exercise.toml", description);
    write("wrong.cpp", wrong.substr(0, wrong.find("// <variant library>")));
    write("solution.cpp", "#include \"geometry/rotation.h\"\n" + fileText(exercise() / "solution.cpp"));
    writeVariant("library", "caught by: forbidden-call", kByLibrary);
  }

  void writeVariant(const std::string& name, const std::string& header, const std::string& body) const {
    std::ofstream(exercise() / "wrong.cpp", std::ios::app) << "\n// <variant " + name + ">\n// " + header +
                                                                  "\n// mistake: " + name +
                                                                  ".\n// <solution rotated>\n" + body;
  }

  static constexpr const char* kByLibrary =
      "return rex::rotationAboutAxis(angle, Eigen::Vector3d::UnitZ()).topLeftCorner<2, 2>() * p;\n";
};

TEST_F(WrongVariantsTest, AreCaughtTogetherAndTheirMessagesStoredIfAsked) {
  writeVariant("doubled", "caught by: quarter-turn, keeps-length\n// shown by: quarter-turn",
               "return 2 * std::cos(angle) * p;\n");
  const GateResult result = pass("wrong", /*storesMessages=*/true);
  EXPECT_TRUE(result.passed) << result.message;
  EXPECT_EQ(result.note, "");
  EXPECT_THAT(fileText(exercise() / "seen.txt"), HasSubstr("doubled\n    quarter-turn: point"));
}

// The questions stand in wrong.cpp, and what is stored for students holds nothing else of it, and nothing of
// hidden checks.
TEST_F(WrongVariantsTest, AreRecognisedByTheirAnswers) {
  const fs::path file = exercise() / "sketches.tsv";
  writeVariant("doubled", "caught by: quarter-turn\n// ask: Is it twice as far?",
               "return 2 * std::cos(angle) * p;\n");
  writeVariant("stretched", "caught by: quarter-turn\n// ask: Is the point moved away?",
               "const double c = std::cos(angle), s = std::sin(angle);\n"
               "return 1.5 * Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y());\n");
  EXPECT_THAT(pass("wrong").message, HasSubstr("sketches.tsv does not describe wrong.cpp: it is missing."));
  const GateResult stored = pass("wrong", /*storesMessages=*/true);
  EXPECT_TRUE(stored.passed) << stored.message;
  EXPECT_EQ(stored.note, "recognised by their answers: 2");
  const std::string seen = fileText(exercise() / "seen.txt"), sketches = fileText(file);
  EXPECT_THAT(seen, AllOf(HasSubstr(". Is it twice as far?\n"), HasSubstr(". Is the point moved away?\n")));
  EXPECT_THAT(sketches,
              AllOf(HasSubstr("mistake\tIs it twice as far?\n"), HasSubstr("check\tquarter-turn\n")));
  for (const char* secret : {"angles-add", "doubled", "stretched", "std::", "return"})
    EXPECT_THAT(sketches, Not(HasSubstr(secret)));
  EXPECT_TRUE(pass("wrong").passed);
  EXPECT_TRUE(pass("wrong", /*storesMessages=*/false, {"doubled"}).passed);
  EXPECT_TRUE(pass("release").passed);
  pass("wrong", /*storesMessages=*/true);
  EXPECT_EQ(fileText(file), sketches) << "the same each time";
}

TEST_F(WrongVariantsTest, AreStoredAsTheyAre) {
  const fs::path file = exercise() / "sketches.tsv";
  writeVariant("doubled", "caught by: quarter-turn\n// ask: Is it twice as far?",
               "return 2 * std::cos(angle) * p;\n");
  pass("wrong", /*storesMessages=*/true);
  const std::string wrong = fileText(exercise() / "wrong.cpp");
  std::string other = wrong;
  other.replace(other.find("return 2 *"), 10, "return 3 *");
  write("wrong.cpp", other);
  EXPECT_THAT(
      pass("wrong").message,
      AllOf(HasSubstr("sketches.tsv does not describe wrong.cpp: check 'keeps-length': other answers of "
                      "rotated. Make it with REX_UPDATE_GOLDEN=1."),
            HasSubstr("doubled: nobody who makes this mistake is asked: Is it twice as far? They read: "
                      "quarter-turn: point")));
  other.erase(other.find("// ask:"), other.find("// mistake: doubled") - other.find("// ask:"));
  write("wrong.cpp", other);
  EXPECT_THAT(pass("wrong").message,
              HasSubstr("sketches.tsv does not describe wrong.cpp: no variant has a question."));
  pass("wrong", /*storesMessages=*/true);
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(WrongVariantsTest, AreReadAsTheFileSays) {
  write("seen.txt", "clockwise\n    quarter-turn: something else\n");
  EXPECT_THAT(pass("wrong").message, AllOf(HasSubstr("clockwise: a student reads: quarter-turn: point"),
                                           HasSubstr("library: seen.txt does not say")));
  write("seen.txt", "clockwise\n    quarter-turn: point: got 1 m, wanted 1 m, off by 1e-17 m (seed 1)\n");
  EXPECT_EQ(pass("evidence").message,
            "clockwise: got and wanted are printed alike: quarter-turn: point: got 1 m, wanted 1 m, off by "
            "1e-17 m (seed 1)");
  fs::remove(exercise() / "seen.txt");
  EXPECT_THAT(pass("evidence").message, HasSubstr("seen.txt is missing"));
}

// The others are neither compiled nor compared with what the file says of them.
TEST_F(WrongVariantsTest, AreTestedOneByOneIfAsked) {
  writeVariant("a_typo", "caught by: quarter-turn", "return angel * p;\n");
  EXPECT_TRUE(pass("wrong", /*storesMessages=*/true, {"clockwise"}).passed);
  EXPECT_THAT(fileText(exercise() / "seen.txt"), StartsWith("clockwise\n    quarter-turn: point"));
  EXPECT_TRUE(pass("wrong", /*storesMessages=*/true, {"library"}).passed);
  EXPECT_THAT(fileText(exercise() / "seen.txt"), AllOf(StartsWith("clockwise\n"), HasSubstr("\nlibrary\n")))
      << "others are kept";
  EXPECT_TRUE(pass("wrong", /*storesMessages=*/false, {"clockwise"}).passed);
  EXPECT_THAT(pass("wrong", /*storesMessages=*/false, {"a_typo"}).message,
              StartsWith("a_typo: it was not graded"));
  EXPECT_EQ(pass("wrong", /*storesMessages=*/false, {"clockwize"}).message,
            "98-template has no wrong variant 'clockwize' (did you mean 'clockwise'?)");
}

TEST_F(WrongVariantsTest, AreToldApartByWhatIsWrong) {
  writeVariant("a_typo", "caught by: quarter-turn", "return angel * p;\n");
  writeVariant("b_right", "caught by: quarter-turn",
               "const double c = std::cos(angle), s = std::sin(angle);\n"
               "return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};\n");
  writeVariant("c_unknown", "caught by: quarter-trun", "return p;\n");
  writeVariant("d_unseen", "caught by: quarter-turn\n// shown by: angles-add", "return p;\n");
  writeVariant("e_allowed", "caught by: forbidden-call", "return p;\n");
  writeVariant("f_forbidden", "caught by: quarter-turn", kByLibrary);
  writeVariant("g_half", "caught by: quarter-turn, keeps-length", "return angle / 2 * p;\n");
  const GateResult result = pass("wrong");
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.note, "compiled alone: a_typo");
  std::vector<std::string> lines;
  for (const std::string_view line : splitLines(result.message)) lines.emplace_back(line);
  EXPECT_THAT(
      lines,
      ElementsAre(
          AllOf(
              StartsWith("c_unknown: "),
              HasSubstr("wrong.cpp:33:15: no check is called 'quarter-trun' (did you mean 'quarter-turn'?)")),
          StartsWith("a_typo: it was not graded: main.cpp:9:8: error: 'angel' was not declared"),
          "b_right: check 'quarter-turn' does not catch this mistake: b_right.",
          "d_unseen: check 'angles-add' leaves no picture",
          "e_allowed: it should call a forbidden function, but no call was found",
          HasSubstr("f_forbidden: it was not graded: main.cpp:9:13: error: calls rex::rotationAboutAxis")));
}

TEST_F(WrongVariantsTest, SayWhereTheFileIsMalformed) {
  writeVariant("twice", "caught by: quarter-turn", "return 2 * p;\n");
  writeVariant("unnamed", "shown by: quarter-turn", "return p;\n");
  for (const char* gate : {"wrong", "wrong/library", "evidence"})
    EXPECT_THAT(pass(gate).message, HasSubstr("wrong.cpp:25:13: variant 'unnamed': no check is named"));
  write("wrong.cpp", "// to be written\n");
  EXPECT_THAT(pass("wrong").message, HasSubstr("wrong.cpp:1:1: no variant"));
}

TEST_F(WrongVariantsTest, GoAloneWhereMoreThanAFunctionDiffers) {
  write("wrong.cpp",
        "// <variant clockwise>\n// caught by: quarter-turn\n// mistake: clockwise.\n"
        "// <solution introduction>\n#include <complex>\n// <solution rotated>\n"
        "const auto z = std::complex(p.x(), p.y()) * std::polar(1.0, -angle);\n"
        "return {z.real(), z.imag()};\n");
  const GateResult together = pass("wrong");
  EXPECT_TRUE(together.passed) << together.message;
  EXPECT_EQ(together.note, "compiled alone: clockwise");
}

// The compiler sees that the reference has no effect, and would leave out the call.
TEST_F(WrongVariantsTest, AreCalledWhateverTheReferenceDoes) {
  std::string solution = fileText(exercise() / "solution.cpp");
  const std::string region = "  // <solution rotated>\n", function = "Eigen::Vector2d rotated(";
  solution.insert(solution.find(region) + region.size(), "  static_cast<void>(checked(angle));\n");
  solution.insert(solution.find(function),
                  "double checked(double angle) {\n  // <solution checked>\n  return angle;\n  // <todo>\n"
                  "  // </solution>\n}\n\n");
  write("solution.cpp", solution);
  write("wrong.cpp",
        "// <variant throws>\n// caught by: quarter-turn\n// mistake: throws.\n"
        "// <solution checked>\nthrow angle;\n");
  const GateResult result = pass("wrong");
  EXPECT_TRUE(result.passed) << result.message;
  EXPECT_EQ(result.note, "");
}

TEST_F(WrongVariantsTest, AreGatesThemselvesIfOneAsks) {
  EXPECT_EQ(gateNames(submission::readExerciseInfo(exercise())).back(), "wrong");
  EXPECT_TRUE(pass("wrong/library").passed);
  fs::remove(exercise() / "wrong.cpp");
  EXPECT_EQ(gateNames(submission::readExerciseInfo(exercise())).back(), "mutants");
  EXPECT_THROW(pass("wrong"), UsageError);
}

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

}  // namespace rex::authoring::wrong_variants_test
