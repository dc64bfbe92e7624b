#include "grading/grade.h"

#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "grading/known_mistakes.h"
#include "grading/worker_process.h"
#include "interface.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/paths.h"
#include "support/rounds.h"
#include "support/temporary_folder.h"

namespace rex::grading::grade_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

const std::filesystem::path kGood = ownFolder() / "tests" / "sample" / "good",
                            kControl = kGood.parent_path() / "worker.control";

RunnableCheck check(const std::string& id, Group group, std::function<void(Check&, Student&)> run) {
  return {.info = {.id = id, .points = 1, .group = group},
          .run = [run](Check& judge, remote::Caller& caller) {
            Student student(caller);
            run(judge, student);
          }};
}

GradeResult gradeGood(const std::vector<RunnableCheck>& checks,
                      std::uint64_t signature = Student::signature()) {
  return grade({}, checks, {.worker = kGood}, signature, [](const GradeResult&) {});
}

TEST(Grade, MeasuresTimesThatAreRecorded) {
  const auto result = gradeGood({check("timed", Group::kVisible, [](Check& judge, Student& student) {
    judge.near("square", student.square(3), 9, 1e-9);
    judge.recordTime("time of a square");
  })});
  const CheckResult& timed = result.checks.front();
  ASSERT_TRUE(timed.record);
  EXPECT_EQ(timed.record->name, "time of a square");
  EXPECT_EQ(timed.record->unit, "ms");
  EXPECT_GT(timed.record->value, 0);
  EXPECT_NEAR(timed.record->value, 1000 * timed.cpuSeconds, 1);
}

// A fresh worker is a program of its own, and what happens to it happens to the check.
TEST(Grade, AsksFreshWorkers) {
  const auto afresh = [](std::function<void(Check&, Student&)> run) {
    return [run](Check& judge, Student& student) {
      judge.near("square", student.square(3), 9, 1e-9);
      judge.askFreshWorker([&](remote::Caller& caller) {
        Student stranger(caller);
        run(judge, stranger);
      });
      judge.near("square after that", student.square(4), 16, 1e-9);
    };
  };
  const auto steps = [](Check& judge, Student& s) {
    judge.near("step", s.ikStep(Eigen::VectorXd::Zero(3), {1, 2, 3}), Eigen::Vector3d(1, 2, 3), 1e-9);
  };
  const auto gradeOf = [&](const std::string& worker, const auto& run) {
    GradingJob job = {.worker = kGood.parent_path() / worker, .limits = {.cpuSeconds = 2}};
    return grade({}, std::vector{check("afresh", Group::kVisible, run)}, job, Student::signature(),
                 [](const GradeResult&) {})
        .checks.front();
  };
  EXPECT_EQ(gradeOf("good", afresh(steps)).status, Outcome::kPass);
  const CheckResult wrong = gradeOf("good", afresh([](Check& judge, Student& s) {
                                      judge.near("square of a stranger", s.square(2), 5, 1e-9);
                                    }));
  EXPECT_EQ(wrong.status, Outcome::kFail);
  EXPECT_THAT(wrong.message, HasSubstr("square of a stranger: got 4, wanted 5"));
  const CheckResult fallen = gradeOf("segfault", afresh(steps));
  EXPECT_EQ(fallen.status, Outcome::kRuntimeError);
  EXPECT_EQ(fallen.function, "ikStep");
  EXPECT_THAT(fallen.message, HasSubstr("in ikStep"));
  const CheckResult thrown = gradeOf("throws_number", [&](Check& judge, Student& student) {
    judge.forEachCase(2, [&](int k) {
      if (k == 1) return judge.near("square", student.square(3), 9, 1e-9);
      afresh(steps)(judge, student);
    });
  });
  EXPECT_EQ(thrown.status, Outcome::kRuntimeError);
  EXPECT_THAT(thrown.message, HasSubstr("1 of 2 cases hold; case 1: threw int in ikStep"));
  EXPECT_EQ(gradeOf("loop", afresh(steps)).status, Outcome::kTimeLimit);
}

// The program squares, which is taken for a mistake here.
class KnownMistakesTest : public ::testing::Test {
 protected:
  std::vector<CheckResult> gradeWith(const std::filesystem::path& mistakes,
                                     const std::filesystem::path& sketches = {}) const {
    const auto asks = [](const std::string& id, Group group, double more, const std::string& byHand) {
      return check(id, group, [more, byHand](Check& judge, Student& student) {
        const auto suspicion = judge.ask(byHand);
        judge.forEachCase(2, [&](int k) {
          judge.near("square", student.square(k + 1.5), std::pow(k + 1.5, 2) + more, 1e-9);
        });
      });
    };
    const std::vector<RunnableCheck> checks = {
        asks("right", Group::kVisible, 0, ""), asks("wrong", Group::kVisible, 0.1, ""),
        asks("by-hand", Group::kVisible, 0.1, "Do you know?"), asks("unseen", Group::kHidden, 0.1, "")};
    const GradingJob job{.worker = kGood, .mistakes = mistakes, .sketches = sketches};
    return grade(
               {}, checks, job, Student::signature(), [](const GradeResult&) {}, Student::layouts())
        .checks;
  }

