#include "sandbox/system_calls.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>
#include <vector>

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::sandbox {
namespace {

// Calls that look into other processes, change the machine or leave the sandbox: no exercise needs them.
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

// Calls that communicate with other processes or slow them down, and those for memory and queues that outlive
// a process or escape its limits.
constexpr auto kForbidden = std::to_array<const char*>({"flock",
                                                        "socket",
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

// Landlock does not cover these: they could change files of the same user by name.
constexpr auto kChangesByName = std::to_array<const char*>(
    {"truncate", "chmod", "fchmod", "fchmodat", "fchmodat2", "utime", "utimes", "utimensat", "futimesat"});

constexpr auto kOwnersAndAttributes =
    std::to_array<const char*>({"chown", "fchown", "lchown", "fchownat", "setxattr", "lsetxattr", "fsetxattr",
                                "removexattr", "lremovexattr", "fremovexattr"});

constexpr auto kProgramStarters = std::to_array<const char*>({"fork", "vfork", "execve"});

// What the C and C++ libraries call for their own memory, files, threads, time and signals. All other calls,
// including those that future kernels may add, fail as on a kernel without them.
// None of these reveals which pages of a file are in memory, which would be a channel between processes.
constexpr auto kOfHonestPrograms = std::to_array<const char*>({"brk",
                                                               "mmap",
                                                               "munmap",
                                                               "mremap",
                                                               "mprotect",
                                                               "madvise",
                                                               "msync",  //
                                                               "read",
                                                               "write",
                                                               "readv",
                                                               "writev",
                                                               "pread64",
                                                               "pwrite64",
                                                               "preadv",
                                                               "pwritev",
                                                               "lseek",
                                                               "_llseek",
                                                               "close",
                                                               "close_range",
                                                               "dup",
                                                               "dup2",
                                                               "dup3",
                                                               "pipe",
                                                               "pipe2",
                                                               "poll",
                                                               "ppoll",
                                                               "select",
                                                               "pselect6",
                                                               "epoll_create",
                                                               "epoll_create1",
                                                               "epoll_ctl",
                                                               "epoll_wait",
                                                               "epoll_pwait",
                                                               "epoll_pwait2",
                                                               "eventfd",
                                                               "eventfd2",
                                                               "sendfile",
                                                               "copy_file_range",  //
                                                               "stat",
                                                               "fstat",
                                                               "lstat",
                                                               "newfstatat",
                                                               "fstatat64",
                                                               "statx",
                                                               "statfs",
                                                               "fstatfs",
                                                               "access",
                                                               "faccessat",
                                                               "faccessat2",
                                                               "readlink",
                                                               "readlinkat",
                                                               "getdents",
                                                               "getdents64",
                                                               "getcwd",
                                                               "chdir",
                                                               "fchdir",
                                                               "ftruncate",
                                                               "fallocate",
                                                               "fsync",
                                                               "fdatasync",
                                                               "mkdir",
                                                               "mkdirat",
                                                               "rmdir",
                                                               "unlink",
                                                               "unlinkat",
                                                               "rename",
                                                               "renameat",
                                                               "renameat2",
                                                               "link",
                                                               "linkat",
                                                               "symlink",
                                                               "symlinkat",
                                                               "umask",  //
                                                               "exit",
                                                               "exit_group",
                                                               "wait4",
                                                               "waitid",
                                                               "getpid",
                                                               "gettid",
                                                               "getppid",
                                                               "getpgrp",
                                                               "getpgid",
                                                               "getsid",
                                                               "getuid",
                                                               "geteuid",
                                                               "getgid",
                                                               "getegid",
                                                               "getresuid",
                                                               "getresgid",
                                                               "getgroups",
                                                               "uname",
                                                               "sysinfo",
                                                               "getrlimit",
                                                               "setrlimit",
                                                               "getrusage",
                                                               "times",
                                                               "getpriority",
                                                               "capget",
                                                               "getcpu",
                                                               "getrandom",  //
                                                               "sched_yield",
                                                               "sched_getaffinity",
                                                               "sched_getparam",
                                                               "sched_getscheduler",
                                                               "sched_getattr",
                                                               "sched_get_priority_max",
                                                               "sched_get_priority_min",
                                                               "sched_rr_get_interval",  //
                                                               "futex",
                                                               "futex_waitv",
                                                               "set_robust_list",
                                                               "get_robust_list",
                                                               "set_tid_address",
                                                               "rseq",
                                                               "membarrier",
                                                               "arch_prctl",
                                                               "restart_syscall",  //
                                                               "rt_sigaction",
                                                               "rt_sigprocmask",
                                                               "rt_sigreturn",
                                                               "rt_sigpending",
                                                               "rt_sigtimedwait",
                                                               "rt_sigsuspend",
                                                               "sigaltstack",
                                                               "signalfd",
                                                               "signalfd4",
                                                               "pause",
                                                               "alarm",
                                                               "setitimer",
                                                               "getitimer",  //
                                                               "clock_gettime",
                                                               "clock_getres",
                                                               "clock_nanosleep",
                                                               "nanosleep",
                                                               "gettimeofday",
                                                               "time",
                                                               "timer_create",
                                                               "timer_settime",
                                                               "timer_gettime",
                                                               "timer_getoverrun",
                                                               "timer_delete",
                                                               "timerfd_create",
                                                               "timerfd_settime",
                                                               "timerfd_gettime"});

// The newest call known when these lists were written: mseal of Linux 6.10.
constexpr int kHighestKnown = 462;

class Filter {
 public:
  Filter() : context_(seccomp_init(kUnknown), seccomp_release) {
    if (!context_) throw Error({.what = "cannot make a filter of system calls"});
  }
  template <std::size_t n>
  void all(const std::array<const char*, n>& names, std::uint32_t action) {
    for (const char* name : names) when(name, {}, action);
  }
  // If there are several conditions, all must hold. A call whose rules do not apply, or that has none, fails
  // as on a kernel without it.
  void when(const char* name, const std::vector<scmp_arg_cmp>& conditions, std::uint32_t action) {
    const int number = seccomp_syscall_resolve_name(name);
    if (number == __NR_SCMP_ERROR) return;
    ruled_.insert(number);
    if (action != kUnknown)
      add(seccomp_rule_add_array(context_.get(), action, number, static_cast<unsigned>(conditions.size()),
                                 conditions.data()));
  }
  void allowTheRest() {
    for (int number = 0; number <= kHighestKnown; ++number) {
      const std::unique_ptr<char, decltype(&std::free)> name(
          seccomp_syscall_resolve_num_arch(SCMP_ARCH_NATIVE, number), std::free);
      if (name && !ruled_.contains(number))
        add(seccomp_rule_add_array(context_.get(), SCMP_ACT_ALLOW, number, 0, nullptr));
    }
  }
  void enforce() {
    add(seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_OPTIMIZE, 2));
    add(seccomp_load(context_.get()));
  }

  static constexpr std::uint32_t kUnknown = SCMP_ACT_ERRNO(ENOSYS);

 private:
  // A call that this architecture does not have needs no rule.
  static void add(int result) {
    if (result < 0 && result != -EDOM)
      throw Error({.what = "cannot filter system calls", .found = std::strerror(-result)});
  }
  std::unique_ptr<void, decltype(&seccomp_release)> context_;
  std::set<int> ruled_{};
};

constexpr std::uint32_t kKill = SCMP_ACT_KILL_PROCESS, kAllow = SCMP_ACT_ALLOW,
                        kRefuse = SCMP_ACT_ERRNO(EPERM);

// Threads may start, unless that suspends who starts them. Processes may not, unless programs are allowed;
// new namespaces never. clone3 hides its flags; without it the C library falls back to clone.
void filterClone(Filter& filter, bool mayStartPrograms) {
  constexpr std::array<scmp_datum_t, 7> kNamespaces = {
      CLONE_NEWUSER, CLONE_NEWNS, CLONE_NEWPID, CLONE_NEWNET, CLONE_NEWIPC, CLONE_NEWUTS, CLONE_NEWCGROUP};
  scmp_datum_t all = 0;
  for (const scmp_datum_t flag : kNamespaces) all |= flag;
  filter.when("clone3", {}, Filter::kUnknown);
  if (mayStartPrograms) {
    filter.when("clone", {SCMP_A0(SCMP_CMP_MASKED_EQ, all, 0)}, kAllow);
    for (const scmp_datum_t flag : kNamespaces)
      filter.when("clone", {SCMP_A0(SCMP_CMP_MASKED_EQ, flag, flag)}, kKill);
    return;
  }
  filter.when("clone", {SCMP_A0(SCMP_CMP_MASKED_EQ, all | CLONE_THREAD | CLONE_VFORK, CLONE_THREAD)}, kAllow);
  filter.when("clone", {SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)}, kKill);
  filter.all(kProgramStarters, kKill);
}

// Becoming the program is the last thing that the launcher does. Nobody else knows these addresses, so nobody
// can repeat that call.
void allowStart(Filter& filter, const ProgramStart& start) {
  filter.when("execveat", {}, Filter::kUnknown);
  if (start.program < 0) return;
  const auto number = [](const auto* pointer) { return reinterpret_cast<scmp_datum_t>(pointer); };
  filter.when("execveat",
              {SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(start.program)),
               SCMP_A1(SCMP_CMP_EQ, number(start.path)), SCMP_A2(SCMP_CMP_EQ, number(start.arguments)),
               SCMP_A3(SCMP_CMP_EQ, number(start.environment)), SCMP_A4(SCMP_CMP_EQ, AT_EMPTY_PATH)},
              kAllow);
}

// The process keeps its ID when it becomes the program.
void allowSignals(Filter& filter, bool toItselfOnly) {
  const auto self = static_cast<scmp_datum_t>(::getpid());
  for (const char* name : {"kill", "tkill", "tgkill"}) {
    if (!toItselfOnly) {
      filter.when(name, {}, kAllow);
      continue;
    }
    filter.when(name, {SCMP_A0(SCMP_CMP_EQ, self)}, kAllow);
    filter.when(name, {SCMP_A0(SCMP_CMP_NE, self)}, kRefuse);
  }
}

// A descriptor may be copied and asked for its flags. Setting its owner would send signals to others, and
// locks and leases are visible to others. Calls are allowed by exact numbers only, because the kernel looks
// at half of the bits that the filter sees.
void filterDescriptors(Filter& filter) {
  for (const scmp_datum_t command :
       {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_GETPIPE_SZ})
    filter.when("fcntl", {SCMP_A1(SCMP_CMP_EQ, command)}, kAllow);
  for (const scmp_datum_t command : {F_SETOWN, F_SETOWN_EX, F_SETSIG, F_SETLK, F_SETLKW, F_GETLK, F_OFD_SETLK,
                                     F_OFD_SETLKW, F_OFD_GETLK, F_SETLEASE, F_NOTIFY})
    filter.when("fcntl", {SCMP_A1(SCMP_CMP_EQ, command)}, kRefuse);
}

// The only requests of ioctl and prctl that do nothing to others.
void allowHarmlessRequests(Filter& filter) {
  for (const scmp_datum_t request : {TCGETS, TIOCGWINSZ, FIONREAD, FIONBIO, FIOCLEX, FIONCLEX})
    filter.when("ioctl", {SCMP_A1(SCMP_CMP_EQ, request)}, kAllow);
  for (const scmp_datum_t option : {PR_SET_NAME, PR_GET_NAME})
    filter.when("prctl", {SCMP_A0(SCMP_CMP_EQ, option)}, kAllow);
}

// A file that may only be read could still be emptied by opening it. openat2 hides its flags from filters.
void allowOpening(Filter& filter, bool mayEmpty) {
  filter.when("open", {SCMP_A1(SCMP_CMP_MASKED_EQ, O_TRUNC, 0)}, kAllow);
  filter.when("openat", {SCMP_A2(SCMP_CMP_MASKED_EQ, O_TRUNC, 0)}, kAllow);
  const std::uint32_t action = mayEmpty ? kAllow : kRefuse;
  filter.when("open", {SCMP_A1(SCMP_CMP_MASKED_EQ, O_TRUNC, O_TRUNC)}, action);
  filter.when("openat", {SCMP_A2(SCMP_CMP_MASKED_EQ, O_TRUNC, O_TRUNC)}, action);
  filter.when("creat", {}, action);
  filter.when("openat2", {}, mayEmpty ? kAllow : Filter::kUnknown);
}

void filterStudents(Filter& filter, const Confinement& confinement, const ProgramStart& start, int landlock) {
  constexpr int kRulesTruncation = 3, kScopedSignals = 6;
  const bool isConfinedByName = !hasNamespaces(confinement.level);
  allowStart(filter, start);
  allowSignals(filter, isConfinedByName && landlock < kScopedSignals);
  allowOpening(filter, !isConfinedByName || landlock >= kRulesTruncation);
  allowHarmlessRequests(filter);
  filter.all(kChangesByName, isConfinedByName ? kRefuse : kAllow);
  filter.all(kOwnersAndAttributes, kRefuse);
  filter.all(kOfHonestPrograms, kAllow);
}

}  // namespace

void filterSystemCalls(const Confinement& confinement, const ProgramStart& start, int landlock) {
  Filter filter;
  filter.all(kHostile, kKill);
  filter.all(kForbidden, kRefuse);
  filter.when("prlimit64", {SCMP_A0(SCMP_CMP_EQ, 0)}, kAllow);
  filter.when("prlimit64", {SCMP_A0(SCMP_CMP_NE, 0)}, kRefuse);
  filterClone(filter, confinement.mayStartProgramsOfItsOwn);
  filterDescriptors(filter);
  if (confinement.mayStartProgramsOfItsOwn)
    filter.allowTheRest();
  else
    filterStudents(filter, confinement, start, landlock);
  filter.enforce();
}

}  // namespace rex::sandbox
