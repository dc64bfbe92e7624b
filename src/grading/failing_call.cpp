#include "grading/failing_call.h"

#include <cstdio>
#include <memory>
#include <optional>

#include "base/error.h"
#include "grading/worker_process.h"
#include "remote/channel.h"

namespace rex::grading {
namespace {

/// Thrown through a check once a case has failed.
struct CaseFailed {};

struct Call {
  std::uint32_t method = 0;
  std::string function{};
  remote::Writer arguments{};
};

void writeMessage(const Call& call, const std::filesystem::path& file) {
  const Error failure({.what = "cannot write the call", .where = {file.string()}});
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(file.c_str(), "wb"), &std::fclose);
  if (!opened) throw failure;
  try {
    remote::Channel(-1, ::fileno(opened.get())).send(remote::Kind::kCall, 1, call.method, call.arguments);
  } catch (const remote::Closed&) {
    throw failure;
  }
}

}  // namespace

std::string writeFailingCall(const RunnableCheck& check, const GradingJob& job, std::uint64_t signature,
                             const std::filesystem::path& file) {
  std::optional<Call> last;
  const auto converse = [&](const Check::Conversation& conversation) {
    const WorkerRun run = runWithWorker(job, check.info.part, signature, [&](remote::Caller& caller) {
      caller.listen([&](std::uint32_t method, const std::string& function, remote::Caller::Bytes arguments,
                        const std::optional<remote::Caller::Bytes>&) {
        last = Call{.method = method, .function = function};
        last->arguments.raw(arguments.data(), arguments.size());
      });
      conversation(caller);
    });
    if (run.failure) throw Error({.what = "the program " + run.failure->message});
  };
  Check judge(check.info, job.seed);
  judge.watchCases([](bool holds) {
    if (!holds) throw CaseFailed{};
  });
  judge.startWorkersBy(converse);
  bool passes = false;
  try {
    converse([&](remote::Caller& caller) {
      passes =
          judge.judge([&](Check& requirements) { check.run(requirements, caller); }).status == Outcome::kPass;
    });
  } catch (const CaseFailed&) {
  }
  if (passes) return {};
  if (!last) throw Error({.what = "the check fails before a function has answered"});
  writeMessage(*last, file);
  return last->function;
}

}  // namespace rex::grading
