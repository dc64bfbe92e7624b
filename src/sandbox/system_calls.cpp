#include "sandbox/system_calls.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::sandbox {
namespace {

// To look into other processes, to change the machine or to leave the sandbox: no exercise needs them.
constexpr auto kHostile = std::to_array<const char*>({"ptrace",
                                                      "process_vm_readv",
                                                      "process_vm_writev",
                                                      "process_madvise",
                                                      "pidfd_getfd",
                                                      "kcmp",
                                                      "mount",
                                                      "umount2",
                                                      "pivot_root",
                                                      "chroot",
                                                      "move_mount",
                                                      "open_tree",
                                                      "fsopen",
                                                      "fsconfig",
                                                      "fsmount",
                                                      "fspick",
                                                      "mount_setattr",
                                                      "unshare",
                                                      "setns",
                                                      "bpf",
                                                      "perf_event_open",
                                                      "kexec_load",
                                                      "kexec_file_load",
                                                      "init_module",
                                                      "finit_module",
                                                      "delete_module",
                                                      "reboot",
                                                      "swapon",
                                                      "swapoff",
                                                      "open_by_handle_at",
                                                      "userfaultfd",
                                                      "iopl",
                                                      "ioperm",
                                                      "quotactl",
                                                      "quotactl_fd",
                                                      "acct",
                                                      "syslog",
                                                      "settimeofday",
                                                      "clock_settime",
                                                      "clock_adjtime",
                                                      "adjtimex",
                                                      "sethostname",
                                                      "setdomainname",
                                                      "vhangup",
                                                      "lookup_dcookie"});

// Ways to talk to others or to slow them down, and memory and queues that outlive a process or escape its
// limits.
constexpr auto kForbidden = std::to_array<const char*>({"socket",
                                                        "socketpair",
                                                        "io_uring_setup",
                                                        "io_uring_enter",
                                                        "io_uring_register",
                                                        "memfd_create",
                                                        "memfd_secret",
                                                        "add_key",
                                                        "request_key",
                                                        "keyctl",
                                                        "shmget",
                                                        "shmat",
                                                        "shmctl",
                                                        "semget",
                                                        "semop",
                                                        "semctl",
                                                        "msgget",
                                                        "msgsnd",
                                                        "msgrcv",
                                                        "msgctl",
                                                        "mq_open",
                                                        "mq_unlink",
                                                        "rt_sigqueueinfo",
                                                        "rt_tgsigqueueinfo",
                                                        "pidfd_open",
                                                        "pidfd_send_signal",
                                                        "name_to_handle_at",
                                                        "fanotify_init",
                                                        "personality",
                                                        "setpriority",
                                                        "ioprio_set",
                                                        "sched_setaffinity",
                                                        "sched_setscheduler",
                                                        "sched_setparam",
                                                        "sched_setattr",
                                                        "migrate_pages",
                                                        "move_pages"});

// What landlock does not rule: files of the same user could be changed by their names.
constexpr auto kChangesByName =
    std::to_array<const char*>({"truncate", "chmod", "fchmod", "fchmodat", "fchmodat2", "chown", "fchown",
                                "lchown", "fchownat", "utime", "utimes", "utimensat", "futimesat", "setxattr",
                                "lsetxattr", "fsetxattr", "removexattr", "lremovexattr", "fremovexattr"});

constexpr auto kProcessStarters = std::to_array<const char*>({"fork", "vfork"});

class Filter {
 public:
  Filter() : context_(seccomp_init(SCMP_ACT_ALLOW), seccomp_release) {
    if (!context_) throw Error({.what = "cannot make a filter of system calls"});
  }
  template <std::size_t n>
  void all(const std::array<const char*, n>& names, std::uint32_t action) {
    for (const char* name : names) {
      const int number = seccomp_syscall_resolve_name(name);
      if (number != __NR_SCMP_ERROR) add(seccomp_rule_add(context_.get(), action, number, 0));
    }
  }
  void when(const char* name, const scmp_arg_cmp& condition, std::uint32_t action) {
    const int number = seccomp_syscall_resolve_name(name);
    if (number != __NR_SCMP_ERROR) add(seccomp_rule_add_array(context_.get(), action, number, 1, &condition));
  }
  void enforce() {
    add(seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_OPTIMIZE, 2));
    add(seccomp_load(context_.get()));
  }

