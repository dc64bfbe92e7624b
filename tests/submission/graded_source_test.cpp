#include "submission/graded_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rex::submission::graded_source_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// What is shorter is compiled as it is.
const std::string kMuch(300, '/');

TEST(GradedPart, MakesNoCodeOfWhatOnlyMainNeeds) {
  EXPECT_EQ(gradedSource("#include \"exercise.h\"\n"
                         "struct Point {\n  double x, y;\n};\n"
                         "namespace {\n"
                         "double shared(double a) { return a; }\n"
                         "void drawn() {\n  shared(1);\n}\n"
                         "}\n"
                         "void show(int a = 1) { drawn(); }\n"
                         "double helper(double a) { return shared(a); }\n"
                         "double graded(double a) { return helper(a); }  // kept\n"
                         "int main() {\n" +
                             kMuch + "\n  show(); graded(1); }\n",
                         {"graded"}, {}),
            "#include \"exercise.h\"\n"
            "struct Point {\n  double x, y;\n};\n"
            "namespace {\n"
            "double shared(double a) { return a; }\n"
            "void drawn() {\n  shared(1);\n}\n"
            "} inline \n"
            "void show(int a = 1) { drawn(); }\n"
            "double helper(double a) { return shared(a); }\n"
            "double graded(double a) { return helper(a); } namespace rexLeftOut { inline   // kept\n"
            "int main() {\n" +
                kMuch + "\n  show(); graded(1); ;return 0;}}\n");
}

TEST(GradedPart, PutsWordsOnlyWhereColumnsStay) {
  for (const char* start : {"", "#include \"exercise.h\"\n", "int f() { return 1; } ",
                            "struct A {}; /* a */ ", "int f() { return 1; }\n[[maybe_unused]] "}) {
    const std::string source = start + std::string("int main() {\n") + kMuch + "\n}\nint f() { return 1; }\n";
    EXPECT_EQ(gradedSource(source, {"f"}, {}), source);
  }
  EXPECT_THAT(
      gradedSource("#include \"exercise.h\"\n\nint main() {\n" + kMuch + "\n}\nint f() { return 1; }\n",
                   {"f"}, {}),
      HasSubstr("h\"\n namespace rexLeftOut { inline \nint main() {"));
}

TEST(GradedPart, KeepsWhatAnyOtherCodeMentions) {
  for (const char* user :
       {"#define CALL hidden()\n", "const auto kValue = hidden();\n",
        "struct A {\n  int f() { return hidden(); }\n};\n",
        "template <class T> int g(T) { return hidden(); }\n", "static int g() { return hidden(); }\n"})
    EXPECT_THAT(
        gradedSource(std::string(user) + "int hidden() { return 7; }\nint f() { return 1; }\nint main() {\n" +
                         kMuch + "\n}\n",
                     {"f"}, {}),
        AllOf(Not(HasSubstr("inline \nint hidden")), HasSubstr("inline \nint main")))
        << user;
}

TEST(GradedPart, IsEmptyWhereWhatIsWatchedIsLeftOut) {
  const std::string f = "int f() { return 1; }\n";
  for (const char* left :
       {"void asks() { solve(); }\nint main() { asks(); }\n", "#define ASK solve()\nint main() { ASK; }\n",
        "namespace {\nvoid asks() { rex::solve(); }\n}\nint main() { asks(); }\n"})
    EXPECT_EQ(gradedSource(f + left, {"f"}, {"solve"}), "") << left;
  for (const char* seen :
       {"int main() { solve(); }\n", "int asks() { return solve(); }\nstruct A { int a = asks(); };\n",
        "// solve\nvoid resolve() { f(); }\n"})
    EXPECT_NE(gradedSource(f + seen, {"f"}, {"solve"}), "") << seen;
}

TEST(GradedPart, TakesAnyText) {
  for (const char* text :
       {"", "}", "{", "namespace {", "int f() {", "#", "int f() {}}}}", "/*", "int g() {}"})
    EXPECT_NO_THROW(static_cast<void>(gradedSource(text, {"f"}, {"g"}))) << text;
  EXPECT_EQ(gradedSource("int g() { return 1; }", {"f"}, {}), "");
}

std::vector<std::string> texts(const std::string& source) {
  std::vector<std::string> all;
  for (const CppPiece& piece : cppPieces(CppText(source)))
    all.push_back(source.substr(piece.start, piece.end - piece.start));
  return all;
}

// The only function of a source; "none" if there is none, or the name does not start where it should.
std::string functionIn(const std::string& source) {
  std::string found = "none";
  for (const CppPiece& piece : cppPieces(CppText(source))) {
    if (piece.function.empty()) continue;
    EXPECT_EQ(found, "none") << source;
    EXPECT_EQ(source.substr(piece.nameStart, piece.function.size()), piece.function);
    EXPECT_EQ(source[piece.bodyStart], '{');
    found = piece.function;
  }
  return found;
}

