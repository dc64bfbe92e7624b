#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "grading/limits.h"
#include "remote/channel.h"

namespace rex::grading {

/// How a check or a whole submission ended. Only graderError is never the student's fault.
enum class Outcome {
  kPass,
  kFail,
  kCompileError,
  kRuntimeError,
  kTimeLimit,
  kMemoryLimit,
  kOutputLimit,
  kProtocolError,
  kSecurityEvent,
  kGraderError
};

/// The name in result files: "pass", "compile_error", "time_limit", ...
[[nodiscard]] std::string_view toString(Outcome outcome);

/// The outcome of that name, if there is one.
[[nodiscard]] std::optional<Outcome> outcomeFromString(std::string_view name);

/// Why a worker could not finish. `message` is ours; `detail` quotes the student's program. Both may reveal
/// its input, so reports of hidden checks give only the outcome and the function.
struct Failure {
  Outcome outcome = Outcome::kRuntimeError;
  std::string message{};   ///< "aborted in ikStep"
  std::string detail{};    ///< "Assertion `index < size()' failed."
  std::string function{};  ///< the student's function that was running; empty if none
  bool mayBeOfMachine =
      false;  ///< another attempt decides: killed from outside or by itself, or it hardly ran
};

/// A worker process that ended without being asked to.
struct WorkerEnd {
  int status = 0;            ///< as wait4() gives it
  double cpuSeconds = 0;     ///< CPU time used
  bool ready = false;        ///< it had completed the handshake
  std::string function{};    ///< the function that was running; empty if none
  std::string errorTail{};   ///< the end of its output to standard error
  bool outOfMemory = false;  ///< the kernel killed it because its memory was used up
};

/// "in ikStep", "before the first call" or "between two calls".
[[nodiscard]] std::string failurePlace(bool ready, const std::string& function);

/// Whether a message of ours reports a crash, for which a second look with the sanitizers may find the line.
[[nodiscard]] bool tellsOfCrash(std::string_view message);

[[nodiscard]] Failure explainEnd(const WorkerEnd& end, const Limits& limits);
[[nodiscard]] Failure explainThrow(const remote::RemoteThrow& error, const Limits& limits);

}  // namespace rex::grading
