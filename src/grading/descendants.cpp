#include "grading/descendants.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/text.h"

namespace rex::grading {
namespace {

// The parent's id is the second field after the program name, which may itself contain spaces and brackets.
pid_t parentOf(const std::filesystem::path& process) {
  std::ifstream file(process / "stat");
  std::string stat;
  std::getline(file, stat, '\0');  // if the process ends meanwhile, reads nothing; iterators would throw
  const std::size_t nameEnd = stat.rfind(')');
  if (nameEnd == std::string::npos || nameEnd + 4 > stat.size()) return 0;
  std::string_view parent = std::string_view(stat).substr(nameEnd + 4);
  return takeNumber<pid_t>(parent).value_or(0);
}

// Process ids of the children of this process, running or ended, as the kernel lists them in /proc.
std::vector<int> listChildren() {
  std::vector<int> children;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    const std::optional<pid_t> id = parseNumber<pid_t>(entry.path().filename().string());
    if (id && parentOf(entry.path()) == ::getpid()) children.push_back(*id);
  }
  return children;
}

}  // namespace

NewDescendants::NewDescendants() : known_(listChildren()) {
  ::prctl(PR_GET_CHILD_SUBREAPER, &adopting_);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
}

NewDescendants::~NewDescendants() {
  kill();
  ::prctl(PR_SET_CHILD_SUBREAPER, adopting_);
}

void NewDescendants::reap(int child) {
  const std::optional<ChildEnd> end = waitForChild(child, WNOHANG);
  if (!end) return;
  cpuSeconds_ += end->cpuSeconds;
  peakKilobytes_ = std::max(peakKilobytes_, end->peakKilobytes);
}

void NewDescendants::kill() {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::seconds(2);
  while (Clock::now() < deadline) {
    bool found = false;
    for (const pid_t child : listChildren()) {
      if (std::find(known_.begin(), known_.end(), child) != known_.end()) continue;
      found = true;
      ::kill(child, SIGKILL);
      reap(child);
    }
    if (!found) break;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

}  // namespace rex::grading
