#include "base/child.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <future>
#include <memory>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "support/expect_error.h"

namespace rex::child_test {

TEST(Pipe, CarriesBytesAndEndsWhenItsWriterCloses) {
  Pipe pipe;
  EXPECT_GE(std::min(pipe.readEnd(), pipe.writeEnd()), 10);
  EXPECT_EQ(::write(pipe.writeEnd(), "ab", 2), 2);
  pipe.closeWrite();
  char got[3] = {};
  EXPECT_EQ(::read(pipe.readEnd(), got, 3), 2);
  EXPECT_EQ(::read(pipe.readEnd(), got, 3), 0);
  EXPECT_EQ(pipe.writeEnd(), -1);
}

TEST(Pipe, LeavesAReleasedEndOpen) {
  int fd = -1;
  {
    Pipe pipe;
    fd = pipe.releaseRead();
    EXPECT_EQ(pipe.readEnd(), -1);
  }
  char got = 0;
  EXPECT_EQ(::read(fd, &got, 1), 0);
  EXPECT_EQ(::close(fd), 0);
}

// The sanitizers need descriptors themselves.
#ifndef __SANITIZE_ADDRESS__
TEST(Pipe, SaysWhenThereAreNoDescriptors) {
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  for (const rlim_t most : {0, 10}) {
    const rlimit few{most, before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    EXPECT_REX_ERROR(Pipe(), "cannot make a pipe: found ");
    ::setrlimit(RLIMIT_NOFILE, &before);
  }
}
#endif

TEST(SigpipeIgnored, TurnsTheSignalIntoAnErrorCode) {
  {
    const SigpipeIgnored ignored;
    Pipe pipe;
    pipe.closeRead();
    EXPECT_EQ(::write(pipe.writeEnd(), "a", 1), -1);
    EXPECT_EQ(errno, EPIPE);
  }
  sigset_t blocked, pending;
  ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  ::sigpending(&pending);
  EXPECT_EQ(::sigismember(&blocked, SIGPIPE), 0);
  EXPECT_EQ(::sigismember(&pending, SIGPIPE), 0);
}

// The other thread's wish began before and ends first.
TEST(SigpipeIgnored, HoldsForItsThreadWhateverOthersDo) {
  auto first = std::make_unique<SigpipeIgnored>();
  Pipe broken;
  broken.closeRead();
  std::promise<void> begun, over;
  std::thread writer([&] {
    const SigpipeIgnored ignored;
    begun.set_value();
    over.get_future().wait();
    EXPECT_EQ(::write(broken.writeEnd(), "a", 1), -1);
    EXPECT_EQ(errno, EPIPE);
  });
  begun.get_future().wait();
  first.reset();
  over.set_value();
  writer.join();
}

}  // namespace rex::child_test
