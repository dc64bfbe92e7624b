// What compilers and linkers of GNU say when they fail, word by word, and what a source can make them say.
#include "submission/tool_failure.h"

#include <csignal>

#include <gtest/gtest.h>

namespace rex::grading::tool_failure_test {

ProcessResult ended(const std::string& error, int exitCode = 1) {
  return {.started = true, .exitCode = exitCode, .output = {}, .error = error};
}

TEST(ToolFailure, KnowsWhoWasKilled) {
  EXPECT_TRUE(wasKilled(
      ended("g++: fatal error: Killed signal terminated program cc1plus\ncompilation terminated.\n")));
  EXPECT_TRUE(wasKilled(
      ended("[]\ng++: fatal error: Killed signal terminated program as\ncompilation terminated.\n")));
  EXPECT_TRUE(wasKilled(
      ended("collect2: fatal error: ld terminated with signal 9 [Killed]\ncompilation terminated.\n")));
  EXPECT_TRUE(wasKilled(ended("", 128 + SIGKILL)));
  EXPECT_TRUE(wasKilled({.started = true, .signal = SIGKILL, .output = {}, .error = {}}));
  EXPECT_FALSE(wasKilled({.started = true, .timedOut = true, .signal = SIGKILL, .output = {}, .error = {}}));
  EXPECT_FALSE(wasKilled({.started = true, .signal = SIGSEGV, .output = {}, .error = {}}));
  EXPECT_FALSE(
      wasKilled(ended("collect2: fatal error: ld terminated with signal 11 [Segmentation fault]\n"
                      "compilation terminated.\n")));
  EXPECT_FALSE(wasKilled(ended("compilation terminated.\n")));
}

TEST(ToolFailure, BelievesNoSourceThatItWasKilled) {
  const std::string words = "g++: fatal error: Killed signal terminated program cc1plus";
  EXPECT_FALSE(wasKilled(ended(R"([{"kind": "error", "message": "#error )" + words + R"("}])" + "\n")));
  EXPECT_FALSE(wasKilled(ended("[]\nmain.cpp: Assembler messages:\nmain.cpp:1: Error: x\n" + words +
                               "\ncompilation terminated.\n")));
  EXPECT_FALSE(wasKilled(ended("ld: student.o: undefined reference to `" + words +
                               "\ncompilation terminated.'\ncollect2: error: ld returned 1 exit status\n")));
}

CompileDiagnostic error(const std::string& message) { return {"main.cpp", 1, 1, "error", "", message}; }

TEST(ToolFailure, KnowsAFullDisk) {
  const std::string full = "error writing to /tmp/ccM6QBox.s: No space left on device";
  EXPECT_EQ(fullDiskIn({error(full)}), full);
  EXPECT_EQ(fullDiskIn({{"main.cpp", 1, 1, "warning", "", "unused"}, error(full)}), full);
  EXPECT_TRUE(fullDiskIn({error("opening dependency file student.d: Disk quota exceeded")}).has_value());
  EXPECT_FALSE(fullDiskIn({}).has_value());
  EXPECT_FALSE(fullDiskIn({error("'b' was not declared"), error(full)}).has_value());
  EXPECT_FALSE(fullDiskIn({error("#error " + full)}).has_value());
  EXPECT_FALSE(fullDiskIn({error(full + ": No such file or directory")}).has_value());
}

TEST(ToolFailure, KnowsWhatTheLinkerHoldsAgainstTheObject) {
  const std::string start = "ld: build/student.o: ";
  EXPECT_EQ(complaintAbout("build/student.o", start + "in function `f':\nmain.cpp:(.text+0x5): truncated\n"),
            "main.cpp:(.text+0x5): truncated");
  EXPECT_EQ(complaintAbout("build/student.o", start + "TLS definition mismatches\n"),
            start + "TLS definition mismatches");
  const std::string alone = "build/student.o:(.data+0x0): relocation truncated to fit";
  EXPECT_EQ(complaintAbout("build/student.o", alone + "\ncollect2: error: ld returned 1 exit status\n"),
            alone);
  EXPECT_EQ(complaintAbout("build/student.o",
                           "libgcc.a(cpuinfo.o): in function `f':\n(.text+0x7): relocation "
                           "truncated to fit: R_X86_64_PC32 against symbol `x'\n"),
            "its global variables take more than 2 GB");
  EXPECT_EQ(complaintAbout("build/student.o", "ld: cannot find build/student.o: No such file\n"), "");
  EXPECT_EQ(complaintAbout("build/student.o", "ld: final link failed: bad value\n"), "");
  EXPECT_EQ(complaintAbout("build/student.o",
                           start + "in function `f':\nmain.cpp:(.text+0x5): warning: the use of `tmpnam' is "
                                   "dangerous\n/usr/bin/ld: final link failed: No space left on device\n"),
            "");
}

TEST(ToolFailure, QuotesWhatTellsMost) {
  EXPECT_EQ(lastWordsOf(ended("[]\ncompilation terminated.\n")), "exit code 1");
  EXPECT_EQ(lastWordsOf({.started = true, .signal = SIGABRT, .output = {}, .error = {}}), "signal 6");
  EXPECT_EQ(lastWordsOf(ended("[]\n/tmp/x.s: Assembler messages:\n/tmp/x.s: Fatal error: x\n")),
            "/tmp/x.s: Fatal error: x");
  EXPECT_EQ(lastWordsOf(ended("ld: warning: a\nld: final link failed: No space left on device\n")),
            "ld: final link failed: No space left on device");
}

}  // namespace rex::grading::tool_failure_test
