#include "sandbox/cell.h"

#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "base/error.h"

namespace rex::sandbox {

Cell::Cell(const Sandbox& sandbox, Confinement confinement)
    : sandbox_(sandbox), confinement_(std::move(confinement)) {
  confinement_.level = sandbox.level;
  if (!isConfined(sandbox.level)) return;
  slot_.emplace();
  confinement_.user = slot_->user();
  if (hasControlGroup(sandbox.level)) {
    constexpr int kOfTheSandbox = 3;
    group_.emplace(confinement_.addressSpace, confinement_.processes + kOfTheSandbox);
    confinement_.controlGroups = group_->processes();
  }
  const auto& folder = confinement_.writable;
  if (confinement_.user && !folder.empty() &&
      ::lchown(folder.c_str(), *confinement_.user, *confinement_.user) != 0)
    throw Error(
        {.what = "cannot give the work folder to the user of the sandbox", .found = std::strerror(errno)});
}

// The user ID will be lent to others.
Cell::~Cell() {
  const auto& folder = confinement_.writable;
  if (confinement_.user && !folder.empty())
    static_cast<void>(!::lchown(folder.c_str(), ::geteuid(), ::getegid()));
}

std::vector<std::string> Cell::command(const std::vector<std::string>& program) const {
  std::vector<std::string> command = {sandbox_.launcher.string()};
  const std::vector<std::string> arguments = toArguments(confinement_);
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.insert(command.end(), program.begin(), program.end());
  return command;
}

void Cell::kill() const {
  if (group_) group_->kill();
}

}  // namespace rex::sandbox
