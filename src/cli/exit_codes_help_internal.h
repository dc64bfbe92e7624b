#pragma once

namespace rex::cli {

/// What the help says of ExitCode.
inline constexpr const char* kExitCodesHelp =
    R"(Exit codes: 0 full score, 1 below full score, 2 cannot be graded (missing, does
not compile), 3 fault of the grader, the project or the machine, 4 the sandbox is
weaker than asked for, 64 wrong use.)";

}  // namespace rex::cli
