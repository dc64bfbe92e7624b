#pragma once
// The call of a student's function with which a check fails, for a debugger: a worker whose only message is
// this file runs that function with the same arguments.
//   const std::string function = writeFailingCall(check, job, signature, "call");  // "": the check passes
//   // gdb -ex 'break -qualified FUNCTION' -ex 'run 3<call 4>/dev/null' worker
#include <cstdint>
#include <filesystem>
#include <string>

#include "grading/grade.h"

namespace rex::grading {

/// Runs a check until it or the first of its cases fails, writes the call that the job's worker answered last
/// into `file`, and returns the name of the function. If the check passes, writes nothing and returns "".
/// Throws Error if the worker fails, which leaves no answer, or if the file cannot be written.
[[nodiscard]] std::string writeFailingCall(const RunnableCheck& check, const GradingJob& job,
                                           std::uint64_t signature, const std::filesystem::path& file);

}  // namespace rex::grading