 private:
  // Calls that this kind of processor does not have cannot be made either.
  static void add(int result) {
    if (result < 0 && result != -EDOM)
      throw Error({.what = "cannot filter system calls", .found = std::strerror(-result)});
  }
  std::unique_ptr<void, decltype(&seccomp_release)> context_;
};

// Threads may start, processes may not, unless told otherwise; new namespaces never. The new form of the call
// hides its flags from filters: without it the C library takes the old one.
void filterClone(Filter& filter, bool mayStartPrograms) {
  constexpr std::array<std::uint64_t, 7> kNamespaces = {
      CLONE_NEWUSER, CLONE_NEWNS, CLONE_NEWPID, CLONE_NEWNET, CLONE_NEWIPC, CLONE_NEWUTS, CLONE_NEWCGROUP};
  filter.all(std::to_array<const char*>({"clone3"}), SCMP_ACT_ERRNO(ENOSYS));
  if (mayStartPrograms) {
    for (const std::uint64_t flag : kNamespaces)
      filter.when("clone", SCMP_A0(SCMP_CMP_MASKED_EQ, flag, flag), SCMP_ACT_KILL_PROCESS);
    return;
  }
  filter.when("clone", SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0), SCMP_ACT_KILL_PROCESS);
  filter.all(kProcessStarters, SCMP_ACT_KILL_PROCESS);
}

// The process keeps its number when it becomes the program.
void allowOnlyItself(Filter& filter) {
  const auto self = static_cast<scmp_datum_t>(::getpid());
  for (const char* name : {"kill", "tkill", "tgkill"})
    filter.when(name, SCMP_A0(SCMP_CMP_NE, self), SCMP_ACT_ERRNO(EPERM));
}

// Whoever owns a descriptor gets its signals.
void forbidOwnersOfDescriptors(Filter& filter) {
  for (const scmp_datum_t command : {F_SETOWN, F_SETOWN_EX, F_SETSIG})
    filter.when("fcntl", SCMP_A1(SCMP_CMP_EQ, command), SCMP_ACT_ERRNO(EPERM));
}

// Files that may only be read could be emptied as they are opened. The last of the calls hides its flags from
// filters.
void forbidEmptying(Filter& filter) {
  filter.when("open", SCMP_A1(SCMP_CMP_MASKED_EQ, O_TRUNC, O_TRUNC), SCMP_ACT_ERRNO(EPERM));
  filter.when("openat", SCMP_A2(SCMP_CMP_MASKED_EQ, O_TRUNC, O_TRUNC), SCMP_ACT_ERRNO(EPERM));
  filter.all(std::to_array<const char*>({"creat"}), SCMP_ACT_ERRNO(EPERM));
  filter.all(std::to_array<const char*>({"openat2"}), SCMP_ACT_ERRNO(ENOSYS));
}

}  // namespace

void filterSystemCalls(const Confinement& confinement, int landlock) {
  Filter filter;
  filter.all(kHostile, SCMP_ACT_KILL_PROCESS);
  filter.all(kForbidden, SCMP_ACT_ERRNO(EPERM));
  filter.when("prlimit64", SCMP_A0(SCMP_CMP_NE, 0), SCMP_ACT_ERRNO(EPERM));
  filterClone(filter, confinement.mayStartProgramsOfItsOwn);
  forbidOwnersOfDescriptors(filter);
  constexpr int kRulesTruncation = 3, kScopedSignals = 6;
  const bool isStudents = !confinement.mayStartProgramsOfItsOwn;
  if (confinement.level == 1 && isStudents) {
    filter.all(kChangesByName, SCMP_ACT_ERRNO(EPERM));
    if (landlock < kRulesTruncation) forbidEmptying(filter);
    if (landlock < kScopedSignals) allowOnlyItself(filter);
  }
  filter.enforce();
}

}  // namespace rex::sandbox
