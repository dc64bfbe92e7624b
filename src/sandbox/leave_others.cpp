#include "sandbox/leave_others.h"

#include <cstdint>

#include <linux/capability.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace rex::sandbox {

// The kernel opens a process only to those who may trace it. That excludes a process in a landlock domain
// that the other is not in, whatever the domain forbids (here: making device files), and one that lacks some
// of the other's capabilities.
bool leaveOthersAlone() noexcept {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const bool isLessThanRoot = ::geteuid() == 0 && ::prctl(PR_CAPBSET_DROP, CAP_SYS_PTRACE, 0, 0, 0) == 0;
  const std::uint64_t handled = LANDLOCK_ACCESS_FS_MAKE_BLOCK;
  const long rules = ::syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0);
  const bool isInDomain = rules >= 0 && ::syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  if (rules >= 0) ::close(static_cast<int>(rules));
  return isInDomain || isLessThanRoot;
}

}  // namespace rex::sandbox
