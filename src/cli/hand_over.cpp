#include "cli/hand_over.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "base/error.h"
#include "base/interruption.h"
#include "cli/build_on_demand.h"

namespace rex::cli {

void becomeProgram(const Project& project, Program program, std::vector<std::string> words) {
  const std::string name = programName(program);
  bringUpToDate(project, {name}, name);
  const std::string file = (project.build / name).string();
  words.insert(words.begin(), file);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  const sigset_t held = stopSignals();
  ::sigprocmask(SIG_UNBLOCK, &held, nullptr);  // signals blocked here would stay blocked there
  ::execv(file.c_str(), arguments.data());
  throw Error({.what = "cannot start a part of rex",
               .where = {file},
               .found = std::strerror(errno),
               .wanted = "the programs of rex side by side, as `scripts/rex` builds them"});
}

}  // namespace rex::cli
