// What compilers and linkers of GNU say when they fail, word by word.
#include "submission/build_tools.h"

#include <csignal>

#include <gtest/gtest.h>

namespace rex::submission::build_tools_test {

ProcessResult ended(const std::string& error, int exitCode = 1) {
  return {.started = true, .exitCode = exitCode, .output = {}, .error = error};
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
}

TEST(ToolFailure, KnowsWhenTheLinkerBlamesTheObject) {
  for (const char* text : {"main.cpp:1: undefined reference to `f'", "multiple definition of `f'",
                           "ld: build/student.o: TLS definition mismatches"})
    EXPECT_TRUE(blamesObject(text, "build/student.o")) << text;
  for (const char* text : {"", "ld: final link failed: No space left on device", "ld: cannot find -lx",
                           "collect2: fatal error: ld terminated with signal 9 [Killed]"})
    EXPECT_FALSE(blamesObject(text, "build/student.o")) << text;
}

TEST(ToolFailure, QuotesWhatTellsMost) {
  EXPECT_EQ(lastLine(ended("[]\ncompilation terminated.\n")), "exit code 1");
  EXPECT_EQ(lastLine({.started = true, .signal = SIGABRT, .output = {}, .error = {}}), "signal 6");
  EXPECT_EQ(lastLine(ended("[]\n/tmp/x.s: Assembler messages:\n/tmp/x.s: Fatal error: x\n")),
            "/tmp/x.s: Fatal error: x");
  EXPECT_EQ(lastLine(ended("ld: warning: a\nld: final link failed: No space left on device\n")),
            "ld: final link failed: No space left on device");
}

}  // namespace rex::submission::build_tools_test
