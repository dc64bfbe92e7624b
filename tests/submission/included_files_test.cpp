#include "submission/included_files.h"

#include <algorithm>
#include <cerrno>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seccomp.h>
#include <unistd.h>

#include "base/error.h"
#include "base/process.h"
#include "base/rng.h"
#include "base/text.h"
#include "base/text_file.h"
#include "support/honest_styles.h"
#include "support/rounds.h"
#include "support/temporary_folder.h"

namespace rex::submission::included_files_test {

class LineMarkers : public testing::Test {
 protected:
  // What is found in a file that the compiler preprocesses here.
  std::vector<grading::CompileDiagnostic> found(const std::string& source) {
    writeTextFile(folder_.path() / "main.cpp", sourceForMarkers(source));
    const ProcessResult run = runProcess({"g++", "-std=c++20", "-isystem", "/usr/include/eigen3", "-E",
                                          "-pedantic", "-fno-diagnostics-show-caret", "main.cpp"},
                                         {.directory = folder_.path(), .outputLimit = 64u << 20});
    return lineMarkers(run.output, run.error, source, "main.cpp", run.ok());
  }
  std::string firstFound(const std::string& source) {
    const auto all = found(source);
    return all.empty() ? "" : toString(all.front());
  }

  const TemporaryFolder folder_;
};

constexpr const char* kLine =
    "error: found a #line directive, wanted the real line numbers of the file [line-marker]";
constexpr const char* kPragma =
    "error: found the pragma system_header, wanted code that the compiler warns about [line-marker]";
constexpr const char* kItself =
    "error: found an include of the file itself, wanted each of its lines once [line-marker]";

struct Attack {
  const char *source, *place, *message = kLine;
};

// Whatever the spelling, what the compiler obeys is found, and placed where a reader finds it.
constexpr Attack kAttacks[] = {
    {"#line 1 \"other.h\"\nint a;\n", "1:1"},
    {"int a;\n  #line 7 \"b.h\"\n", "2:3"},
    {"int a;\n#line 1\nint b;\n", "2:1"},
    {"int a;\n\t#\tline 2\nint b;\n", "2:2"},
    {"int a;\n#line 900\nint b;\n", "2:1"},
    {"int a;\n#line 2147483999\nint b;\n", "2:1"},
    {"int a;\n# 1 \"vector\" 3\nint b;\n", "2:3"},
    {"int a;\n# 5\nint b;\n", "2:3"},
    {"int a;\n# 3 \"main.cpp\"\nint b;\n", "2:3"},
    {"%:line 900\n", "1:1"},
    {"%: 9 \"x\"\n", "1:4"},
    {"int a;\n\v#\f1\n", "2:4"},
    {"/**/#/**/line 5\nint a;\n", "1:5"},
    {"int a;\n/*\n*/ # 1 \"x\" 3\n", "3:6"},
    {"#\\\nline 1 \"x\"\n", "1:1"},
    {"#li\\\nne 1 \"x\"\n", "1:1"},
    {"#li\\  \nne 1 \"x\"\n", "1:1"},
    {"// a \\\n/*\n#line 1\n/**/\n", "3:1"},
    {"auto a = R\"(\n/*\n)\";\n#line 1\n/**/\n", "4:1"},
    {"auto a = R\"(\n# 1 \"odd.h\"\n)\";\n#line 77\n", "2:1"},  // at what looks like it
    {"int operator\"\"R(const char*, unsigned long);\nint a = \"a\"R\"(\";\n#line 7 \"x\"\nint b; //)\"\n",
     "3:1"},
    {"\xEF\xBB\xBF#line 9\n", "1:1"},
    {"int a;\r\n#line 7 \"x\"\r\nint b;\r\n", "2:1"},
    {"int a;\n#line 100", "2:1"},
    {"#define F(x) x\nF(\n#line 7 \"x\"\nint a;)\n", "3:1"},
    {"#define F(x) x\nF(\n#line 7 \"x\"\nint a;\n#line 5 \"main.cpp\"\n)\n", "3:1"},
    {"#define F(x)\nF(\n# 7 \"x\"\n)\n", "3:3"},
    {"#define N 77\n#define M \"odd\"\n#line N M\n", "3:1"},
    {"#line 1 \"x\"\nint a;\n#line 4 __BASE_FILE__\n", "1:1"},
    {"int a;\n#line __LINE__\nint b;\n", "2:1"},
    {"int a;\nint b;\nint c;\n#line 1\nint d;\n#line 7\nint e;\n", "4:1"},
    {"int a;\n#line 30\nint b;\n#line 5\nint c;\n", "2:1"},
    {"# 1 \"/usr/include/stdc-predef.h\" 1 3 4\nint a;\n# 4 \"main.cpp\" 2\nint b;\n", "1:3"},
    {"#pragma GCC diagnostic ignored \"-Wpedantic\"\n# 7 \"x\" 3\n", "2:3"},
    {"#define X 0\n_Pragma(\"push_macro(\\\"X\\\")\")\n#undef X\n#define X "
     "1\n_Pragma(\"pop_macro(\\\"X\\\")\")\n"
     "#if X == 0\n#line 1 \"x\"\n#endif\n",
     "7:1"},
    {"#line 1 \"bwrap: No permissions\"\n#error of the sandbox\n", "1:1"},
    {"#pragma GCC system_header\n", "1:13", kPragma},
    {"#pragma GCC sys\\\ntem_header\n", "1:13", kPragma},
    {"int a;\n_Pragma(\"GCC system_header\")\n", "2:5", kPragma},
    {"#define P(x) _Pragma(#x)\n#define S(a, b) P(GCC a##b)\nS(system, _header)\n", "3:5", kPragma},
    {"#ifndef A\n#define A\n#include __FILE__\n#else\n_Pragma(\"GCC system_header\")\n#endif\n", "3:1",
     kItself},
    {"#ifndef A\n#define A\n#include \"main.cpp\"\n#endif\n", "3:1", kItself},
    {"#if !__INCLUDE_LEVEL__\n#include \"./main.cpp\"\n#line 2\n#endif\n", "2:1", kItself},
};

TEST_F(LineMarkers, AreFoundAndPlacedHoweverTheyAreSpelt) {
  for (const Attack& attack : kAttacks)
    EXPECT_EQ(firstFound(attack.source), fmt::format("main.cpp:{}: {}", attack.place, attack.message))
        << attack.source;
}

// A file of the system that says it were main.cpp.
TEST_F(LineMarkers, AreFoundInWhatIsIncluded) {
  for (const char* marker :
       {"#line 1 \"main.cpp\"", "# 1 \"main.cpp\" 1", "# 1 \"main.cpp\" 2", "# 9 \"main.cpp\""}) {
    writeTextFile(folder_.path() / "odd.h", "int a;\n" + std::string(marker) + "\nint b;\n");
    EXPECT_THAT(firstFound("int c;\n#include \"odd.h\"\nint d;\n"), testing::HasSubstr("[line-marker]"))
        << marker;
  }
  writeTextFile(folder_.path() / "odd.h", "#line 1 \"grammar.y\"\nint b;\n");
  EXPECT_EQ(firstFound("int c;\n#include \"odd.h\"\nint d;\n"), "") << "names no line of the file";
}

TEST_F(LineMarkers, AreNotMistakenForWhatHonestPeopleWrite) {
  const auto styles = honestStyles();
  EXPECT_GE(styles.size(), 100u);
  writeTextFile(folder_.path() / "exercise.h", "#pragma once\nint twice(int a);\n");
  for (std::size_t k = 0; k < styles.size(); ++k) {
    const auto& [name, source] = styles[k];
    EXPECT_EQ(firstFound(source), "") << name;
    if (k % static_cast<std::size_t>(rounds(5, 1)) > 0) continue;
    EXPECT_EQ(firstFound("\xEF\xBB\xBF" + inDosLines(source.substr(0, source.size() - 1))), "") << name;
  }
}

// The compiler decides: what it attributes to another file, or keeps silent about, must be found, and nothing
// else. The pieces are such as hide a marker from one reader and show it to the other.
TEST_F(LineMarkers, AreThoseThatTheCompilerObeys) {
  Rng rng(17);
  const std::vector<std::string> pieces = {
      "#", "line", " 7 \"odd.h\"", " 7 \"odd.h\" 3", "\n",         "\n", "/*",  "*/", "//", "\\\n", " ", "\"",
      "'", "R\"(", ")\"",          "#if 0\n",        "\n#endif\n", "%:", "/*/", "<",  ";"};
  const auto some = [&](int most) {
    std::string text;
    for (int i = rng.index(most); i > 0; --i)
      text += pieces[static_cast<std::size_t>(rng.index(static_cast<int>(pieces.size())))];
    return text;
  };
  int obeyed = 0, ignored = 0;
  for (int k = 0; k < 60; ++k) {
    const std::string source = some(5) + "\n" + some(2) + "#" + some(2) + " 7 \"odd.h\" 3\n" + some(4);
    writeTextFile(folder_.path() / "main.cpp", source);
    const ProcessResult run =
        runProcess({"g++", "-std=c++20", "-E", "-w", "main.cpp"}, {.directory = folder_.path()});
    // Text that is printed as it stands, in a literal, names it, too; a marker stands in a line of its own.
    const std::vector<std::string_view> lines = splitLines(run.output);
    const bool isMarker = std::ranges::any_of(lines, [](std::string_view line) {
      return line.starts_with("# ") && line.find("\"odd.h\"") != line.npos;
    });
    if (!isMarker) {
      EXPECT_EQ(firstFound(source), "") << source;
      ++ignored;
    } else if (run.output.find("R\"(") == std::string::npos) {
      EXPECT_NE(firstFound(source), "") << source;
      ++obeyed;
    }
  }
  EXPECT_GT(obeyed, 5);
  EXPECT_GT(ignored, 5);
}

// Exits with 0 if the machine gets the blame. The kernel is made to look like one before 5.6, or a container.
void checkFileWithoutOpenat2(int error) {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  if (seccomp_rule_add(filter, SCMP_ACT_ERRNO(error), SCMP_SYS(openat2), 0) != 0 || seccomp_load(filter) != 0)
    ::_exit(1);
  try {
    (void)forbiddenIncludes({"/usr/include/stdio.h"}, "", "main.cpp", "/tmp", {});
  } catch (const Error& failure) {
    ::_exit(failure.parts().found.starts_with("openat2: ") ? 0 : 2);
  }
}

TEST(ForbiddenIncludes, BlamesAMachineThatCannotOpenFilesSafely) {
  for (const int error : {ENOSYS, EPERM})
    EXPECT_EXIT(checkFileWithoutOpenat2(error), testing::ExitedWithCode(0), "");
}

}  // namespace rex::submission::included_files_test
