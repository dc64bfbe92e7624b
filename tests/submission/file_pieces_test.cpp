#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "submission/graded_source.h"

namespace rex::submission::file_pieces_test {

using ::testing::ElementsAre;

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

}  // namespace rex::submission::file_pieces_test
