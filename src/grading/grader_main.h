#pragma once

#include <cstdint>
#include <vector>

#include "grading/check.h"
#include "grading/grade.h"
#include "grading/hostile_answers.h"

namespace rex::grading {

/// The whole main() of a grader program; `--help` lists its options. Returns an ExitCode. Prints messages
/// to standard error, and to standard output only what --list or --help asks for.
[[nodiscard]] int runGrader(int argc, const char* const* argv, std::vector<RunnableCheck> checks,
                            std::uint64_t signature, const CallLayouts& layouts);

/// The same for the checks of one exercise, whose functions the proxy Student calls.
template <class Student>
[[nodiscard]] int graderMain(int argc, const char* const* argv, const Checks<Student>& checks) {
  std::vector<RunnableCheck> runnable;
  for (const CheckEntry<Student>& entry : checks)
    runnable.push_back({.info = {.id = entry.id,
                                 .part = entry.part,
                                 .title = entry.title,
                                 .points = entry.points,
                                 .group = entry.group},
                        .run = [run = entry.run](Check& check, remote::Caller& caller) {
                          Student student(caller);
                          run(check, student);
                        }});
  return runGrader(argc, argv, std::move(runnable), Student::signature(), Student::layouts());
}

}  // namespace rex::grading
