#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/isolated_call.h"
#include "submission/compiler_messages.h"

namespace rex::submission {

/// A file was made such that reading it, or what a tool wrote about it, took too much: its own fault. what()
/// says which reading, and how it ended.
struct UnreadableFile : Error {
  using Error::Error;
};

/// What reading before the compiler starts may take. Linear readers of 1 MiB take some 0.1 s.
inline constexpr IsolationLimits kBeforeCompiling{.cpuSeconds = 2, .wallSeconds = 300, .memory = 512u << 20};
/// What reading may take that a compiler or linker wrote: up to 8 MiB of messages, or an object of 64 MiB.
inline constexpr IsolationLimits kAfterCompiling{.cpuSeconds = 10, .wallSeconds = 600, .memory = 1u << 30};

/// Calls `read`, which looks at a student's text or at something made of it, in a process of its own with
/// these limits, so that no text can harm or hold up the grader. `what` is for messages: "the compiler's
/// messages". Throws UnreadableFile if it reaches a limit or crashes, what `read` throws, and Error if the
/// process is killed from outside or waits for a processor for too long.
[[nodiscard]] nlohmann::json readApart(const std::string& what, const IsolationLimits& limits,
                                       const std::function<nlohmann::json()>& read);

/// The same for messages.
[[nodiscard]] std::vector<grading::CompileDiagnostic> messagesApart(
    const std::string& what, const std::function<std::vector<grading::CompileDiagnostic>()>& read);

}  // namespace rex::submission

namespace rex::grading {

void to_json(nlohmann::json& json, const CompileDiagnostic& message);
void from_json(const nlohmann::json& json, CompileDiagnostic& message);

}  // namespace rex::grading