  TemporaryFolder temporary_;
  std::filesystem::path known_ = temporary_.path() / "known.tsv", seen_ = temporary_.path() / "seen.tsv";
};

TEST_F(KnownMistakesTest, AreAskedAboutInVisibleChecks) {
  const std::vector<CheckResult> before = gradeWith({}, seen_);
  EXPECT_THAT(before[1].message, EndsWith("(seed 1)"));
  EXPECT_THAT(before[2].message, EndsWith(". Do you know?"));
  const SketchedChecks seen = readSketchedChecks(fileText(seen_), "seen");
  std::vector<std::string> ids;
  for (const auto& [id, calls] : seen) ids.push_back(id);
  EXPECT_THAT(ids, ElementsAre("by-hand", "right", "wrong")) << "nothing of hidden checks";
  SketchedChecks right = seen;
  for (auto& [id, calls] : right)
    for (SketchedCall& call : calls) call.answer.size += 0.1;
  std::ofstream(known_) << toText(knownMistakes(right, {{"Is it squared?", seen}}));
  const std::vector<CheckResult> after = gradeWith(known_);
  EXPECT_EQ(after[0].message, "");
  EXPECT_EQ(after[1].message, before[1].message + ". Is it squared?");
  EXPECT_THAT(after[2].message, AllOf(EndsWith("(seed 1). Is it squared?"), Not(HasSubstr("Do you"))));
  EXPECT_EQ(after[3].message, before[3].message);
}

TEST_F(KnownMistakesTest, CostNothingIfTheirFileIsBroken) {
  std::ofstream(known_) << "mistake";
  EXPECT_THAT(gradeWith(known_)[2].message, EndsWith(". Do you know?"));
  EXPECT_THAT(gradeWith(temporary_.path() / "nowhere.tsv")[2].message, EndsWith(". Do you know?"));
}

TEST(Grade, NeverBlamesTheStudentForTheGrader) {
  const GradeResult result = gradeGood({
      check("fine", Group::kVisible, [](Check& judge, Student&) { judge.that("yes", true); }),
      check("throws", Group::kVisible, [](Check&, Student&) { throw std::runtime_error("oops"); }),
      check("hidden", Group::kHidden, [](Check&, Student&) { throw std::runtime_error("q = 0.25"); }),
      check("number", Group::kVisible, [](Check&, Student&) { throw 42; }),
      check("empty", Group::kVisible, [](Check&, Student&) {}),
  });
  EXPECT_EQ(result.outcome, Outcome::kGraderError);
  EXPECT_EQ(result.checks[0].status, Outcome::kPass);
  for (int k = 1; k < 5; ++k) EXPECT_EQ(result.checks[k].status, Outcome::kGraderError);
  const std::string fault = "the grader failed, which is not your fault: ";
  EXPECT_EQ(result.checks[1].message, fault + "oops");
  EXPECT_EQ(result.checks[2].message, fault + "the check ended with an exception");
  EXPECT_EQ(result.checks[3].message, fault + "the check ended with an exception");
  EXPECT_EQ(result.checks[4].message, fault + "check 'empty' states no requirement");
}