TEST(FilePieces, EndWithBracesOrSemicolons) {
  EXPECT_THAT(texts("#include <cmath>\n\nusing namespace rex;  // all\n// A comment.\nint f() { return 1; }\n"
                    "struct S {\n  int a;\n};\nconst int kA[]{1, 2}, kB[] = {3};\nint g(int);\n"),
              ElementsAre("#include <cmath>", "using namespace rex;", "int f() { return 1; }",
                          "struct S {\n  int a;\n};", "const int kA[]{1, 2}, kB[] = {3};", "int g(int);"));
  EXPECT_THAT(
      texts("#define A \\\n  {\nint f() {\n  if (true) {\n  }\n}\n[[nodiscard]] int g() { return 1; }"),
      ElementsAre("#define A \\\n  {", "int f() {\n  if (true) {\n  }\n}",
                  "[[nodiscard]] int g() { return 1; }"));
  EXPECT_THAT(texts("namespace {\nint f() { return 1; }\n}\nint g() { return 2; }"),
              ElementsAre("namespace {", "int f() { return 1; }", "}", "int g() { return 2; }"));
  EXPECT_THAT(texts("namespace a { namespace { int f() { return 1; } } }"),
              ElementsAre("namespace a { namespace { int f() { return 1; } } }"));
}

TEST(FilePieces, KnowWhichBracesAreText) {
  EXPECT_THAT(
      texts("void f() {\n  puts(\"}\");  // }\n  /* } */ char c = '}';\n  puts(R\"(})\");\n}\nint g;"),
      ElementsAre("void f() {\n  puts(\"}\");  // }\n  /* } */ char c = '}';\n  puts(R\"(})\");\n}",
                  "int g;"));
}

TEST(FilePieces, AcceptTextThatIsNoCode) {
  EXPECT_THAT(texts(""), ElementsAre());
  EXPECT_THAT(texts("} ) what {"), ElementsAre("}", ") what {"));
  EXPECT_THAT(texts("#"), ElementsAre("#"));
}

TEST(FilePieces, NameFunctionsThatCanBeSwapped) {
  for (const char* source :
       {"int f() {}", "Eigen::VectorXd f(const Eigen::VectorXd& x, double a) {}", "int* f() {}",
        "int& f() {}", "std::vector<std::pair<int, int>> f(std::function<int(int)> g) {}",
        "int f(int (*g)(int)) {}", "[[nodiscard]] int f() {}", "[[deprecated(\"no (\")]] int f() {}",
        "int f() noexcept(true) {}", "int f(std::vector<int> a = {1, 2}, char c = '{') {}",
        "// } \\\n{\nint f() {}", "int\nf // (\n(int a) {}",
        "int f(int a) {\n  const auto g = [&] { return a; };\n  return g();\n}"})
    EXPECT_EQ(functionIn(source), "f") << source;
  EXPECT_EQ(functionIn("int main() {}"), "main");
  ASSERT_EQ(cppPieces(CppText("int f(int) {}\nint f(double) {}\n")).size(), 2u);
}

TEST(FilePieces, KnowWhatTheLinkerDoesNotSee) {
  const std::string source =
      "int a() {}\nnamespace {\nint b() {}\nnamespace { int c() {} }\nint d() {}\n}\nint e() {}\n";
  std::string internal, others;
  for (const CppPiece& piece : cppPieces(CppText(source)))
    (piece.isInternal ? internal : others) += piece.function;
  EXPECT_EQ(internal, "bcd");
  EXPECT_EQ(others, "ae");
}

TEST(FilePieces, NameNothingElse) {
  for (const char* source : {"static int f() {}",
                             "inline int f() {}",
                             "int constexpr f() {}",
                             "template <class T> int f(T) {}",
                             "int f(auto a) {}",
                             "auto f() -> int {}",
                             "namespace a { int f() {} }",
                             "extern \"C\" int f() {}",
                             "int A::f() {}",
                             "A::~A() {}",
                             "A::A() : a{1} {}",
                             "bool operator<(A, A) {}",
                             "int f();",
                             "const int f = [](int) { return 1; }(2);",
                             "int f{1};",
                             "struct F { int f() {} };",
                             "decltype(1) f() {}",
                             "TEST(F, f) {}",
                             "__attribute__((cold)) int f() {}",
                             "enum F { f };",
                             "int f() try {} catch (...) {}",
                             "#define F int f() {}",
                             "{}",
                             "int a {}"})
    EXPECT_EQ(functionIn(source), "none") << source;
}

}  // namespace rex::submission::graded_source_test
