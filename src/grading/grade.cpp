#include "grading/grade.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/time.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/folders.h"
#include "base/process.h"
#include "base/process_pool.h"
#include "base/sha256.h"
#include "grading/heard_checks.h"
#include "grading/hidden_seed.h"
#include "grading/results.h"
#include "grading/worker_process.h"
#include "remote/channel.h"
#include "sandbox/probes.h"

namespace rex::grading {
namespace {

constexpr std::size_t kLongestMessage = 2000;
constexpr std::size_t kKeptOutput = 16u << 10;
constexpr const char* kUnfinished = "the grader did not finish";
constexpr const char *kNotRun = "was not run: ", *kNoAnswer = "; it gave no answer";
constexpr rlim_t kJudgingMemory = rlim_t{6} << 30;

/// A job, and what all of its checks share.
struct Grading {
  const GradingJob& job;
  std::uint64_t signature = 0;
  std::string secret{};  ///< of the course; empty: there is none
  bool hasSecretChecks = false;
  const CallLayouts& layouts;

  bool sketches(const CheckInfo& info) const {
    return info.group == Group::kVisible && !(job.mistakes.empty() && job.sketches.empty());
  }
};

CheckResult blank(const CheckInfo& info) {
  return {
      .id = info.id, .part = info.part, .title = info.title, .group = info.group, .maxPoints = info.points};
}

CheckResult faulty(const CheckInfo& info, const std::string& why) {
  CheckResult check = blank(info);
  check.status = Outcome::kGraderError;
  check.message = printable("the grader failed, which is not your fault: " + why, kLongestMessage);
  return check;
}

// A program that cannot print its input could still reveal it by an exit code or the name of a type.
std::string messageWithoutDetails(const Failure& failure) {
  const auto what = [&] {
    switch (failure.outcome) {
      case Outcome::kTimeLimit:
        return "took too much time";
      case Outcome::kMemoryLimit:
        return "used too much memory";
      case Outcome::kOutputLimit:
        return "printed too much";
      case Outcome::kProtocolError:
        return "disturbed the connection to the grader";
      case Outcome::kSecurityEvent:
        return "tried something that the sandbox forbids";
      case Outcome::kRuntimeError:
      case Outcome::kCompileError:
      case Outcome::kGraderError:
      case Outcome::kFail:
      case Outcome::kPass:
        break;
    }
    return "crashed, threw an exception or ended the program";
  }();
  return fmt::format("{} {}", what,
                     failure.function.empty() ? "outside your functions" : "in " + failure.function);
}

// What a program prints as it crashes is its output, too: see KeptOutput.
CheckResult failed(const CheckInfo& info, const Failure& failure, const std::string& input,
                   bool hasSecretChecks) {
  CheckResult check = blank(info);
  check.status = failure.outcome;
  check.function = failure.function;
  check.message = messageWithoutDetails(failure);
  if (info.group == Group::kHidden) return check;
  const std::string detail = failure.detail.empty() || hasSecretChecks ? "" : ": " + failure.detail;
  check.message = printable(failure.message + detail, kLongestMessage);
  check.input = printable(input, kLongestMessage);
  return check;
}

// Whatever goes wrong once a value of the student's has been read is for the student to fix, if only by
// returning values that can be judged: the gates of the exercise prove that it does not happen with the
// reference solution.
CheckResult unjudged(const CheckInfo& info, const std::string& function, const std::string& why) {
  CheckResult check = blank(info);
  check.status = Outcome::kFail;
  check.function = function;
  check.message = fmt::format("what {} returned could not be judged", function);
  if (info.group == Group::kVisible && !why.empty()) check.message += ": " + why;
  check.message = printable(check.message, kLongestMessage);
  return check;
}

// The message of a fault in a hidden check could quote its input.
CheckResult faultyBy(const CheckInfo& info, const std::exception* error) {
  const bool tell = info.group == Group::kVisible && error != nullptr;
  return faulty(info, tell ? error->what() : "the check ended with an exception");
}

void keep(KeptOutput& kept, const CapturedText& captured, std::size_t most) {
  const std::size_t room = most - std::min(most, kept.text.size());
  const std::size_t taken = std::min(room, captured.text.size());
  kept.text += printable(std::string_view(captured.text).substr(0, taken), 3 * kKeptOutput);
  kept.truncatedBytes += captured.bytes - taken;
}

// Everybody can repeat the visible checks. The seed of the hidden ones depends on what was handed in: the
// same file gets the same grade again, and a table of answers helps nobody else.
std::uint64_t seedFor(Group group, const GradeResult& whole, const Grading& grading) {
  if (group == Group::kVisible || grading.secret.empty()) return grading.job.seed;
  return hiddenSeed(grading.secret, whole.snapshotSha256, whole.exerciseId, "hidden");
}

std::string seedIdOf(const Grading& grading) {
  const std::string visible = fmt::format("public:{}", grading.job.seed);
  return grading.secret.empty() ? visible
                                : fmt::format("{} hidden:{}", visible, sha256(grading.secret).substr(0, 8));
}

// "position of the hand: got 1 m, wanted at most 0.5 m"
std::string failureOf(const CheckResult& check) {
  std::string text = check.property;
  if (!check.got.empty()) text += ": got " + check.got;
  if (!check.expected.empty()) text += ", wanted " + check.expected;
  return text;
}

// A picture helps but decides nothing: if the numbers cannot be drawn, there is none.
void keepEvidence(const Check& judge, const std::filesystem::path& folder, CheckResult& verdict) {
  if (folder.empty() || !judge.evidence() || verdict.status == Outcome::kPass) return;
  const auto named = [&](const std::string& file) {
    return file.empty() ? file : (folder.filename() / file).generic_string();
  };
  try {
    const EvidenceText text{.title = verdict.title, .failure = failureOf(verdict)};
    const EvidenceFiles files = writeEvidence(*judge.evidence(), verdict.id, text, folder);
    verdict.picture = named(files.picture);
    verdict.replay = named(files.replay);
  } catch (const Error&) {
  }
}

CheckResult outOfTime(const CheckInfo& info, const std::string& why) {
  CheckResult check = blank(info);
  check.status = Outcome::kTimeLimit;
  check.message = why;
  return check;
}

/// What is known about a check so far, written down in case judging it ends the process: that the file is to
/// blame, until something else is proven.
class Standing {
 public:
  Standing(const CheckInfo& info, std::function<void(const CheckResult&)> write) : write_(std::move(write)) {
    keep(outOfTime(info, "ended the grader, or cost it too much time or memory, before the first answer"));
  }

