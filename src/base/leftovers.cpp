#include "base/leftovers.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include <signal.h>
#include <sys/types.h>

#include "base/text.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

// The process of NAME.PID.new; 0 for other names.
pid_t writerOf(const std::string& name) {
  constexpr std::string_view kEnding = ".new";
  if (!name.ends_with(kEnding)) return 0;
  const std::string whole = name.substr(0, name.size() - kEnding.size());
  const std::size_t dot = whole.rfind('.');
  if (dot == whole.npos || dot == 0) return 0;
  return std::max(0, parseNumber<pid_t>(whole.substr(dot + 1)).value_or(0));
}

bool hasEnded(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace

void removeLeftovers(const fs::path& folder, int depth) {
  std::vector<fs::path> leftovers;
  std::error_code missing;
  for (fs::recursive_directory_iterator entry(folder, missing), end; !missing && entry != end;
       entry.increment(missing)) {
    if (entry.depth() >= depth) entry.disable_recursion_pending();
    const pid_t writer = writerOf(entry->path().filename().string());
    if (writer > 0 && entry->symlink_status().type() == fs::file_type::regular && hasEnded(writer))
      leftovers.push_back(entry->path());
  }
  for (const fs::path& file : leftovers) fs::remove(file, missing);
}

}  // namespace rex