// Whatever goes wrong while the grader handles an answer is that answer's fault. Before the first answer, the
// end of the process that judges it is, too: a program has many ways to cost it time.
TEST(Grade, BlamesTheFileForTheEndOfItsJudge) {
  const auto afterAnAnswer = [](std::function<void(Check&)> then) {
    return [then](Check& judge, Student& student) {
      static_cast<void>(student.square(3));
      then(judge);
    };
  };
#ifdef __SANITIZE_ADDRESS__  // they turn SIGSEGV into an exit
  const auto fall = [](Check&) { std::raise(SIGILL); };
#else
  const auto fall = [](Check&) { std::raise(SIGSEGV); };
#endif
  const auto loop = [](Check&) {
    for (std::atomic<int> k = 0;;) ++k;
  };
  [[maybe_unused]] const auto fill = [](Check&) {
    std::vector<std::vector<double>> all;
    for (;;) all.emplace_back(1u << 24, 1.);
  };
  const auto overflow = [](Check& judge) {
    judge.near("sum", 1, std::numeric_limits<double>::infinity(), 1);
  };
  std::vector<RunnableCheck> checks = {
      check("falls", Group::kVisible, afterAnAnswer(fall)),
      check("overflows", Group::kVisible, afterAnAnswer(overflow)),
      check("hidden", Group::kHidden, afterAnAnswer(overflow)),
      check("kills", Group::kVisible, afterAnAnswer([](Check&) { std::raise(SIGKILL); })),
      check("falls before", Group::kVisible, [&](Check& judge, Student&) { fall(judge); }),
      check("uses up its time", Group::kHidden, [](Check&, Student&) { std::raise(SIGPROF); }),
      check("fine", Group::kVisible,
            [](Check& judge, Student& student) { judge.near("square", student.square(3), 9, 1e-9); })};
#ifndef __SANITIZE_ADDRESS__
  checks.push_back(check("fills", Group::kVisible, afterAnAnswer(fill)));
#endif
  if (isLongRun()) checks.push_back(check("loops", Group::kVisible, afterAnAnswer(loop)));
  const GradeResult result = gradeGood(checks);
  const std::string ended = "it crashed the grader, or cost it too much time or memory";
  const auto message = [&](std::size_t k) { return result.checks[k].message; };
  EXPECT_EQ(message(0), "what square returned could not be judged: " + ended);
  EXPECT_EQ(result.checks[0].function, "square");
  EXPECT_EQ(message(1),
            "what square returned could not be judged: check 'overflows' wants a value that is not finite");
  EXPECT_EQ(message(2), "what square returned could not be judged");
  for (std::size_t k = 0; k < checks.size(); ++k) {
    const bool isBefore = k == 4 || k == 5;
    EXPECT_EQ(result.checks[k].status, isBefore ? Outcome::kTimeLimit
                                       : k == 6 ? Outcome::kPass
                                                : Outcome::kFail)
        << checks[k].info.id << ": " << message(k);
    const std::string before =
        "ended the grader, or cost it too much time or memory, before the first answer";
    EXPECT_EQ(message(k) == before, isBefore);
  }
  EXPECT_EQ(result.score, 1);
}

// What copies of the grader find, put together, is what one finds; a check that ends its copy harms no other.
TEST(Grade, RunsChecksAtOnce) {
  const auto holds = [](Check& judge, Student& student) {
    judge.near("answer", student.ikStep(Eigen::VectorXd::Zero(7), Eigen::Vector3d(.1, .2, .3)),
               Eigen::Vector3d(.1, .2, .3), 1e-12);
  };
  const std::vector<RunnableCheck> checks = {
      check("a", Group::kVisible, holds),
      check("b", Group::kHidden,
            [](Check& judge, Student&) { judge.near("one", judge.rng().uniform(0, 1), 2, .1); }),
      check("c", Group::kVisible, [](Check&, Student&) { throw std::runtime_error("oops"); }),
      check("d", Group::kVisible, holds)};
  const auto run = [&](const std::vector<RunnableCheck>& some, int jobs) {
    int saved = 0;
    GradeResult result = grade({}, some, {.worker = kGood, .jobs = jobs}, Student::signature(),
                               [&](const GradeResult&) { ++saved; });
    EXPECT_EQ(saved, static_cast<int>(some.size()) + 1);
    return result;
  };
  const GradeResult one = run(checks, 1), several = run(checks, 3);
  EXPECT_EQ(several.outcome, Outcome::kGraderError);
  EXPECT_EQ(several.score, one.score);
  EXPECT_EQ(several.output.text, one.output.text);
  for (std::size_t k = 0; k < checks.size(); ++k) {
    EXPECT_EQ(several.checks[k].id, one.checks[k].id);
    EXPECT_EQ(several.checks[k].status, one.checks[k].status);
    EXPECT_EQ(several.checks[k].message, one.checks[k].message);
  }
  EXPECT_GT(several.usage.cpuSeconds, 0);

  const GradeResult dead =
      run({checks[0], check("dies", Group::kVisible, [](Check&, Student&) { ::_exit(5); }), checks[3]}, 2);
  EXPECT_EQ(dead.checks[0].status, Outcome::kPass);
  EXPECT_EQ(dead.checks[1].status, Outcome::kGraderError);
  EXPECT_THAT(dead.checks[1].message, HasSubstr("the check crashed its process"));
  EXPECT_EQ(dead.checks[2].status, Outcome::kPass);
  EXPECT_EQ(dead.outcome, Outcome::kGraderError);
}