  void answeredBy(const CheckInfo& info, const std::string& function) {
    function_ = function;
    keep(unjudged(info, function, "it crashed the grader, or cost it too much time or memory"));
  }
  void keep(const CheckResult& verdict) { write_(verdict); }

  /// The student's function whose values were read first; empty: none yet.
  const std::string& function() const { return function_; }

 private:
  std::function<void(const CheckResult&)> write_;
  std::string function_{};
};

/// The outcome of one check with a worker of its own.
struct Attempt {
  WorkerRun run;
  CheckResult verdict;
  bool slept = false;  ///< before or in its first call
  Heard heard{};
};

/// Thrown through a check function if a worker failed that it had started beside its first one.
struct FreshWorkerFailed {
  Failure failure;
};

void addUsage(WorkerRun& whole, const WorkerRun& part) {
  whole.cpuSeconds += part.cpuSeconds;
  whole.wallSeconds += part.wallSeconds;
  whole.peakMemoryBytes = std::max(whole.peakMemoryBytes, part.peakMemoryBytes);
  whole.output.text += part.output.text;
  whole.output.bytes += part.output.bytes;
  whole.error.text += part.error.text;
  whole.error.bytes += part.error.bytes;
}

bool isLate(const WorkerRun& run) {
  return run.failure && run.failure->mayBeOfMachine && run.failure->outcome == Outcome::kTimeLimit;
}

Attempt attempt(const RunnableCheck& check, const Grading& grading, std::uint64_t seed, Standing& standing,
                double patience) {
  CheckResult verdict = faulty(check.info, "the check did not end");
  Check judge(check.info, seed);
  bool hasAnswered = false;
  CallSketcher sketcher(grading.layouts);
  if (grading.sketches(check.info)) judge.watchCases([&](bool) { sketcher.nextCase(); });
  const auto converse = [&](const Check::Conversation& conversation) {
    const auto listening = [&](remote::Caller& caller) {
      caller.whenFirstAnswered([&](const std::string& function) {
        hasAnswered = true;
        standing.answeredBy(check.info, function);
      });
      if (grading.sketches(check.info))
        caller.listen([&](auto&&... call) { sketcher.hear(std::forward<decltype(call)>(call)...); });
      conversation(caller);
    };
    return runWithWorker(grading.job, check.info.part, grading.signature, listening, patience);
  };
  WorkerRun fresh;
  judge.startWorkersBy([&](const Check::Conversation& conversation) {
    std::exception_ptr thrown;  // by the check, or by the student's function, which only fails the case
    const WorkerRun run = converse([&](remote::Caller& caller) {
      try {
        conversation(caller);
      } catch (const remote::Closed&) {
        throw;
      } catch (const remote::ProtocolError&) {
        throw;
      } catch (...) {
        thrown = std::current_exception();
      }
    });
    addUsage(fresh, run);
    if (run.failure) throw FreshWorkerFailed{*run.failure};
    if (thrown) std::rethrow_exception(thrown);
  });
  std::optional<Failure> failure;
  WorkerRun run = converse([&](remote::Caller& caller) {
    judge.nameFunctionsBy([&] { return caller.lastCalled(); });
    try {
      verdict = judge.judge([&](Check& requirements) { check.run(requirements, caller); });
    } catch (const FreshWorkerFailed& failed) {
      failure = failed.failure;
    }
  });
  addUsage(run, fresh);
  if (!run.failure) run.failure = std::move(failure);
  if (verdict.record && judge.recordsTime()) verdict.record->value = 1000 * run.cpuSeconds;
  if (run.failure) {
    verdict = failed(check.info, *run.failure, judge.input(), grading.hasSecretChecks);
  } else {
    standing.keep(verdict);  // in case the picture ends this process
    keepEvidence(judge, grading.job.evidence, verdict);
  }
  const bool slept = isLate(run) && !hasAnswered;
  if (slept && check.info.group == Group::kVisible) verdict.message += kNoAnswer;
  return {std::move(run), std::move(verdict), slept, {std::move(sketcher).take(), judge.asked()}};
}

// The longest that a busy machine makes us wait.
double patienceFor(const std::optional<double>& slowness) {
  constexpr double kMost = 4;
  return std::min(slowness.value_or(kMost), kMost);
}

// The second attempt asks the same questions, so a program gains nothing by killing itself. It is owed the
// time that the machine takes now; if it is late again, the control alone tells who is to blame.
Attempt attemptTwiceIfNeeded(const RunnableCheck& check, const Grading& grading, std::uint64_t seed,
                             Standing& standing) {
  const auto slowness = [&] { return slownessOfMachine(grading.job, grading.signature); };
  Attempt first = attempt(check, grading, seed, standing, 1);
  if (!first.run.failure || !first.run.failure->mayBeOfMachine) return first;
  Attempt second = attempt(check, grading, seed, standing, isLate(first.run) ? patienceFor(slowness()) : 1);
  second.run.cpuSeconds += first.run.cpuSeconds;
  if (isLate(second.run) && !slowness()) {
    second.verdict =
        faulty(check.info, "on this machine, even a program without your code does not answer in time");
    second.slept = false;
  }
  return second;
}

/// Runs one check and adds what the worker used and printed to the whole. Tells if the program `slept`, and
/// what was `heard`.
CheckResult runCheck(const RunnableCheck& check, const Grading& grading, GradeResult& whole,
                     Standing& standing, bool& slept, Heard& heard) {
  CheckResult verdict;
  const auto brokenBy = [&](const std::exception* error) {
    return standing.function().empty()
               ? faultyBy(check.info, error)
               : unjudged(check.info, standing.function(), error != nullptr ? error->what() : "");
  };
  try {
    Attempt last = attemptTwiceIfNeeded(check, grading, seedFor(check.info.group, whole, grading), standing);
    const WorkerRun& run = last.run;
    slept = last.slept;
    heard = std::move(last.heard);
    verdict = last.verdict;
    verdict.cpuSeconds = run.cpuSeconds;
    verdict.wallSeconds = run.wallSeconds;
    whole.usage.cpuSeconds += run.cpuSeconds;
    whole.usage.wallSeconds += run.wallSeconds;
    whole.usage.peakMemoryBytes = std::max(whole.usage.peakMemoryBytes, run.peakMemoryBytes);
    whole.usage.outputBytes += run.output.bytes + run.error.bytes;
    // What a program prints in a hidden check may be that check's input. Another hand-in that is graded at
    // the same time may have found a way to pass its own to this one.
    if (check.info.group == Group::kVisible) {
      const std::size_t room = grading.hasSecretChecks ? 0 : kKeptOutput;
      keep(whole.output, run.output, room);
      keep(whole.error, run.error, room);
    }
  } catch (const std::exception& error) {
    return brokenBy(&error);
  } catch (...) {
    return brokenBy(nullptr);
  }
  return verdict;
}

// A fault of the grader outweighs everything. Otherwise the first check that did not pass decides, where
// crashes and exceeded limits come before plain failures.
Outcome overallOutcome(const std::vector<CheckResult>& checks) {
  Outcome overall = Outcome::kPass;
  for (const CheckResult& check : checks) {
    const Outcome status = check.status.value_or(Outcome::kGraderError);
    if (status == Outcome::kGraderError) return status;
    if (overall == Outcome::kPass || (overall == Outcome::kFail && status != Outcome::kPass))
      overall = status;
  }
  return overall;
}

void append(KeptOutput& kept, const KeptOutput& more) {
  const std::size_t taken = std::min(kKeptOutput - std::min(kKeptOutput, kept.text.size()), more.text.size());
  kept.text += more.text.substr(0, taken);
  kept.truncatedBytes += more.truncatedBytes + (more.text.size() - taken);
}

// Adds `part`, the result of check k alone.
void add(GradeResult& whole, std::size_t k, const GradeResult& part) {
  whole.checks[k] = part.checks.front();
  whole.score += part.checks.front().points;
  whole.usage.cpuSeconds += part.usage.cpuSeconds;
  whole.usage.wallSeconds += part.usage.wallSeconds;
  whole.usage.peakMemoryBytes = std::max(whole.usage.peakMemoryBytes, part.usage.peakMemoryBytes);
  whole.usage.outputBytes += part.usage.outputBytes;
  append(whole.output, part.output);
  append(whole.error, part.error);
}

// Limits the copy of this process in which a check is judged. The worker has limits of its own.
void limitJudging([[maybe_unused]] const Limits& limits) {
  const itimerval time{.it_interval = {}, .it_value = {.tv_sec = kJudgingSeconds, .tv_usec = 0}};
  ::setitimer(ITIMER_PROF, &time, nullptr);
#ifndef __SANITIZE_ADDRESS__
  if (limits.sanitized) return;  // its worker reserves terabytes
  rlimit memory{};
  ::getrlimit(RLIMIT_AS, &memory);
  memory.rlim_cur = std::min<rlim_t>(memory.rlim_max, kJudgingMemory);
  ::setrlimit(RLIMIT_AS, &memory);
#endif
}

/// What a file may use for all of its checks: as much as they may one after the other, and three more. Second
/// attempts and waiting are paid from it.
class Budget {
 public:
  /// `start` tells what a first pass has used.
  Budget(const Grading& grading, const GradeResult& start)
      : grading_(grading),
        checks_(static_cast<double>(start.checks.size() + kMostAsleep)),
        cpuSeconds_(start.usage.cpuSeconds),
        before_(start.usage.wallSeconds) {
    for (const CheckResult& check : start.checks) {
      if (check.status != Outcome::kTimeLimit) continue;
      if (check.message.starts_with(kNotRun)) whySpent_ = check.message;
      if (check.message.ends_with(kNoAnswer)) ++asleep_;
    }
  }

