#include "sandbox/level.h"

#include <fmt/format.h>

#include "base/error.h"

namespace rex::sandbox {

Level levelOf(int number) {
  if (number < 0 || number > numberOf(Level::kControlGroup))
    throw Error({.what = "sandbox level", .found = fmt::format("{}", number), .wanted = "0, 1, 2 or 3"});
  return static_cast<Level>(number);
}

std::string describe(Level level) { return fmt::format("sandbox level {} of 3", numberOf(level)); }

std::string warningOf(Level level) {
  switch (level) {
    case Level::kControlGroup:
      return "";
    case Level::kNamespaces:
      return describe(level) + ": memory is limited per process, not in total";
    case Level::kFiles:
      return describe(level) +
             ": the student's program can read the system's files under /usr and see which files exist; "
             "grade "
             "other people's code at level 2 or 3";
    case Level::kLimitsOnly:
      return describe(level) +
             ": the student's program runs with the rights of the grader and sees its files; grade only your "
             "own code this way";
  }
  return "";
}

}  // namespace rex::sandbox