TEST(Grade, RunsChecksInTheOrderOfTheJobAndListsThemInTheirOwn) {
  const auto holds = [](Check& judge, Student& student) { judge.near("square", student.square(3), 9, 1e-9); };
  const std::vector<RunnableCheck> checks = {
      check("a", Group::kVisible, holds), check("b", Group::kHidden, holds),
      check("c", Group::kVisible, holds), check("d", Group::kVisible, holds)};
  std::string order;
  const auto note = [&](const GradeResult& now) {
    for (const CheckResult& one : now.checks)
      if (one.status && order.find(one.id) == order.npos) order += one.id;
  };
  const GradeResult result =
      grade({}, checks, {.worker = kGood, .checks = {"b", "d", "a", "c"}}, Student::signature(), note);
  EXPECT_EQ(order, "dacb") << "hidden checks last";
  std::string listed;
  for (const CheckResult& one : result.checks) listed += one.id;
  EXPECT_EQ(listed, "abcd");
}

/// A number that copies of this process have in common.
class SharedCount {
 public:
  int& value() const { return *value_; }
  ~SharedCount() { ::munmap(value_, sizeof(int)); }

 private:
  int* value_ = static_cast<int*>(
      ::mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
};

// Whatever a hidden check tells those that run beside it, no visible one hears it.
TEST(Grade, RunsHiddenChecksLast) {
  const SharedCount shared;
  const auto visible = [&](Check& judge, Student& student) {
    ::usleep(100'000);
    judge.near("square", student.square(3), 9, 1e-9);
    ++shared.value();
  };
  const auto hidden = [&](Check& judge, Student&) { judge.that("all others are over", shared.value() == 2); };
  const std::vector<RunnableCheck> checks = {check("a", Group::kVisible, visible),
                                             check("b", Group::kHidden, hidden),
                                             check("c", Group::kVisible, visible)};
  const GradeResult result =
      grade({}, checks, {.worker = kGood, .jobs = 3}, Student::signature(), [](const GradeResult&) {});
  EXPECT_EQ(result.outcome, Outcome::kPass);
}

TEST(Grade, ContinuesAFirstPassToTheSameResult) {
  const auto ask = [](Check& judge, Student& student) {
    judge.near("square", student.square(judge.rng().uniform(1, 2)), 4, 1e-9);
  };
  const std::vector<RunnableCheck> checks = {check("a", Group::kHidden, ask),
                                             check("b", Group::kVisible, ask)};
  const auto run = [&](Pass pass, const GradeResult& start, std::span<const RunnableCheck> some) {
    return grade(start, some, {.worker = kGood, .pass = pass}, Student::signature(),
                 [](const GradeResult&) {});
  };
  const GradeResult whole = run(Pass::kWhole, {}, checks), first = run(Pass::kVisible, {}, checks),
                    second = run(Pass::kHidden, first, checks);
  EXPECT_TRUE(awaitsHiddenChecks(first));
  EXPECT_EQ(first.outcome, Outcome::kGraderError);
  EXPECT_EQ(first.checks[0].status, std::nullopt);
  EXPECT_EQ(first.checks[1].status, Outcome::kFail);
  EXPECT_EQ(computeSeal(toJson(second), ""), computeSeal(toJson(whole), ""));
  EXPECT_FALSE(awaitsHiddenChecks(second));
  EXPECT_FALSE(awaitsHiddenChecks(run(Pass::kVisible, {}, std::span(checks).subspan(1)))) << "it has none";
  const std::string nothing = "there are no results of a first pass to continue";
  EXPECT_REX_ERROR(run(Pass::kHidden, {}, checks), nothing);
  EXPECT_REX_ERROR(run(Pass::kHidden, whole, checks), nothing);
  EXPECT_REX_ERROR(run(Pass::kHidden, first, std::span(checks).subspan(1)), nothing);
}

TEST(Grade, DrawsVisibleChecksThatDoNotHold) {
  const auto off = [](Check& judge, Student&) {
    judge.near("states", Eigen::VectorXd::Zero(9), Eigen::VectorXd::Ones(9), .1);
  };
  const std::vector<RunnableCheck> checks = {check("seen", Group::kVisible, off),
                                             check("unseen", Group::kHidden, off)};
  const std::filesystem::path folder = freshFolderOfTest("evidence") / "checks";
  const GradeResult result = grade({}, checks, {.worker = kGood, .evidence = folder}, Student::signature(),
                                   [](const GradeResult&) {});
  EXPECT_EQ(result.checks[0].picture, "checks/seen.png");
  EXPECT_EQ(result.checks[1].picture, "");
  EXPECT_TRUE(std::filesystem::exists(folder / "seen.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "unseen.png"));
}

// A hand-in that finds a way to another one could send it what a hidden check asks.
// What a program prints as it ends, such as the text of an assertion, is output, too.
TEST(Grade, ShowsNoLastWordsBesideSecretChecks) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "secret") << "the secret of a course";
  const auto messageOf = [&](const std::filesystem::path& secret) {
    const auto ask = [](Check& judge, Student& student) {
      judge.that("moves", student.ikStep(Eigen::VectorXd::Zero(3), {1, 2, 3}).norm() > 0);
    };
    return grade({}, std::vector{check("a", Group::kVisible, ask), check("b", Group::kHidden, ask)},
                 {.worker = kGood.parent_path() / "assertion", .secret = secret}, Student::signature(),
                 [](const GradeResult&) {})
        .checks[0]
        .message;
  };
  EXPECT_THAT(messageOf({}), HasSubstr("Assertion"));
  EXPECT_THAT(messageOf(folder.path() / "secret"), ::testing::Not(HasSubstr("Assertion")));
}

TEST(Grade, ShowsNoOutputBesideSecretChecks) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "secret") << "the secret of a course";
  const auto outputOf = [&](Group second, const std::filesystem::path& secret) {
    const auto ask = [](Check& judge, Student& student) {
      judge.that("moves", student.ikStep(Eigen::VectorXd::Zero(3), {1, 2, 3}).norm() > 0);
    };
    return grade({}, std::vector{check("a", Group::kVisible, ask), check("b", second, ask)},
                 {.worker = kGood.parent_path() / "secrets", .secret = secret}, Student::signature(),
                 [](const GradeResult&) {})
        .output;
  };
  const KeptOutput open = outputOf(Group::kHidden, {}),
                   alone = outputOf(Group::kVisible, folder.path() / "secret"),
                   beside = outputOf(Group::kHidden, folder.path() / "secret");
  EXPECT_NE(open.text, "");
  EXPECT_NE(alone.text, "");
  EXPECT_EQ(beside.text, "");
  EXPECT_EQ(beside.truncatedBytes, open.text.size());
}