  void pay(const GradeResult& part, bool slept) {
    cpuSeconds_ += part.usage.cpuSeconds;
    if (slept) ++asleep_;
  }
  /// Why there is no time for another check; empty: there is.
  std::string whySpent() const {
    const Limits& limits = grading_.job.limits;
    const double cpu = checks_ * limits.cpuBudget(), wall = checks_ * limits.wallBudget();
    if (!whySpent_.empty()) return whySpent_;
    if (asleep_ >= kMostAsleep)
      return fmt::format("{}in {} checks, the program slept before or in its first call", kNotRun, asleep_);
    if (cpuSeconds_ > cpu)
      return fmt::format("{}the checks before it used more than {:g} s of CPU time", kNotRun, cpu);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
    const double used = before_ + took.count();
    if (used <= wall || used <= wall * patienceFor(slownessOfMachine(grading_.job, grading_.signature)))
      return {};
    return fmt::format("{}the checks before it took more than {:g} s", kNotRun, wall);
  }

 private:
  static constexpr int kMostAsleep = 3;
  const Grading& grading_;
  double checks_, cpuSeconds_, before_;
  int asleep_ = 0;
  std::string whySpent_{};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs each check in a copy of this process. The results stay here, so nothing that happens while an answer
/// is judged can harm them.
class Copies {
 public:
  /// Calls `ended(k, part)` as each check ends, in any order.
  Copies(const GradeResult& start, std::span<const RunnableCheck> checks, const Grading& grading,
         std::function<void(std::size_t, GradeResult)> ended)
      : start_(start), checks_(checks), grading_(grading), ended_(std::move(ended)) {}

