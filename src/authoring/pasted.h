#pragma once

#include <string>
#include <vector>

#include "authoring/gates.h"

namespace rex::authoring {

/// What became of pasting shown code into the functions that students complete.
struct Pasted {
  int functions = 0, expressions = 0;  ///< how often they were pasted
  std::vector<std::string> complaints{};
};

/// Pastes all code that a package shows into each function that the student completes and that it fits by
/// its types: functions (with the parameters of the student's in any order, one of which may be left out, and
/// with a given function that converts the result) and expressions of more than one line. Shown are
/// studentFiles(), the public headers of the library, share/examples and share/demonstrations. The
/// other functions are those of the solution. Complains about code that gets points in a check which asks
/// the function, and which the function as handed out does not pass, also if the whole file, with that code
/// in it, is graded like a student's. Throws Error if the tools fail.
[[nodiscard]] Pasted pastedCode(const GateContext& context);

}  // namespace rex::authoring