TEST(Grade, SavesBeforeTheFirstAndAfterEveryCheck) {
  const auto pass = [](Check& judge, Student& student) { judge.near("square", student.square(3), 9, 1e-9); };
  const std::vector<RunnableCheck> checks = {check("a", Group::kVisible, pass),
                                             check("b", Group::kVisible, pass)};
  std::vector<std::pair<Outcome, int>> saved;
  const GradeResult last = grade({}, checks, {.worker = kGood}, Student::signature(),
                                 [&](const GradeResult& now) { saved.emplace_back(now.outcome, now.score); });
  using ::testing::Pair;
  EXPECT_THAT(saved, ::testing::ElementsAre(Pair(Outcome::kGraderError, 0), Pair(Outcome::kGraderError, 1),
                                            Pair(Outcome::kPass, 2)));
  EXPECT_EQ(last.message, "");
}

// Sends it to all processes that this one started.
void signalChildren(int signal) {
  std::ifstream children("/proc/self/task/" + std::to_string(::getpid()) + "/children");
  for (pid_t child = 0; children >> child;) ::kill(child, signal);
}

TEST(Grade, AsksOnceMoreWhenSomebodyKilledTheWorkerOrItsJudge) {
  const SharedCount shared;
  int& attempts = shared.value();
  const auto killedBy = [&](const std::function<void()>& kill, int times) {
    attempts = 0;
    return gradeGood({check("a", Group::kVisible, [&, times](Check& judge, Student& student) {
      judge.near("square before", student.square(2), 4, 1e-9);
      if (attempts++ < times) kill();
      judge.near("square", student.square(3), 9, 1e-9);
    })});
  };
  const auto killedAtFirst = [&](int times) { return killedBy([] { signalChildren(SIGKILL); }, times); };
  EXPECT_EQ(killedBy([] { std::raise(SIGKILL); }, 1).outcome, Outcome::kPass);
  EXPECT_EQ(attempts, 2);
  EXPECT_EQ(killedAtFirst(0).outcome, Outcome::kPass);
  EXPECT_EQ(attempts, 1);
  EXPECT_EQ(killedAtFirst(1).outcome, Outcome::kPass);
  EXPECT_EQ(attempts, 2);
  const GradeResult twice = killedAtFirst(2);
  EXPECT_EQ(attempts, 2) << "no third time";
  EXPECT_EQ(twice.outcome, Outcome::kRuntimeError);
  EXPECT_EQ(twice.score, 0);
  EXPECT_THAT(twice.checks[0].message, HasSubstr("was killed"));
}

TEST(Grade, AsksAProgramThatFailsByItselfOnce) {
  const SharedCount shared;
  for (const char* program : {"segfault", "assertion"}) {
    shared.value() = 0;
    const auto ask = [&](Check& judge, Student& student) {
      ++shared.value();
      judge.near("step", student.ikStep(Eigen::Vector3d::Zero(), {1, 2, 3}), Eigen::Vector3d(1, 2, 3), 1e-9);
    };
    const GradingJob job = {.worker = kGood.parent_path() / program, .limits = {.cpuSeconds = 1}};
    static_cast<void>(grade({}, std::vector{check("a", Group::kVisible, ask)}, job, Student::signature(),
                            [](const GradeResult&) {}));
    EXPECT_EQ(shared.value(), 1) << program;
  }
}

