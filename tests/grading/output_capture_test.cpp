#include "grading/output_capture.h"

#include <array>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace rex::grading::output_capture_test {

TEST(OutputCapture, KeepsTheStartAndTheEndAndCountsTheRest) {
  std::array<int, 2> fds{};
  ASSERT_EQ(::pipe2(fds.data(), O_CLOEXEC), 0);
  ::fcntl(fds[0], F_SETFL, O_NONBLOCK);
  OutputCapture capture(fds[0]);
  const std::string all = "start" + std::string(1 << 20, '.') + "end";
  std::thread writer([&] {
    for (std::size_t done = 0; done < all.size();)
      done += static_cast<std::size_t>(::write(fds[1], all.data() + done, all.size() - done));
    ::close(fds[1]);
  });
  while (capture.fd() >= 0) capture.drain();
  writer.join();
  EXPECT_EQ(capture.total(), all.size());
  EXPECT_EQ(capture.head(), all.substr(0, 64 << 10));
  EXPECT_EQ(capture.tail(), all.substr(all.size() - (4 << 10)));
}

TEST(TellingLine, PrefersTheReasonToTheLastLine) {
  EXPECT_EQ(tellingLine(""), "");
  EXPECT_EQ(tellingLine("one\n  two \n\n"), "two");
  EXPECT_EQ(tellingLine("w: a.h:1: T f() [with T = X]: Assertion `i < n' failed.\nbye\n"),
            "Assertion `i < n' failed.");
  EXPECT_EQ(
      tellingLine("/c++/12/stl_vector.h:1123: T f() [with T = X]: Assertion '__n < this->size()' failed.\n"),
      "an index is beyond the end of a std::vector or std::array (Assertion '__n < this->size()' failed.)");
  const std::string column =
      "(i>=0) && ( ((BlockRows==1) && (BlockCols==XprType::ColsAtCompileTime) && i<xpr.rows()) ||(...))";
  EXPECT_EQ(tellingLine("w: Block.h:120: T f() [with T = X]: Assertion `" + column + "' failed.\n"),
            "a row or column outside of a matrix is used (Assertion `" + column + "' failed.)");
  EXPECT_EQ(tellingLine("x.cpp:3:5: runtime error: division by zero\nmore\n"),
            "x.cpp:3:5: runtime error: division by zero");
  EXPECT_EQ(tellingLine("==1==ERROR: AddressSanitizer: heap-use-after-free\n==1==ABORTING\n"),
            "==1==ERROR: AddressSanitizer: heap-use-after-free");
  EXPECT_EQ(tellingLine("terminate called after throwing 'E'\n  what():  broken\n"),
            "terminate called after throwing 'E', what():  broken");
  EXPECT_EQ(tellingLine(std::string(1000, 'x')), std::string(300, 'x') + " ...");
}

}  // namespace rex::grading::output_capture_test