  /// In the order of the job, if it names checks. A copy that is killed, perhaps because the machine is short
  /// of memory, gets a second try.
  void run(Group group) {
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < checks_.size(); ++k)
      if (checks_[k].info.group == group) numbers.push_back(k);
    const std::vector<std::string>& named = grading_.job.checks;
    const auto place = [&](std::size_t k) { return std::ranges::find(named, checks_[k].info.id); };
    std::ranges::stable_sort(numbers, {}, place);
    for (const bool isLast : {false, true}) {
      std::vector<std::size_t> killed;
      forkMap(
          static_cast<int>(numbers.size()), grading_.job.jobs,
          [&](int n) { return runHere(numbers[static_cast<std::size_t>(n)]); },
          [&](int n, int code) {
            const std::size_t k = numbers[static_cast<std::size_t>(n)];
            if (code == -SIGKILL && !isLast)
              killed.push_back(k);
            else
              take(k, code);
          });
      numbers = std::move(killed);
    }
  }

  /// In the visible checks that have ended.
  const HeardChecks& heard() const { return heard_; }

 private:
  static constexpr int kSlept = 2;
  std::filesystem::path file(std::size_t k) const { return folder_.path() / fmt::format("{}.json", k); }

  int runHere(std::size_t k) const {
    limitJudging(grading_.job.limits);
    GradeResult part;
    part.snapshotSha256 = start_.snapshotSha256;
    part.exerciseId = start_.exerciseId;
    const auto write = [&](const CheckResult& verdict) {
      part.checks = {verdict};
      saveResult(part, file(k));
    };
    if (const std::string why = budget_.whySpent(); !why.empty()) {
      write(outOfTime(checks_[k].info, why));
      return 0;
    }
    Standing standing(checks_[k].info, write);
    bool slept = false;
    Heard heard;
    write(runCheck(checks_[k], grading_, part, standing, slept, heard));
    if (grading_.sketches(checks_[k].info)) heard_.keep(k, heard);
    return slept ? kSlept : 0;
  }

