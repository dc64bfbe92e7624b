#include "submission/sanitizer_rerun.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "grading/worker_failure.h"
#include "support/file_text.h"
#include "support/temporary_folder.h"

namespace rex::submission::sanitizer_rerun_test {

// A report as the sanitizer of addresses writes it, shortened.
constexpr const char* kOverflow = R"(I print, too.
=================================================================
==42==ERROR: AddressSanitizer: heap-buffer-overflow on address 0x602000 at pc 0x55 bp 0x7f sp 0x7f
READ of size 8 at 0x602000 thread T0
    #0 0x55d0 in std::vector<double>::operator[](unsigned long) /usr/include/c++/12/bits/stl_vector.h:1123
    #1 0x55d1 in nearest(std::vector<double> const&) /tmp/work/main.cpp:14
    #2 0x55d2 in ikStep(int) /tmp/work/main.cpp:47
    #3 0x55d3 in rex::remote::answer() (/tmp/work/worker+0x1)
0x602000 is located 0 bytes to the right of 16-byte region
allocated by thread T0 here:
    #0 0x55d4 in operator new(unsigned long) (libasan.so+0xb)
    #1 0x55d5 in other(int) /tmp/work/main.cpp:3
)";

TEST(CrashSiteIn, IsTheInnermostLineOfTheStudentsFile) {
  const auto site = crashSiteIn(kOverflow, "main.cpp");
  ASSERT_TRUE(site);
  EXPECT_EQ(site->finding, "reads or writes outside an array on the heap");
  EXPECT_EQ(site->function, "nearest");
  EXPECT_EQ(site->line, 14);
  EXPECT_EQ(crashSiteIn(kOverflow, "ain.cpp")->line, 0) << "another file";
}

TEST(CrashSiteIn, ReadsWhatTheSanitizerOfUndefinedBehaviourSays) {
  const auto site = crashSiteIn(
      "main.cpp:12:17: runtime error: execution reached the end of a value-returning function without "
      "returning a value\n    #0 0x5 in rotated(double) /tmp/main.cpp:12\n",
      "main.cpp");
  ASSERT_TRUE(site);
  EXPECT_EQ(site->line, 12);
  EXPECT_EQ(site->function, "rotated");
  EXPECT_EQ(site->finding,
            "execution reached the end of a value-returning function without returning a value");
}

TEST(CrashSiteIn, HasTheSidesOfAnAssertion) {
  const auto site = crashSiteIn(
      "rex: the sides are 3 and 2\nAssertion `a == b' failed.\n"
      "==1==ERROR: AddressSanitizer: ABRT on unknown address\n    #0 0x1 in f() /w/main.cpp:5\n",
      "main.cpp");
  ASSERT_TRUE(site);
  EXPECT_EQ(site->sides, "3 and 2");
  EXPECT_EQ(site->line, 5);
}

TEST(CrashSiteIn, IsNothingWithoutAFinding) {
  EXPECT_FALSE(crashSiteIn("", "main.cpp"));
  EXPECT_FALSE(crashSiteIn("    #0 0x5 in rotated(double) /tmp/main.cpp:12\n", "main.cpp"));
}

// Two functions that call each other from lines 4 and 9. Where the stack ends is chance: in any line of them,
// or in what they call.
TEST(CrashSiteIn, IsWhereARecursionCallsItselfWhereverTheStackEnds) {
  const std::vector<std::string> rounds = {"even(int) /tmp/main.cpp:4", "odd(int) /tmp/main.cpp:9"};
  for (const char* top : {"even(int) /tmp/main.cpp:3", "odd(int) /tmp/main.cpp:8",
                          "half(int) /tmp/main.cpp:1", "memcpy (libasan.so+0xb)"})
    for (const int first : {0, 1}) {
      std::string report = "==4==ERROR: AddressSanitizer: stack-overflow on address 0x7f\n    #0 0x5 in ";
      report += top;
      for (int k = 1; k < 8; ++k)
        report += "\n    #" + std::to_string(k) + " 0x5 in " + rounds[(first + k) % 2];
      const auto site = crashSiteIn(report, "main.cpp");
      ASSERT_TRUE(site);
      EXPECT_EQ(site->function, "even") << report;
      EXPECT_EQ(site->line, 4) << report;
    }
  EXPECT_EQ(crashSiteIn("ERROR: AddressSanitizer: stack-overflow\n    #0 0x5 in f(int) /tmp/main.cpp:2\n",
                        "main.cpp")
                ->line,
            2);
}

// The real sanitizers, which may word their reports anew.
class SanitizedToolchain : public ::testing::Test {
 protected:
  static Toolchain plain() {
    Toolchain toolchain;
    toolchain.compiler = "c++";
    toolchain.flags = {"-w", "-isystem", "/usr/include/eigen3"};
    return toolchain;
  }

  void compile(const Toolchain& toolchain, const std::vector<std::string>& what, const std::string& code) {
    std::ofstream(temporary_.path() / "main.cpp") << code;
    std::vector<std::string> command = {toolchain.compiler};
    for (const auto& words : {toolchain.flags, {"main.cpp"}, what, toolchain.linkFlags})
      command.insert(command.end(), words.begin(), words.end());
    const ProcessResult built = runProcess(command, {.directory = temporary_.path(), .timeout = 300});
    ASSERT_TRUE(built.ok()) << built.error;
  }
  ProcessResult run() const { return runProcess({(temporary_.path() / "program").string()}); }

