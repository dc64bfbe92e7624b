#pragma once

namespace rex::cli {

/// What `rex` tells the shell.
enum class ExitCode {
  kFull = 0,  ///< graded with full score, or: the command did its work
  kBelow =
      1,  ///< graded below full score, or: the student's program failed, a gate is open, no path was found
  kNotGradable = 2,  ///< the file is missing, does not compile or calls what is forbidden
  kGraderFault = 3,  ///< fault of the grader, the project or the machine, never a grade
  kWeakSandbox = 4,  ///< the sandbox of this machine is weaker than what was asked for
  kUsage = 64,       ///< unknown command, option or name, or one that cannot be had here; a broken scene
};

}  // namespace rex::cli
