#pragma once

namespace rex {

/// The exit codes of the programs of rex.
enum class ExitCode {
  kFull = 0,  ///< graded with full score, or: the command succeeded
  kBelow =
      1,  ///< graded below full score, or: the student's program failed, a gate is open, no path was found
  kNotGradable = 2,   ///< the file is missing, does not compile or calls what is forbidden
  kGraderFault = 3,   ///< fault of the grader, the project or the machine; never a grade
  kWeakSandbox = 4,   ///< the sandbox of this machine is weaker than what was asked for
  kUsage = 64,        ///< unknown command, option or name, or one that is not available here; a broken scene
  kTimedOut = 124,    ///< of rex-sandbox: the program had to be stopped
  kNotStarted = 125,  ///< of rex-sandbox: the program could not be started
};

/// The text of help pages about those that users meet.
inline constexpr const char* kExitCodesHelp =
    R"(Exit codes: 0 full score, 1 below full score, 2 cannot be graded (missing, does
not compile), 3 fault of the grader, the project or the machine, 4 the sandbox is
weaker than asked for, 64 wrong use.)";

[[nodiscard]] constexpr int numberOf(ExitCode code) { return static_cast<int>(code); }

}  // namespace rex
