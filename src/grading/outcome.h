#pragma once

#include <optional>
#include <string_view>

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

}  // namespace rex::grading