// Processor time of all workers of a check, and all that was printed.
TEST(Grade, CountsWhatItsWorkersUse) {
  const auto ask = [](Check& judge, Student& student) {
    const Eigen::Vector3d target(1, 2, 3);
    const auto step = [&](Student& one) { judge.near("step", one.ikStep(target, target), target, 1e-9); };
    step(student);
    judge.askFreshWorker([&](remote::Caller& caller) {
      Student stranger(caller);
      step(stranger);
    });
  };
  const auto resultOf = [&](const char* program) {
    return grade({}, std::vector{check("a", Group::kVisible, ask), check("b", Group::kVisible, ask)},
                 {.worker = kGood.parent_path() / program}, Student::signature(), [](const GradeResult&) {});
  };
  EXPECT_GE(resultOf("busy").checks[0].cpuSeconds, 0.5);
  const GradeResult chatty = resultOf("chatty");
  EXPECT_EQ(chatty.output.text.size(), std::size_t{16} << 10);
  EXPECT_EQ(chatty.output.text.size() + chatty.output.truncatedBytes, 4 * 10'001u);
  EXPECT_EQ(chatty.usage.outputBytes, 4 * 10'001u);
}

/// A launcher that first does what a shell is told to do.
class SlowLauncher {
 public:
  explicit SlowLauncher(const std::string& before, double wallSeconds = 0.5) : wallSeconds_(wallSeconds) {
    std::ofstream(file_) << "#!/bin/sh\n"
                         << "cd '" << folder_.path().string() << "'\necho >> starts\n"
                         << before << "\nexec '" << (ownFolder() / "rex-sandbox").string() << "' \"$@\"\n";
    std::filesystem::permissions(file_, std::filesystem::perms::owner_all);
  }
  CheckResult grade() const {
    return grading::grade({}, std::vector{check("a", Group::kVisible, square)},
                          {.worker = kGood,
                           .control = kControl,
                           .limits = {.wallSeconds = wallSeconds_},
                           .sandbox = {.level = sandbox::Level::kFiles, .launcher = file_}},
                          Student::signature(), [](const GradeResult&) {})
        .checks.front();
  }
  std::uintmax_t starts() const { return std::filesystem::file_size(folder_.path() / "starts"); }

 private:
  static void square(Check& judge, Student& student) { judge.near("square", student.square(3), 9, 1e-9); }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "launcher";
  double wallSeconds_;
};

#ifndef __SANITIZE_ADDRESS__  // needs more addresses than a sandbox gives
TEST(Grade, DoesNotChargeTheStartOfTheSandbox) {
  const SlowLauncher slow("sleep 1"), slowAtFirst("mkdir once 2>/dev/null && sleep 100");
  EXPECT_EQ(slow.grade().status, Outcome::kPass) << slow.grade().message;
  EXPECT_EQ(slowAtFirst.grade().status, Outcome::kPass);
  EXPECT_EQ(slowAtFirst.starts(), 3) << "the worker, the control and another worker";
}

// Only workers are slow, not the control, which is every second program: nothing but the file can be to
// blame.
TEST(Grade, BlamesTheFileIfTheControlAnswers) {
  const SlowLauncher slowAtWorkers("[ $(($(wc -l < starts) % 2)) = 0 ] || sleep 100", 2);
  const CheckResult result = slowAtWorkers.grade();
  EXPECT_EQ(result.status, Outcome::kTimeLimit) << result.message;
  EXPECT_EQ(slowAtWorkers.starts(), 4);
}
#endif

TEST(Grade, IsToBlameIfNoWorkerStarts) {
  const SlowLauncher never("sleep 100");
  const CheckResult result = never.grade();
  EXPECT_EQ(result.status, Outcome::kGraderError);
  EXPECT_EQ(
      result.message,
      "the grader failed, which is not your fault: on this machine, even a program without your code does "
      "not answer in time");
  EXPECT_EQ(never.starts(), 4) << "two workers, two controls, and no third time";
}

GradeResult gradeWith(const std::string& program, const std::vector<RunnableCheck>& checks,
                      double wallSeconds, const std::filesystem::path& control = kControl) {
  return grade(
      {}, checks,
      {.worker = kGood.parent_path() / program, .control = control, .limits = {.wallSeconds = wallSeconds}},
      Student::signature(), [](const GradeResult&) {});
}

void asksForASquare(Check& judge, Student& student) { judge.near("square", student.square(3), 9, 1e-9); }
void asksForAStep(Check& judge, Student& student) {
  const Eigen::Vector3d target(1, 2, 3);
  judge.near("step", student.ikStep(target, target), target, 1e-9);
}

// Whatever a program does in the constructor of a global variable, the control does not do it.
TEST(Grade, BlamesWhatDelaysItsStart) {
  for (const char* program : {"sleep_at_start", "reads_disk_at_start", "mutters_at_start"}) {
    const GradeResult result = gradeWith(program, {check("a", Group::kVisible, asksForASquare)}, 1.5);
    EXPECT_EQ(result.outcome, Outcome::kTimeLimit) << program << ": " << result.checks[0].message;
    EXPECT_THAT(result.checks[0].message, HasSubstr("stopped after 3.5 s before the first call"));
  }
}

// A control that fails stands for a machine on which nothing is in time: a second attempt gets more time.
TEST(Grade, OwesAProgramTheTimeThatTheMachineTakes) {
  const std::vector<RunnableCheck> checks = {check("a", Group::kVisible, asksForAStep)};
  EXPECT_EQ(gradeWith("naps", checks, 1, "").outcome, Outcome::kTimeLimit);
  EXPECT_EQ(gradeWith("naps", checks, 1, kGood).outcome, Outcome::kPass);
}

// On a machine that is busy with other things, an honest worker may not get to run.
TEST(Grade, AsksOnceMoreWhenTheWorkerDidNotRun) {
  const SharedCount shared;
  const auto ask = [&](Check& judge, Student& student) {
    if (shared.value()++ == 0) signalChildren(SIGSTOP);
    asksForASquare(judge, student);
  };
  const GradeResult result = gradeWith("good", {check("a", Group::kVisible, ask)}, 1);
  EXPECT_EQ(result.outcome, Outcome::kPass) << result.checks[0].message;
  EXPECT_EQ(shared.value(), 2);
}

TEST(Grade, RunsNoMoreChecksAfterThreeThatSlept) {
  const auto squareFirst = [](Check& judge, Student& student) {
    asksForASquare(judge, student);
    asksForAStep(judge, student);
  };
  const auto last = [](const std::function<void(Check&, Student&)>& asks) {
    std::vector<RunnableCheck> checks;
    for (const char* id : {"a", "b", "c"}) checks.push_back(check(id, Group::kVisible, asks));
    for (const char* id : {"d", "e", "f", "g", "h", "i", "j"})
      checks.push_back(check(id, Group::kHidden, asksForASquare));
    return gradeWith("sleep", checks, 0.5, "").checks.back();
  };
  EXPECT_EQ(last(squareFirst).status, Outcome::kPass) << "they slept later";
  const CheckResult left = last(asksForAStep);
  EXPECT_EQ(left.status, Outcome::kTimeLimit);
  EXPECT_EQ(left.message, "was not run: in 3 checks, the program slept before or in its first call");
}

// Those of a first pass count in the second, and what it did not run is not run there either.
TEST(Grade, CountsChecksThatSleptInBothPasses) {
  std::vector<RunnableCheck> checks = {check("a", Group::kVisible, asksForAStep),
                                       check("b", Group::kVisible, asksForAStep),
                                       check("c", Group::kHidden, asksForAStep)};
  for (const char* id : {"d", "e", "f", "g", "h", "i", "j"})
    checks.push_back(check(id, Group::kHidden, asksForASquare));
  const auto run = [&](Pass pass, const GradeResult& start) {
    return grade(start, checks,
                 {.worker = kGood.parent_path() / "sleep", .pass = pass, .limits = {.wallSeconds = 0.3}},
                 Student::signature(), [](const GradeResult&) {});
  };
  const GradeResult first = run(Pass::kVisible, {});
  EXPECT_THAT(first.checks[1].message, HasSubstr("it gave no answer"));
  for (GradeResult result : {run(Pass::kHidden, first), run(Pass::kWhole, {})})
    EXPECT_THAT(result.checks.back().message, HasSubstr("in 3 checks, the program slept"));
  GradeResult spent = first;
  spent.checks[1].message = "was not run: of some cause";
  EXPECT_EQ(run(Pass::kHidden, spent).checks[2].message, "was not run: of some cause");
}

// Each check takes twice its time, so that less than half of them use up the time of all and of three more.
TEST(Grade, HasOneBudgetForAllChecks) {
  const auto late = [](Check& judge, Student& student) {
    asksForASquare(judge, student);
    asksForAStep(judge, student);
  };
  const GradeResult result =
      gradeWith("sleep", std::vector<RunnableCheck>(12, check("a", Group::kVisible, late)), 0.2, "");
  EXPECT_EQ(result.outcome, Outcome::kTimeLimit);
  EXPECT_THAT(result.checks[0].message, HasSubstr("stopped after 0.2 s in ikStep"));
  EXPECT_EQ(result.checks[11].message, "was not run: the checks before it took more than 3 s");
  EXPECT_EQ(result.checks[11].status, Outcome::kTimeLimit);
}

TEST(Grade, RefusesAWorkerOfAnotherExercise) {
  const GradeResult result =
      gradeGood({check("a", Group::kVisible, [](Check& judge, Student&) { judge.that("yes", true); })}, 1);
  EXPECT_EQ(result.outcome, Outcome::kProtocolError);
  EXPECT_EQ(result.checks[0].message,
            "corrupted the connection to the grader before the first call: the worker was built from another "
            "exercise.h");
}

TEST(Grade, StopsAStudentsFunctionWhenACallbackOfTheCheckFails) {
  const GradeResult result = gradeGood({check("a", Group::kVisible, [](Check& judge, Student& student) {
    judge.forEachCase(2, [&](int k) {
      const Reached reached = student.search(Eigen::VectorXd::Ones(2), [&](const Eigen::VectorXd& q) {
        judge.that("asks for the right size", k == 1);
        return q.sum();
      });
      judge.near("distance", reached.distance, 1, 1e-12);
    });
  })});
  EXPECT_EQ(result.checks[0].status, Outcome::kFail);
  EXPECT_THAT(result.checks[0].message, HasSubstr("1 of 2 cases hold; case 1: asks for the right size"));
}

TEST(RunWithWorker, RefusesWhatCannotBeStarted) {
  const auto run = [](const GradingJob& job) {
    return runWithWorker(job, "part", 0, [](remote::Caller&) {});
  };
  EXPECT_REX_ERROR(run({.worker = "no-such-worker"}),
                   "cannot start the worker no-such-worker: found No such file");
  EXPECT_REX_ERROR(run({.worker = kGood, .temporaryFolder = "/no/such/folder"}),
                   "cannot make a temporary folder in /no/such/folder");
  EXPECT_REX_ERROR(run({.worker = kGood, .sandbox = {.level = sandbox::Level{1}, .launcher = "/bin/true"}}),
                   "the sandbox of level 1 cannot be set up");
}

// The time that the grader needs for itself is not the student's.
TEST(RunWithWorker, CountsOnlyTheTimeItWaits) {
  const WorkerRun run = runWithWorker({.worker = kGood, .limits = {.wallSeconds = 1}}, "",
                                      Student::signature(), [](remote::Caller& caller) {
                                        ::timespec pause{1, 300'000'000};
                                        ::nanosleep(&pause, nullptr);
                                        EXPECT_EQ(Student(caller).square(3), 9);
                                      });
  EXPECT_FALSE(run.failure.has_value());
  EXPECT_LT(run.wallSeconds, 1);
  EXPECT_GT(run.peakMemoryBytes, 0);
}

// A quarter of a second of work.
TEST(RunWithWorker, WaitsAsLongAsItIsTold) {
  const auto run = [](double patience) {
    const auto ask = [](remote::Caller& caller) {
      static_cast<void>(Student(caller).ikStep(Eigen::Vector3d::Zero(), {1, 2, 3}));
    };
    return runWithWorker({.worker = kGood.parent_path() / "busy", .limits = {.wallSeconds = 0.1}}, "",
                         Student::signature(), ask, patience)
        .failure;
  };
  EXPECT_FALSE(run(1000).has_value());
  ASSERT_TRUE(run(1).has_value());
  EXPECT_EQ(run(1)->message, "stopped after 0.1 s in ikStep (asleep, blocked, or in an infinite loop?)");
  EXPECT_TRUE(run(1)->mayBeOfMachine);
}

TEST(SlownessOfMachine, IsFoundByAProgramWithoutTheStudents) {
  const auto slowness = [](const std::filesystem::path& control, std::uint64_t signature) {
    return slownessOfMachine({.worker = "none", .parts = {""}, .control = control}, signature);
  };
  EXPECT_GE(slowness(kControl, Student::signature()), 1);
  EXPECT_EQ(slowness("", Student::signature()), 1);
  EXPECT_EQ(slowness(kControl, 1), std::nullopt);
  EXPECT_EQ(slowness(kGood, Student::signature()), std::nullopt) << "it does not answer";
}

// What a program prints a byte at a time costs it more than us.
TEST(RunWithWorker, IsNotMadeToWorkByOutput) {
  const std::clock_t start = std::clock();
  const WorkerRun run =
      runWithWorker({.worker = kGood.parent_path() / "mutters_at_start", .limits = {.wallSeconds = 1}}, "",
                    Student::signature(), [](remote::Caller&) {});
  EXPECT_EQ(run.failure->outcome, Outcome::kTimeLimit);
  EXPECT_GT(run.output.bytes, 1000u);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.3);
}

}  // namespace rex::grading::grade_test
