#include "submission/symbol_scan.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::grading::symbol_scan_test {

const std::vector<ForbiddenFunction> kForbidden = {{"rex::solveIk", "you write it"}};

// Whether a reference to this symbol counts, from the code of `section`, which is that of `function`.
bool isCall(const std::string& symbol, const std::string& section = ".text._Z1fv",
            const std::string& function = "f()") {
  const std::string listing = "SYMBOL TABLE:\n0000000000000000 l    d  " + section + "\t0000000000000000 " +
                              section + "\n0000000000000000 g     F " + section + "\t0000000000000010 " +
                              function + "\n\n\nRELOCATION RECORDS FOR [" + section +
                              "]:\nOFFSET           TYPE              VALUE\n"
                              "0000000000000005 R_X86_64_PLT32    " +
                              symbol + "-0x0000000000000004\n\n";
  return !forbiddenCalls(listing, kForbidden).empty();
}

TEST(ForbiddenCalls, MatchTheFunctionWhateverItsArguments) {
  EXPECT_TRUE(isCall("rex::solveIk(Eigen::Matrix<double, 3, 1> const&, int)"));
  EXPECT_TRUE(isCall("std::vector<int> rex::solveIk<double>(double)"));
  EXPECT_TRUE(isCall("rex::solveIk[abi:cxx11](int)"));
  EXPECT_TRUE(isCall("rex::solveIk::run(int)"));
  EXPECT_TRUE(isCall("rex::solveIk"));
}

TEST(ForbiddenCalls, LeaveOtherNamesAlone) {
  EXPECT_FALSE(isCall("rex::solveIkFaster(int)"));
  EXPECT_FALSE(isCall("mine::rex::solveIk(int)"));
  EXPECT_FALSE(isCall("(anonymous namespace)::solveIk(int)"));
  EXPECT_FALSE(isCall("std::vector<rex::solveIk>::size() const"));
  EXPECT_FALSE(isCall("run(rex::solveIk const&)"));
  EXPECT_TRUE(forbiddenCalls("short line", kForbidden).empty());
}

