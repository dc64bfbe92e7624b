#include "base/error.h"
#include "grading/tampered_run_internal.h"

namespace rex::grading {

CheckResult judgeTampered(const RunnableCheck& check, const Reference& reference, Check& judge,
                          const TamperOf& tamperOf) {
  const auto converse = [&](const Check::Conversation& conversation) {
    const WorkerRun run =
        runWithWorker(reference.job, check.info.part, reference.signature, [&](remote::Caller& caller) {
          caller.tamperWithResults(tamperOf(caller));
          conversation(caller);
        });
    if (run.failure)
      throw Error(
          {.what = "the reference solution fails in " + check.info.id, .found = run.failure->message});
  };
  judge.startWorkersBy(converse);
  CheckResult verdict;
  converse([&](remote::Caller& caller) {
    verdict = judge.judge([&](Check& requirements) { check.run(requirements, caller); });
  });
  return verdict;
}

}  // namespace rex::grading