  // With another exit code no result could be written, which is the machine's fault.
  void take(std::size_t k, int code) {
    const bool stands = (code <= 0 || code == kSlept) && std::filesystem::exists(file(k));
    GradeResult part;
    if (stands)
      part = loadResult(file(k));
    else
      part.checks = {faulty(checks_[k].info, "the check crashed its process")};
    budget_.pay(part, code == kSlept);
    ended_(k, std::move(part));
  }

  const GradeResult& start_;
  std::span<const RunnableCheck> checks_;
  const Grading& grading_;
  std::function<void(std::size_t, GradeResult)> ended_;
  PrivateFolder folder_{grading_.job.temporaryFolder};
  HeardChecks heard_{folder_.path()};
  Budget budget_{grading_, start_};
};

void clear(GradeResult& result, std::span<const RunnableCheck> checks) {
  result.checks.clear();
  result.score = result.maxScore = 0;
  for (const RunnableCheck& check : checks) {
    result.checks.push_back(blank(check.info));
    result.maxScore += check.info.points;
  }
  result.output = result.error = {};
  result.usage = {};
}

void requireFirstPass(const GradeResult& result, std::span<const RunnableCheck> checks) {
  const bool isOfThese =
      std::equal(checks.begin(), checks.end(), result.checks.begin(), result.checks.end(),
                 [](const RunnableCheck& check, const CheckResult& one) { return check.info.id == one.id; });
  if (!isOfThese || !awaitsHiddenChecks(result))
    throw Error({.what = "there are no results of a first pass to continue"});
}

}  // namespace

void setSandbox(GradeResult& result, sandbox::Level level) {
  result.sandboxLevel = sandbox::numberOf(level);
  const std::string warning = sandbox::levelWarning(level);
  result.sandboxWarnings = warning.empty() ? std::vector<std::string>{} : std::vector{warning};
}

GradeResult grade(GradeResult result, std::span<const RunnableCheck> checks, const GradingJob& job,
                  std::uint64_t signature, const std::function<void(const GradeResult&)>& save,
                  const CallLayouts& layouts) {
  const std::string secret = job.secret.empty() ? "" : readCourseSecret(job.secret);
  const bool hasHidden = std::any_of(checks.begin(), checks.end(), [](const RunnableCheck& check) {
    return check.info.group == Group::kHidden;
  });
  const Grading grading{.job = job,
                        .signature = signature,
                        .secret = secret,
                        .hasSecretChecks = hasHidden && !secret.empty(),
                        .layouts = layouts};
  if (job.pass == Pass::kHidden)
    requireFirstPass(result, checks);
  else
    clear(result, checks);
  result.limits = job.limits;
  result.seedId = seedIdOf(grading);
  if (job.worker.empty()) {
    save(result);
    return result;
  }
  setSandbox(result, job.sandbox.level);
  result.outcome = Outcome::kGraderError;
  result.message = kUnfinished;
  save(result);
  const GradeResult start = result;
  std::map<std::size_t, GradeResult> parts;  // put together in the order of the checks
  const auto saveParts = [&] {
    result = start;
    for (const auto& [place, one] : parts) add(result, place, one);
    if (std::all_of(result.checks.begin(), result.checks.end(), [](const auto& one) { return one.status; })) {
      result.outcome = overallOutcome(result.checks);
      result.message.clear();
    }
    save(result);
  };
  Copies copies(start, checks, grading, [&](std::size_t k, GradeResult part) {
    parts.emplace(k, std::move(part));
    saveParts();
  });
  if (job.pass != Pass::kHidden) {
    copies.run(Group::kVisible);
    std::vector<std::pair<std::size_t, CheckResult*>> visible;
    for (auto& [k, part] : parts) visible.emplace_back(k, &part.checks.front());
    if (copies.heard().askAboutMistakes(job, visible)) saveParts();
  }
  if (job.pass != Pass::kVisible) copies.run(Group::kHidden);
  return result;
}

}  // namespace rex::grading