TEST(ForbiddenCalls, AreAllowedInMainAlone) {
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text.startup.main", "main"));
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text.unlikely.main", "main.cold"));
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text.a", "main::{lambda()#1}::operator()() const"));
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text.a", "int std::call<main::{lambda()#1}>(int)"));
  for (const char* other : {"mainly", "domain::f()", "A::main::f()", "_GLOBAL__sub_I_main"})
    EXPECT_TRUE(isCall("rex::solveIk(int)", ".text.main", other)) << other;
  EXPECT_TRUE(isCall("rex::solveIk(int)", ".data.rel.ro", "table"));
}

TEST(ForbiddenCalls, AreThoseThatFindFunctionsByName) {
  for (const char* lookup : {"dlsym", "dlopen", "dl_iterate_phdr"})
    for (const char* function : {"f()", "main"}) EXPECT_TRUE(isCall(lookup, ".text.a", function)) << lookup;
  EXPECT_FALSE(isCall("mine::dlsym(int)"));
}

class ScanSymbolsTest : public ::testing::Test {
 protected:
  // What the scan says about a source file compiled here.
  std::vector<CompileDiagnostic> scan(const std::string& source) {
    const std::filesystem::path object = temporary_.path() / "a.o";
    const ProcessResult compiled = runProcess(
        {"g++", "-std=c++20", "-O1", "-ffunction-sections", "-x", "c++", "-c", "-", "-o", object.string()},
        {.input = source});
    EXPECT_TRUE(compiled.ok()) << compiled.error;
    return scanSymbols("objdump", object, source, "main.cpp", kForbidden,
                       BuildTools({}, temporary_.path(), {}));
  }
  TemporaryFolder temporary_;
};

TEST_F(ScanSymbolsTest, NamesPlaceFunctionReasonAndAdvice) {
  const auto messages = scan(R"(#define GO rex::solveIk
namespace rex { int solveIk(int); }
int f() { return GO(3); }
)");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(toString(messages[0]),
            "main.cpp: error: calls rex::solveIk, which only main() may call in this exercise: you write it. "
            "Write it yourself instead [forbidden-call]");
}

TEST_F(ScanSymbolsTest, SeesThroughAliasesPointersAndOwnDeclarations) {
  EXPECT_EQ(scan("namespace rex { int solveIk(int); }\nauto* hidden = &rex::solveIk;\n").size(), 1u);
  EXPECT_EQ(scan("int innocent(int) asm(\"_ZN3rex7solveIkEi\");\nint f() { return innocent(1); }\n").size(),
            1u);
  EXPECT_EQ(scan("namespace rex { int solveIk(int); }\nnamespace r = rex;\n#define GO r::sol##veIk\n"
                 "int f() { return GO(1); }\n")
                .size(),
            1u);
}

TEST_F(ScanSymbolsTest, AllowsMainToCompareWithTheLibrary) {
  const std::string declared = "namespace rex { int solveIk(int); }\n";
  EXPECT_TRUE(scan(declared + "int main() { return rex::solveIk(1); }\n").empty());
  EXPECT_TRUE(scan("#include <functional>\n" + declared +
                   "void each(const std::function<int(int)>& f);\n"
                   "int main() { each([](int a) { return rex::solveIk(a); }); }\n")
                  .empty());
  EXPECT_EQ(scan(declared + "int f() { return rex::solveIk(1); }\nint main() { return f(); }\n").size(), 1u);
  EXPECT_EQ(scan(declared + "int kept = rex::solveIk(1);\nint main() { return kept; }\n").size(), 1u);
}

TEST_F(ScanSymbolsTest, AllowsClassesThreadsAndSwitchesInMain) {
  EXPECT_TRUE(scan(R"(#include <functional>
#include <memory>
#include <thread>
namespace rex { int solveIk(int); }
struct Base {
  virtual int run(int) = 0;
  virtual ~Base() = default;
};
int useBase(Base&);
void a(int), b(int);
int main(int n, char**) {
  struct Mine : Base {
    int run(int k) override { return rex::solveIk(k); }
  } mine;
  std::thread t([&] { n = rex::solveIk(n); });
  t.join();
  static const int kept = rex::solveIk(n);
  switch (n) {
    case 0: a(1); break;
    case 1: b(3); break;
    case 2: a(7); break;
    case 3: b(5); break;
    case 4: a(2); break;
    case 5: b(9); break;
  }
  return useBase(mine) + std::make_shared<Mine>()->run(kept);
}
)")
                  .empty());
}

// Ways to call from where only main() may.
TEST_F(ScanSymbolsTest, SeesThroughWhatOnlyLooksLikeMain) {
  const std::string declared = "namespace rex { int solveIk(int); }\n";
  for (const char* section :
       {".text.main", ".text.startup.main", ".text.unlikely.main", ".text._ZZ4mainENKUlvE_clEv"})
    EXPECT_EQ(scan(declared + "__attribute__((section(\"" + section +
                   "\"), noinline)) static int helper(int a) { return rex::solveIk(a); }\n"
                   "int f() { return helper(1); }\nint main() { return 0; }\n")
                  .size(),
              1u)
        << section;
  const char* attacks[] = {
      // main() itself, by its name and by others
      "int in, out;\nint main() { return out = rex::solveIk(in); }\nint f() { main(); return out; }\n",
      "int main() { return rex::solveIk(1); }\nauto* stored = &main;\nint f() { return stored(); }\n",
      "int main() { return rex::solveIk(1); }\n"
      "extern \"C\" int other() __attribute__((alias(\"main\")));\nint f() { return other(); }\n",
      "int main() { return rex::solveIk(1); }\nint other() asm(\"main\");\nint f() { return other(); }\n",
      // a function under the name of a lambda of main()
      "__attribute__((noinline)) static int helper(int) asm(\"_ZZ4mainENKUliE_clEi\");\n"
      "static int helper(int a) { return rex::solveIk(a); }\nint f() { return helper(1); }\nint main() {}\n",
      // a lambda of main() whose type escapes
      "template <class T> struct Get { friend auto get(Get); };\n"
      "template <class T, class V> struct Set { friend auto get(Get<T>) { return V{}; } };\n"
      "int main() { auto l = [](int a) __attribute__((noinline)) { return rex::solveIk(a); };\n"
      "Set<int, decltype(l)> set; }\nint f() { return get(Get<int>{})(1); }\n",
      // other ways to say its name
      "static int weak(int) __attribute__((weakref(\"_ZN3rex7solveIkEi\")));\nint f() { return weak(1); }\n",
      "extern \"C\" int (*chosen())(int) { return &rex::solveIk; }\n"
      "int f(int) __attribute__((ifunc(\"chosen\")));\n",
      "int f() { int r; asm(\"call _ZN3rex7solveIkEi\" : \"=a\"(r)); return r; }\n",
      "asm(\".set mine, _ZN3rex7solveIkEi\");\nextern \"C\" int mine(int);\nint f() { return mine(1); }\n",
      "asm(\".section .text.main\\nmine: jmp _ZN3rex7solveIkEi\\n.text\");\nextern \"C\" int mine(int);\n"
      "int f() { return mine(1); }\nint main() {}\n",
      "int main() { static int (*volatile p)(int) = &rex::solveIk; return p(1); }\nint f() { return 0; }\n"};
  for (const char* attack : attacks) EXPECT_EQ(scan(declared + attack).size(), 1u) << attack;
}

TEST_F(ScanSymbolsTest, RefusesToFindFunctionsByName) {
  const auto messages = scan(
      "#include <dlfcn.h>\nint f() {\n  return reinterpret_cast<int (*)(int)>(dlsym(nullptr, "
      "\"_ZN3rex7solveIkEi\"))(1);\n}\n");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(toString(messages[0]),
            "main.cpp:3:41: error: calls dlsym, which nobody may call in this exercise: it finds functions "
            "while the program runs [forbidden-call]");
}

TEST_F(ScanSymbolsTest, AllowsWritingAFunctionOfThatNameOrOnlyDeclaringIt) {
  EXPECT_TRUE(scan("namespace rex { int solveIk(int); }\nint solveIk(int a) { return a; }\nint f() { return "
                   "::solveIk(1); }\n")
                  .empty());
}

TEST_F(ScanSymbolsTest, SaysWhenItCannotRead) {
  EXPECT_REX_ERROR(scanSymbols("objdump", temporary_.path() / "none.o", "", "main.cpp", kForbidden,
                               BuildTools({}, temporary_.path(), {})),
                   "cannot list what the compiled file refers to");
}

}  // namespace rex::grading::symbol_scan_test
