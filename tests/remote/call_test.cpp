#include "remote/call.h"

#include <array>
#include <memory>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.h"
#include "remote/channel.h"
#include "remote/worker.h"
#include "support/expect_error.h"

namespace rex::remote {
namespace call_test {

using ::testing::HasSubstr;

/// Crosses by description: a counter is sent as its start.
class Counter {
 public:
  explicit Counter(int start) : value_(start) {}
  Counter(Counter&&) = default;
  Counter& operator=(Counter&&) = delete;
  int next() { return value_++; }

 private:
  int value_;
};

struct Sums {
  double total = 0;
  std::vector<double> partial;
};

Eigen::VectorXd scaled(const Eigen::VectorXd& x, double factor) { return factor * x; }
double traceOf(const Eigen::Ref<const Eigen::MatrixXd>& m) { return m.trace(); }
int countTwice(Counter& counter) { return counter.next() + counter.next(); }
double draw(Rng& rng) { return rng.uniform(); }
void nothing() {}
std::string moved(std::string text) { return text + "!"; }

Sums sumUp(const std::function<double(int)>& term, int count) {
  Sums sums;
  for (int k = 0; k < count; ++k) sums.partial.push_back(sums.total += term(k));
  return sums;
}

bool knows(const std::function<void(const Eigen::VectorXd&)>& f) { return f != nullptr; }

int fail(const std::string& how) {
  if (how == "error") throw Error({.what = "joint 'elbow'", .found = "7", .wanted = "3"});
  if (how == "range") return std::vector<int>(1).at(5);
  if (how == "memory") throw std::bad_alloc();
  if (how == "number") throw 42;
  if (how == "large") throw std::runtime_error(std::string(1 << 20, 'x'));
  return 1;
}

std::function<double(int)> kept;
int keep(const std::function<double(int)>& f) {
  kept = f;
  return 0;
}
double useKept() { return kept(1); }

std::string largeText(int size) { return std::string(static_cast<std::size_t>(size), 'x'); }

}  // namespace call_test

template <>
struct Remote<call_test::Counter> {
  using Sent = int;
  static call_test::Counter fromSent(int start) { return call_test::Counter(start); }
};

namespace call_test {

constexpr std::array kNames = {"scaled", "traceOf", "countTwice", "draw", "nothing", "moved",
                               "sumUp",  "knows",   "fail",       "keep", "useKept", "largeText"};

/// A worker in a thread of this process, at the other end of two pipes.
class InProcessWorker {
 public:
  InProcessWorker() {
    if (::pipe2(toWorker_.data(), O_CLOEXEC) != 0 || ::pipe2(fromWorker_.data(), O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
    thread_ = std::thread([this] {
      const std::array methods = {
          method<&scaled>("scaled"), method<&traceOf>("traceOf"), method<&countTwice>("countTwice"),
          method<&draw>("draw"),     method<&nothing>("nothing"), method<&moved>("moved"),
          method<&sumUp>("sumUp"),   method<&knows>("knows"),     method<&fail>("fail"),
          method<&keep>("keep"),     method<&useKept>("useKept"), method<&largeText>("largeText")};
      Session(Channel(toWorker_[0], fromWorker_[1]), methods).serve();
    });
    caller = std::make_unique<Caller>(Channel(fromWorker_[0], toWorker_[1]), 99);
  }
  ~InProcessWorker() {
    ::close(toWorker_[1]);
    thread_.join();
    for (const int fd : {toWorker_[0], fromWorker_[0], fromWorker_[1]}) ::close(fd);
  }
  InProcessWorker(const InProcessWorker&) = delete;
  InProcessWorker& operator=(const InProcessWorker&) = delete;

  template <class F>
  Call<F> function(const std::string& name) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return Call<F>(*caller, static_cast<std::uint32_t>(found - kNames.begin()), name);
  }

  std::unique_ptr<Caller> caller;

 private:
  std::array<int, 2> toWorker_{};
  std::array<int, 2> fromWorker_{};
  std::thread thread_;
};

std::uint64_t signatureOfAll() {
  std::uint64_t hash = kEmptySignature;
  for (const std::uint64_t next :
       {functionHash<decltype(scaled)>("scaled"), functionHash<decltype(traceOf)>("traceOf"),
        functionHash<decltype(countTwice)>("countTwice"), functionHash<decltype(draw)>("draw"),
        functionHash<decltype(nothing)>("nothing"), functionHash<decltype(moved)>("moved"),
        functionHash<decltype(sumUp)>("sumUp"), functionHash<decltype(knows)>("knows"),
        functionHash<decltype(fail)>("fail"), functionHash<decltype(keep)>("keep"),
        functionHash<decltype(useKept)>("useKept"), functionHash<decltype(largeText)>("largeText")})
    hash = combineHashes(hash, next);
  return hash;
}

class Calls : public ::testing::Test {
 protected:
  void SetUp() override { worker.caller->handshake(signatureOfAll()); }
  InProcessWorker worker;
};

template <class F>
RemoteThrow thrownBy(F&& call) {
  try {
    static_cast<void>(call());
  } catch (const RemoteThrow& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return RemoteThrow("", {});
}

TEST(Handshake, RefusesAWorkerOfAnotherExercise) {
  InProcessWorker worker;
  EXPECT_THROW(worker.caller->handshake(signatureOfAll() + 1), ProtocolError);
}

TEST_F(Calls, ReturnWhatTheFunctionReturns) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(4, 1, 4);
  EXPECT_EQ(worker.function<decltype(scaled)>("scaled")(x, 2), 2 * x);
  EXPECT_EQ(worker.function<decltype(traceOf)>("traceOf")(Eigen::Matrix3d::Identity()), 3);
  EXPECT_EQ(worker.function<decltype(moved)>("moved")("a"), "a!");
  worker.function<decltype(nothing)>("nothing")();
  EXPECT_EQ(worker.caller->running(), "");
}

TEST_F(Calls, MakeAFreshObjectFromADescription) {
  EXPECT_EQ(worker.function<decltype(countTwice)>("countTwice")(5), 11);
  EXPECT_EQ(worker.function<decltype(countTwice)>("countTwice")(5), 11);
  EXPECT_EQ(worker.function<decltype(draw)>("draw")(SplitRng(Rng(4), 1)), SplitRng(Rng(4), 1).uniform());
}

// Run backwards, a generator of the grader gives its seed.
template <class Generator>
constexpr bool kCrosses = std::is_invocable_v<Call<decltype(draw)>, Generator>;
static_assert(kCrosses<SplitRng&> && kCrosses<SplitRng>);
static_assert(!kCrosses<Rng&> && !kCrosses<Rng> && !kCrosses<const Rng&>);

TEST_F(Calls, AnswerCallbacks) {
  const auto sumUpThere = worker.function<decltype(sumUp)>("sumUp");
  const Sums sums = sumUpThere([](int k) { return 10.0 * k; }, 4);
  EXPECT_EQ(sums.total, 60);
  EXPECT_THAT(sums.partial, ::testing::ElementsAre(0, 10, 30, 60));
  EXPECT_TRUE(worker.function<decltype(knows)>("knows")([](const Eigen::VectorXd&) {}));
  EXPECT_FALSE(worker.function<decltype(knows)>("knows")(nullptr));
}

TEST_F(Calls, NestInsideCallbacks) {
  const auto draws = worker.function<decltype(countTwice)>("countTwice");
  const auto sumUpThere = worker.function<decltype(sumUp)>("sumUp");
  const Sums sums =
      sumUpThere([&](int k) { return sumUpThere([&](int j) { return draws(j); }, k).total; }, 4);
  // countTwice(j) = 2 j + 1, whose sum below k is k^2; the squares below 4 add up to 14.
  EXPECT_EQ(sums.total, 14);
}

TEST_F(Calls, PassErrorsOfCallbacksOn) {
  const auto sumUpThere = worker.function<decltype(sumUp)>("sumUp");
  const RemoteThrow error =
      thrownBy([&] { return sumUpThere([](int) -> double { throw Error({.what = "bad angle"}); }, 1); });
  EXPECT_EQ(error.thrown().kind, Thrown::Kind::kError);
  EXPECT_EQ(error.thrown().text, "bad angle");
}

TEST_F(Calls, EndWhenACallbackFailsAndStayUsable) {
  const auto sumUpThere = worker.function<decltype(sumUp)>("sumUp");
  EXPECT_THROW(static_cast<void>(sumUpThere([](int) -> double { throw std::logic_error("stop"); }, 3)),
               std::logic_error);
  EXPECT_EQ(sumUpThere([](int) { return 1.0; }, 3).total, 3);
}

TEST_F(Calls, ReportWhatTheFunctionThrows) {
  const auto failThere = worker.function<decltype(fail)>("fail");
  const RemoteThrow error = thrownBy([&] { return failThere("error"); });
  EXPECT_EQ(error.thrown().kind, Thrown::Kind::kError);
  EXPECT_STREQ(error.what(), "threw rex::Error in fail: joint 'elbow': found 7, wanted 3");
  const RemoteThrow range = thrownBy([&] { return failThere("range"); });
  EXPECT_EQ(range.thrown().kind, Thrown::Kind::kException);
  EXPECT_EQ(range.thrown().type, "std::out_of_range");
  EXPECT_EQ(thrownBy([&] { return failThere("memory"); }).thrown().kind, Thrown::Kind::kBadAlloc);
  EXPECT_STREQ(thrownBy([&] { return failThere("number"); }).what(), "threw int in fail");
  EXPECT_EQ(thrownBy([&] { return failThere("large"); }).thrown().text.size(), 2000u);
  EXPECT_EQ(failThere("not at all"), 1);
}

TEST_F(Calls, DoNotLetCallbacksOutliveThem) {
  EXPECT_EQ(worker.function<decltype(keep)>("keep")([](int) { return 1.0; }), 0);
  EXPECT_THAT(thrownBy([&] { return worker.function<decltype(useKept)>("useKept")(); }).what(),
              HasSubstr("a function argument was used after the call it belongs to"));
}

TEST(ActiveCall, NeedsOne) {
  EXPECT_REX_ERROR(Session(Channel(-1, -1), {}).activeCall(), "no call is running");
}

// What a caller says to a worker that asks for the wrong argument of sumUp(term, count).
std::string answerToCallback(const std::function<double(int)>& term, std::uint32_t argument) {
  std::array<int, 2> toCaller{}, fromCaller{};
  if (::pipe2(toCaller.data(), O_CLOEXEC) != 0 || ::pipe2(fromCaller.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  constexpr std::uint64_t kSeed = 5;
  Channel(-1, toCaller[1]).send(Kind::kCallback, Rng(kSeed).next(), argument, Writer());
  Caller caller(Channel(toCaller[0], fromCaller[1]), kSeed);
  std::string answer;
  try {
    static_cast<void>(Call<decltype(sumUp)>(caller, 0, "sumUp")(term, 3));
  } catch (const ProtocolError& error) {
    answer = error.what();
  }
  for (const int fd : {toCaller[0], toCaller[1], fromCaller[0], fromCaller[1]}) ::close(fd);
  return answer;
}

TEST(Callbacks, AreRefusedUnlessTheyNameAFunction) {
  const auto term = [](int k) { return 1.0 * k; };
  EXPECT_EQ(answerToCallback(term, 1), "that argument is not a function");
  EXPECT_EQ(answerToCallback(nullptr, 0), "that argument is an empty function");
  EXPECT_EQ(answerToCallback(term, 2), "there is no such argument");
}

TEST_F(Calls, CarryLargeValuesUpToTheLimit) {
  const auto large = worker.function<decltype(largeText)>("largeText");
  EXPECT_EQ(large(10 << 20).size(), 10u << 20);
  EXPECT_THAT(thrownBy([&] { return large(17 << 20); }).what(), HasSubstr("found more than 16 MB"));
  EXPECT_THROW(static_cast<void>(worker.function<decltype(moved)>("moved")(std::string(17 << 20, 'x'))),
               std::length_error);
}

}  // namespace call_test
}  // namespace rex::remote
