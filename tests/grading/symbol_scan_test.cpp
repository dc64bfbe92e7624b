#include "grading/symbol_scan.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::grading {
namespace {

const std::vector<ForbiddenFunction> kForbidden = {{"rex::solveIk", "you write it"}};

// Whether a reference to this symbol, from the code of `section`, counts.
bool isCall(const std::string& symbol, const std::string& section = ".text._Z1fv") {
  const std::string relocations = "RELOCATION RECORDS FOR [" + section +
                                  "]:\nOFFSET           TYPE              VALUE\n"
                                  "0000000000000005 R_X86_64_PLT32    " +
                                  symbol + "-0x0000000000000004\n\n";
  return !forbiddenCalls(relocations, kForbidden).empty();
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
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text.startup.main"));
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text.main"));
  EXPECT_FALSE(isCall("rex::solveIk(int)", ".text._ZZ4mainENKUlvE_clEv"));
  EXPECT_TRUE(isCall("rex::solveIk(int)", ".text.mainly"));
  EXPECT_TRUE(isCall("rex::solveIk(int)", ".text._ZN1K7Z4mainEEi"));
  EXPECT_TRUE(isCall("rex::solveIk(int)", ".text.startup._GLOBAL__sub_I_x"));
  EXPECT_TRUE(isCall("rex::solveIk(int)", ".data.rel.ro"));
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

}  // namespace
}  // namespace rex::grading
