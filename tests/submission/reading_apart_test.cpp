#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "submission/reading_apart_internal.h"
#include "support/expect_error.h"

namespace rex::submission::reading_apart_test {

using grading::CompileDiagnostic;

constexpr IsolationLimits kLittle{.cpuSeconds = 1, .wallSeconds = 60, .memory = 64u << 20};

TEST(ReadApart, ReturnsWhatWasRead) {
  const auto read = [] { return nlohmann::json{1, "\xff is not UTF-8", {true}}; };
  EXPECT_EQ(readApart("it", kLittle, read), read());
  const CompileDiagnostic message{"main.cpp", 3, 4, "error", "-Wx", "caf\xe9"};
  const auto messages = messagesApart("it", [&] { return std::vector<CompileDiagnostic>{message, {}}; });
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(toString(messages[0]), toString(message));
  EXPECT_EQ(messages[0].severity, "error");
  EXPECT_EQ(toString(messages[1]), toString(CompileDiagnostic{}));
}

TEST(ReadApart, BlamesTheFileForWhatItTakes) {
  const auto refusal = [](const std::function<nlohmann::json()>& read) -> std::string {
    try {
      static_cast<void>(readApart("the file", kLittle, read));
    } catch (const UnreadableFile& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_EQ(refusal([]() -> nlohmann::json {
              [[maybe_unused]] volatile int steps = 0;
              for (int k = 0;; k ^= 1) {
                steps = k;
              }
            }),
            "reading the file took more than 1 s of processor time");
  EXPECT_EQ(refusal([] { return nlohmann::json(::raise(SIGSEGV)); }),
            "reading the file failed with signal 11");
#ifndef __SANITIZE_ADDRESS__
  EXPECT_EQ(refusal([] { return nlohmann::json(std::string(80u << 20, 'x')); }),
            "reading the file needed more than 64 MiB of memory");
#endif
}

TEST(ReadApart, BlamesTheMachineForWhatComesFromOutside) {
  try {
    static_cast<void>(
        readApart("the file", kLittle, [] { return nlohmann::json(::kill(::getpid(), SIGKILL)); }));
    FAIL() << "nothing was thrown";
  } catch (const UnreadableFile&) {
    FAIL() << "the file was blamed";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "reading the file was killed twice, through no fault of the file: wanted a machine that is less "
        "busy, with free memory");
  }
  EXPECT_REX_ERROR(
      static_cast<void>(readApart("it", kLittle, []() -> nlohmann::json { throw Error({.what = "no"}); })),
      "no");
}

}  // namespace rex::submission::reading_apart_test
