#include "grading/worker_failure.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>

#include <fmt/format.h>
#include <sys/wait.h>

#include "grading/output_capture.h"
#include "remote/worker.h"

namespace rex::grading {
namespace {

constexpr std::array<std::string_view, 10> kNames = {
    "pass",         "fail",         "compile_error",  "runtime_error",  "time_limit",
    "memory_limit", "output_limit", "protocol_error", "security_event", "grader_error"};

}  // namespace

std::string_view toString(Outcome outcome) { return kNames.at(static_cast<std::size_t>(outcome)); }

std::optional<Outcome> outcomeFromString(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Outcome>(found - kNames.begin());
}

namespace {

constexpr int kLoaderFailed = 127;

Failure tooSlow(const WorkerEnd& end, const Limits& limits) {
  return {.outcome = Outcome::kTimeLimit,
          .message = fmt::format("stopped after {:.1f} s of CPU time {}", limits.cpuBudget(),
                                 failurePlace(end.ready, end.function))};
}

Failure tooMuchMemory(const Limits& limits, const std::string& place) {
  return {.outcome = Outcome::kMemoryLimit,
          .message = fmt::format("used more than {} MB of memory {}", limits.memory / kMegabyte, place)};
}

// The runtime names the uncaught exception; without memory it cannot even demangle the name. The others are
// the last words of the sanitizer.
bool ranOutOfMemory(const std::string& errorTail) {
  constexpr auto kSigns = std::to_array<const char*>(
      {"std::bad_alloc", "St9bad_alloc", "End of process memory map.",
       "AddressSanitizer: allocation-size-too-big", "AddressSanitizer: out-of-memory"});
  return std::any_of(kSigns.begin(), kSigns.end(),
                     [&](const char* sign) { return errorTail.find(sign) != std::string::npos; });
}

Failure badAccess(const WorkerEnd& end, const Limits& limits) {
  const std::string message = "crashed with a segmentation fault " + failurePlace(end.ready, end.function);
  if (end.ready) return {.message = message + " (an index out of range, or infinite recursion?)"};
  // The kernel also kills a program whose globals do not fit while it is being loaded.
  return {.message =
              fmt::format("{} (in the constructor of a global variable, or do the global variables need more "
                          "than {} MB?)",
                          message, limits.memory / kMegabyte)};
}

Failure explainSignal(const WorkerEnd& end, const Limits& limits) {
  const std::string place = failurePlace(end.ready, end.function);
  if (end.outOfMemory) return tooMuchMemory(limits, place);
  switch (WTERMSIG(end.status)) {
    case SIGSYS:
      return {.outcome = Outcome::kSecurityEvent,
              .message = "tried something that the sandbox forbids " + place +
                         " (start another program, look into others, or change the machine)"};
    case SIGXCPU:
      return tooSlow(end, limits);
    case SIGKILL:
      // A program that ignores the first warning is killed a second later.
      if (end.cpuSeconds >= limits.cpuBudget()) return tooSlow(end, limits);
      return {.message = "was killed " + place, .mayBeOfMachine = true};
    case SIGSEGV:
    case SIGBUS:
      return badAccess(end, limits);
    case SIGFPE:
      return {.message = "crashed with an integer division by zero " + place};
    case SIGILL:
      return {.message = "crashed with an illegal instruction " + place + " (a missing return?)"};
    case SIGABRT:
      if (ranOutOfMemory(end.errorTail)) return tooMuchMemory(limits, place);
      return {.message = "aborted " + place, .detail = tellingLine(end.errorTail)};
    case SIGXFSZ:
      return {.outcome = Outcome::kOutputLimit, .message = "wrote a file that is too large " + place};
    default:
      return {.message = fmt::format("was ended by signal {} ({}) {}", WTERMSIG(end.status),
                                     ::strsignal(WTERMSIG(end.status)), place)};
  }
}

}  // namespace

std::string failurePlace(bool ready, const std::string& function) {
  if (!function.empty()) return "in " + function;
  return ready ? "between two calls" : "before the first call";
}

bool tellsOfCrash(std::string_view message) {
  return message.starts_with("crashed with ") || message.starts_with("aborted ") ||
         message.starts_with("was ended by signal ");
}

Failure explainEnd(const WorkerEnd& end, const Limits& limits) {
  if (WIFSIGNALED(end.status)) return explainSignal(end, limits);
  const int code = WEXITSTATUS(end.status);
  const std::string place = failurePlace(end.ready, end.function);
  if (code == remote::kProtocolFailure)
    return {.outcome = Outcome::kProtocolError, .message = "lost its connection to the grader " + place};
  if (code == kLoaderFailed && !end.ready)
    return {.message = "could not be loaded", .detail = tellingLine(end.errorTail)};
  const char* hint = end.ready ? "" : " (in the constructor of a global variable?)";
  return {.message = fmt::format("called exit({}) {}{}", code, place, hint)};
}

Failure explainThrow(const remote::RemoteThrow& error, const Limits& limits) {
  const remote::Thrown& thrown = error.thrown();
  if (thrown.kind == remote::Thrown::Kind::kBadAlloc) {
    Failure failure = tooMuchMemory(limits, failurePlace(true, error.function()));
    failure.function = error.function();
    return failure;
  }
  return {.message = fmt::format("threw {} in {}", thrown.type, error.function()),
          .detail = thrown.text,
          .function = error.function()};
}

}  // namespace rex::grading
