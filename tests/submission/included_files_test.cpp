#include "submission/included_files.h"

#include <cerrno>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seccomp.h>
#include <unistd.h>

#include "base/error.h"
#include "base/process.h"
#include "base/rng.h"
#include "base/text_file.h"
#include "support/temporary_folder.h"

namespace rex::submission::included_files_test {

int countIn(const std::string& source) { return static_cast<int>(lineMarkers(source, "main.cpp").size()); }

TEST(LineMarkers, NamesTheLineAndColumn) {
  const auto found =
      lineMarkers("int a;\n  #line 7 \"b.h\"\n# 1 \"c.h\" 3\n#pragma GCC system_header\n", "main.cpp");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(toString(found[0]),
            "main.cpp:2:3: error: found a #line directive, wanted the real line numbers of the file "
            "[line-marker]");
  EXPECT_EQ(found[1].line, 3);
  EXPECT_EQ(toString(found[2]),
            "main.cpp:4:13: error: found the pragma system_header, wanted code that the compiler warns about "
            "[line-marker]");
}

TEST(LineMarkers, FindsThemHoweverTheyAreSpelt) {
  for (const char* source : {"#line 1",
                             "# line 1",
                             "\t#\tline 1",
                             "%:line 1",
                             "%: 1 \"x\"",
                             "#\\\nline 1",
                             "#li\\\nne 1",
                             "#li\\  \nne 1",
                             "/**/#line 1",
                             "/* a\n b */ #line 1",
                             "#/**/line 1",
                             "#/* a\n*/ line 1",
                             "int a; /*\n*/ # 1 \"x\" 3",
                             "int a; /*\n/*/\n#line 1\n/**/",
                             "\xEF\xBB\xBF#line 1",
                             "#if 0\n'/*\n#endif\n#line 1 \"x\"",
                             "#if __has_include(</*>)\n#endif\n#line 1\n/**/",
                             "auto a = R\"(\n/*\n)\";\n#line 1\n/**/",
                             "// a \\\n/*\n#line 1\n/**/",
                             "\v#\f1",
                             "#line 1\r\n",
                             "\r#line 1",
                             "?\?=line 1",
                             "#line\\\n 1",
                             "_Pragma(\"GCC system_header\")",
                             "#pragma GCC sys\\\ntem_header"})
    EXPECT_EQ(countIn(source), 1) << source;
}

TEST(LineMarkers, LeavesOtherTextAlone) {
  for (const char* source :
       {"#include <a>\n#define line 1\nint line = 1;", "/*\n# 1. first\n# 2. second\n#line 3\n*/\nint a;",
        "// # 1 \"x\"", "auto a = \"#line 1\";", "#define A(x) #x\n", "#pragma once", "#lines", "a # 1",
        "#ifdef line\n#endif", "/* # 1 */ int a;", ""})
    EXPECT_EQ(countIn(source), 0) << source;
}

// The compiler decides: what it attributes to another file, or keeps silent about, must be found. The pieces
// are such as hide a marker from one reader and show it to the other.
TEST(LineMarkers, MissesNothingThatTheCompilerObeys) {
  const TemporaryFolder folder;
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
  int obeyed = 0;
  for (int k = 0; k < 60; ++k) {
    const std::string source = some(5) + "\n" + some(2) + "#" + some(2) + " 7 \"odd.h\" 3\n" + some(4);
    writeTextFile(folder.path() / "main.cpp", source);
    const ProcessResult run =
        runProcess({"g++", "-std=c++20", "-E", "-w", "main.cpp"}, {.directory = folder.path()});
    if (run.output.find("\"odd.h\"") == std::string::npos) continue;
    // Text that is printed as it stands, in a literal, names it, too; a marker stands in a line of its own.
    std::istringstream lines(run.output);
    bool isMarker = false;
    for (std::string line; std::getline(lines, line);)
      isMarker = isMarker || (line.starts_with("# ") && line.find("\"odd.h\"") != std::string::npos);
    if (!isMarker) continue;
    ++obeyed;
    EXPECT_GT(countIn(source), 0) << source;
  }
  EXPECT_GT(obeyed, 5);
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
