#include "remote/channel.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/rng.h"
#include "remote/caller.h"
#include "remote/wire.h"
#include "remote/worker.h"

namespace rex::remote::channel_test {

/// Both ends of one pipe, for messages to oneself.
class Loop {
 public:
  Loop() {
    if (::pipe2(fds_.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  }
  ~Loop() { closeRead(), closeWrite(); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  Channel channel() const { return Channel(fds_[0], fds_[1]); }
  void write(const std::vector<std::byte>& bytes) const {
    ASSERT_EQ(::write(fds_[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  std::vector<std::byte> read() const {
    std::vector<std::byte> bytes(4096);
    bytes.resize(static_cast<std::size_t>(::read(fds_[0], bytes.data(), bytes.size())));
    return bytes;
  }
  int readEnd() const { return fds_[0]; }
  int writeEnd() const { return fds_[1]; }
  void closeRead() { close(fds_[0]); }
  void closeWrite() { close(fds_[1]); }

 private:
  static void close(int& fd) {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
  std::array<int, 2> fds_{-1, -1};
};

Writer someBody() {
  Writer body;
  Wire<std::string>::put(body, "hello");
  return body;
}

std::vector<std::byte> someMessage() {
  const Loop loop;
  loop.channel().send(Kind::kReply, 7, 3, someBody());
  return loop.read();
}

TEST(Channel, KeepsAMessage) {
  const Loop loop;
  Channel channel = loop.channel();
  channel.send(Kind::kReply, 7, 3, someBody());
  Message message = channel.receive();
  EXPECT_EQ(message.kind, Kind::kReply);
  EXPECT_EQ(message.id, 7u);
  EXPECT_EQ(message.method, 3u);
  EXPECT_EQ(Wire<std::string>::get(message.body), "hello");
}

TEST(Channel, NoticesThatTheOtherSideIsGone) {
  Loop loop;
  Channel channel = loop.channel();
  const std::vector<std::byte> whole = someMessage();
  loop.write({whole.begin(), whole.end() - 1});
  loop.closeWrite();
  EXPECT_THROW(static_cast<void>(channel.receive()), Closed);

  Loop deaf;
  Channel toDeaf = deaf.channel();
  deaf.closeRead();
  const auto previous = ::signal(SIGPIPE, SIG_IGN);
  EXPECT_THROW(toDeaf.send(Kind::kReply, 1, 1, someBody()), Closed);
  ::signal(SIGPIPE, previous);
}

TEST(Channel, RefusesBytesBehindAMessage) {
  const Loop loop;
  std::vector<std::byte> bytes = someMessage();
  bytes.push_back(std::byte{0});
  loop.write(bytes);
  EXPECT_THROW(static_cast<void>(loop.channel().receive()), ProtocolError);
}

TEST(Channel, RefusesAnAnnouncedSizeBeyondTheLimit) {
  const Loop loop;
  std::vector<std::byte> bytes = someMessage();
  for (std::size_t k = 20; k < 24; ++k) bytes[k] = std::byte{0xff};
  loop.write(bytes);
  EXPECT_THROW(static_cast<void>(loop.channel().receive()), ProtocolError);
}

// Whatever bytes a worker sends, the trusted side ends with a value or an error, and never waits for ever.
TEST(Channel, SurvivesMutatedReplies) {
  const std::vector<std::byte> whole = someMessage();
  Rng rng(11);
  int accepted = 0;
  int refused = 0;
  for (int k = 0; k < 5000; ++k) {
    std::vector<std::byte> bytes = whole;
    bytes[rng.index(static_cast<int>(bytes.size()))] = static_cast<std::byte>(rng.index(256));
    bytes.resize(bytes.size() - static_cast<std::size_t>(rng.index(8) == 0 ? rng.index(30) : 0));
    Loop loop;
    loop.write(bytes);
    Channel channel = loop.channel();
    loop.closeWrite();
    try {
      static_cast<void>(channel.receive());
      ++accepted;
    } catch (const ProtocolError&) {
      ++refused;
    } catch (const Closed&) {
      ++refused;
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

/// What a caller says to one message that lies ready before it asks.
template <class Act>
std::string complaint(Kind kind, std::uint64_t id, std::uint32_t method, Act&& act) {
  const Loop answers;
  const Loop calls;
  answers.channel().send(kind, id, method, Writer());
  Caller caller(Channel(answers.readEnd(), calls.writeEnd()), 1);
  try {
    act(caller);
  } catch (const ProtocolError& error) {
    return error.what();
  }
  return "";
}

void shakeHands(Caller& caller) { caller.handshake(5); }
void makeCall(Caller& caller) {
  static_cast<void>(caller.call(0, "f", Writer(), [](std::uint32_t, Reader&, Writer&) {}));
}

TEST(Caller, RefusesWrongMessages) {
  const std::uint64_t firstId = Rng(1).next();
  EXPECT_EQ(complaint(Kind::kHello, 5, 0, shakeHands), "");
  EXPECT_EQ(complaint(Kind::kReply, 5, 0, shakeHands), "the worker does not introduce itself");
  EXPECT_EQ(complaint(Kind::kHello, 6, 0, shakeHands), "the worker was built from another exercise.h");
  EXPECT_EQ(complaint(Kind::kReply, firstId, 0, makeCall), "");
  EXPECT_EQ(complaint(Kind::kReply, firstId + 1, 0, makeCall), "the worker answers a call that was not made");
  EXPECT_EQ(complaint(Kind::kReply, firstId, 1, makeCall), "the worker answers for another function");
  EXPECT_EQ(complaint(Kind::kHello, firstId, 0, makeCall), "the worker sends a message of unknown kind");
  EXPECT_EQ(complaint(static_cast<Kind>(77), firstId, 0, makeCall),
            "the worker sends a message of unknown kind");
  EXPECT_EQ(complaint(Kind::kThrew, firstId, 0, makeCall), "the message ends too early");
}

TEST(Session, WantsCalls) {
  Loop requests;
  const Loop replies;
  requests.channel().send(Kind::kReply, 7, 0, Writer());
  requests.closeWrite();
  const std::array methods = {Method{"f", 1, [](Session&, Reader&, Writer&) { ADD_FAILURE() << "was run"; }}};
  Session session(Channel(requests.readEnd(), replies.writeEnd()), methods);
  EXPECT_THROW(session.serve(), ProtocolError);
}

int whenToAnswer = -1;  // a pipe that ends then

void answerLate(Session&, Reader&, Writer&) {
  char none = 0;
  EXPECT_EQ(::read(whenToAnswer, &none, 1), 0);
}

// The exit code of a worker that gets one message, after whose arrival nobody reads its replies.
int exitCodeOfWorker(Kind kind) {
  Loop requests, replies, moment;
  requests.channel().send(kind, 7, 0, Writer());
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGPIPE, SIG_IGN);
    replies.closeRead(), moment.closeWrite(), requests.closeWrite();
    constexpr int kFree = 20;
    const int in = ::fcntl(requests.readEnd(), F_DUPFD, kFree);
    const int out = ::fcntl(replies.writeEnd(), F_DUPFD, kFree);
    whenToAnswer = ::fcntl(moment.readEnd(), F_DUPFD, kFree);
    ::dup2(in, kWorkerIn), ::dup2(out, kWorkerOut);
    const std::array methods = {Method{"late", 1, answerLate}};
    runWorker(methods);
  }
  static_cast<void>(replies.read());  // its introduction
  replies.closeRead(), replies.closeWrite(), moment.closeWrite(), requests.closeWrite();
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Worker, TellsByItsExitCodeWhyItEnds) {
  EXPECT_EQ(exitCodeOfWorker(Kind::kReply), kProtocolFailure) << "a message that is no call";
  EXPECT_EQ(exitCodeOfWorker(Kind::kCall), kProtocolFailure) << "nobody wants the answer";
}

}  // namespace rex::remote::channel_test