  TemporaryFolder temporary_;
  Toolchain toolchain_ = sanitizedToolchain(plain(), temporary_.path(), 200 * grading::kMegabyte);
};

TEST_F(SanitizedToolchain, MakesProgramsThatReportWhereTheyCrash) {
  struct Crash {
    const char* code;
    const char* finding;
  };
  const Crash crashes[] = {
      {"volatile int* p = nullptr; return *p;", "null pointer"},
      {"int* p = new int[3]; p[0] = n; return p[n + 2];", "outside an array on the heap"},
      {"int p[3] = {n, n, n}; return p[n + 2];", "out of bounds"},
      {"int* p = new int(n); delete p; return *p;", "memory after freeing it"},
      {"return 7 / (n - 1);", "division by zero"},
      {"if (n == 7) return 1;", "without returning a value"},
      {"return n + crash(n + 1);", "uses up the stack"},
      {"__builtin_abort();", "aborts"},
  };
  for (const Crash& crash : crashes) {
    ASSERT_NO_FATAL_FAILURE(compile(toolchain_, {"-o", "program"},
                                    std::string("int crash(int n) {\n  ") + crash.code +
                                        "\n}\nint main(int n, char**) { return crash(n); }\n"));
    const ProcessResult run = this->run();
    const auto site = crashSiteIn(run.error, "main.cpp");
    ASSERT_TRUE(site) << run.error;
    EXPECT_EQ(site->function, "crash") << run.error;
    EXPECT_GE(site->line, 1);
    EXPECT_LE(site->line, 3);
    EXPECT_NE(site->finding.find(crash.finding), std::string::npos) << site->finding;
  }
}

TEST_F(SanitizedToolchain, WarnsOfNothingInEigen) {
  Toolchain warning = plain();
  warning.flags.front() = "-Wall";
  warning.flags.emplace_back("-Werror");
  compile(
      sanitizedToolchain(warning, temporary_.path(), 200 * grading::kMegabyte), {"-c"},
      "#include <Eigen/Dense>\nEigen::MatrixXd f(const Eigen::MatrixXd& A) { return A.inverse() * A; }\n");
}

// The second program asks for more than there can be, at once.
TEST_F(SanitizedToolchain, MakesProgramsThatEndWhenTheyHoldTooMuchMemory) {
  const char* bodies[] = {
      "for (int k = 0; k < 40; ++k, usleep(20000)) memset(malloc(20 << 20), 1, 20 << 20);",
      "return *new char[1ull << 60];"};
  for (const char* body : bodies) {
    ASSERT_NO_FATAL_FAILURE(compile(toolchain_, {"-o", "program"},
                                    "#include <stdlib.h>\n#include <string.h>\n#include <unistd.h>\n"
                                    "int main() { " +
                                        std::string(body) + " }\n"));
    const ProcessResult run = this->run();
    const grading::Failure failure =
        grading::explainEnd({.status = run.signal, .function = "f", .errorTail = run.error},
                            {.memory = 200 * grading::kMegabyte});
    EXPECT_EQ(failure.outcome, grading::Outcome::kMemoryLimit) << run.error;
    EXPECT_EQ(failure.message, "used more than 200 MB of memory in f");
  }
}

TEST_F(SanitizedToolchain, MakesProgramsThatSayWhereTheyAskForTooMuchMemory) {
  const Toolchain locating = locatingToolchain(plain(), temporary_.path(), 600 * grading::kMegabyte, 100);
  const char* bodies[] = {"std::vector<int*> all;\n  for (;;) all.push_back(new int[1000]());",
                          "std::vector<int> all(n);\n  all.resize(1 << 30);"};
  for (const char* body : bodies) {
    ASSERT_NO_FATAL_FAILURE(
        compile(locating, {"-o", "program"},
                "#include <vector>\nstd::vector<int> filled(int n) {\n  " + std::string(body) +
                    "\n  return all.size() > 9 ? std::vector<int>(n) : std::vector<int>();\n}\n"
                    "int main(int n, char**) { return filled(n).size(); }\n"));
    const ProcessResult run = this->run();
    const auto site = crashSiteIn(run.error, "main.cpp");
    ASSERT_TRUE(site) << run.error;
    EXPECT_EQ(site->line, 4) << run.error;
    EXPECT_THAT(site->function, ::testing::StartsWith("filled")) << run.error;
    EXPECT_EQ(site->finding, "asked for more: does a loop never end, or is a size wrong?");
  }
}

TEST_F(SanitizedToolchain, SharesVectorsWithALibraryThatKnowsNothingOfIt) {
  const std::string vectors = "#include <Eigen/Core>\nEigen::VectorXd made(int n)";
  ASSERT_NO_FATAL_FAILURE(compile(plain(), {"-c", "-o", "library.o"},
                                  vectors + " { return Eigen::VectorXd::Ones(n); }\n"
                                            "void resize(Eigen::VectorXd& v) { v.resize(9); }\n"));
  ASSERT_NO_FATAL_FAILURE(compile(toolchain_, {"library.o", "-o", "program"},
                                  vectors + ";\nvoid resize(Eigen::VectorXd& v);\n"
                                            "int main() {\n  Eigen::VectorXd v = made(3);\n"
                                            "  v.conservativeResize(5);\n  resize(v);\n"
                                            "  return v.size() == 9 ? 0 : 1;\n}\n"));
  const ProcessResult run = this->run();
  EXPECT_TRUE(run.ok()) << run.error;
}

}  // namespace rex::submission::sanitizer_rerun_test
