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

bool isCall(const std::string& nmLine) { return !forbiddenCalls(nmLine, kForbidden).empty(); }

TEST(ForbiddenCalls, MatchTheFunctionWhateverItsArguments) {
  EXPECT_TRUE(isCall("                 U rex::solveIk(Eigen::Matrix<double, 3, 1> const&, int)"));
  EXPECT_TRUE(isCall("                 U rex::solveIk()\n                 U other()"));
  EXPECT_TRUE(isCall("0000000000000000 W std::vector<int> rex::solveIk<double>(double)"));
  EXPECT_TRUE(isCall("                 U rex::solveIk[abi:cxx11](int)"));
  EXPECT_TRUE(isCall("                 U rex::solveIk::run(int)"));
  EXPECT_TRUE(isCall("                 U rex::solveIk"));
}

TEST(ForbiddenCalls, LeaveOtherNamesAlone) {
  EXPECT_FALSE(isCall("0000000000000000 T rex::solveIk(int)"));  // the student's own
  EXPECT_FALSE(isCall("                 U rex::solveIkFaster(int)"));
  EXPECT_FALSE(isCall("                 U mine::rex::solveIk(int)"));
  EXPECT_FALSE(isCall("                 U (anonymous namespace)::solveIk(int)"));
  EXPECT_FALSE(isCall("                 U std::vector<rex::solveIk>::size() const"));
  EXPECT_FALSE(isCall("                 U run(rex::solveIk const&)"));
  EXPECT_FALSE(isCall("short line"));
}

class ScanSymbolsTest : public ::testing::Test {
 protected:
  // What the scan says about a source file compiled here.
  std::vector<CompileDiagnostic> scan(const std::string& source) {
    const std::filesystem::path object = temporary_.path() / "a.o";
    const ProcessResult compiled = runProcess(
        {"g++", "-std=c++20", "-O1", "-x", "c++", "-c", "-", "-o", object.string()}, {.input = source});
    EXPECT_TRUE(compiled.ok()) << compiled.error;
    return scanSymbols("nm", object, source, "main.cpp", kForbidden);
  }
  TemporaryFolder temporary_;
};

TEST_F(ScanSymbolsTest, NamesPlaceFunctionReasonAndAdvice) {
  const auto messages = scan(R"(namespace rex { int solveIk(int); }
// not here: solveIk
using namespace rex;
int f() { return solveIk(3); }
)");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(toString(messages[0]),
            "main.cpp:1:21: error: calls rex::solveIk, which this exercise forbids: you write it. Write it "
            "yourself instead [forbidden-call]");
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

TEST_F(ScanSymbolsTest, AllowsWritingAFunctionOfThatNameOrOnlyDeclaringIt) {
  EXPECT_TRUE(scan("namespace rex { int solveIk(int); }\nint solveIk(int a) { return a; }\nint f() { return "
                   "::solveIk(1); }\n")
                  .empty());
}

TEST_F(ScanSymbolsTest, SaysWhenItCannotRead) {
  EXPECT_REX_ERROR(scanSymbols("nm", temporary_.path() / "none.o", "", "main.cpp", kForbidden),
                   "cannot list the symbols of the compiled file");
}

}  // namespace
}  // namespace rex::grading
