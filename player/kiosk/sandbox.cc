#include "player/kiosk/sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lararium::player {
namespace {

// System calls that neither parsers nor drivers ever need: they look into other processes, or
// change the kernel, its modules, mounts, users and rights, or the clock.
constexpr const char* kNeverNeeded[] = {
    "ptrace",
    "process_vm_readv",
    "process_vm_writev",
    "pidfd_open",
    "pidfd_getfd",
    "pidfd_send_signal",
    "setns",
    "unshare",
    "mount",
    "umount2",
    "pivot_root",
    "chroot",
    "move_mount",
    "open_tree",
    "fsopen",
    "init_module",
    "finit_module",
    "delete_module",
    "kexec_load",
    "kexec_file_load",
    "reboot",
    "swapon",
    "swapoff",
    "bpf",
    "perf_event_open",
    "userfaultfd",
    "add_key",
    "request_key",
    "keyctl",
    "setuid",
    "setgid",
    "setreuid",
    "setregid",
    "setresuid",
    "setresgid",
    "setgroups",
    "capset",
    "settimeofday",
    "clock_settime",
    "clock_adjtime",
    "adjtimex",
    "sethostname",
    "setdomainname",
    "acct",
    "quotactl",
    "syslog",
    "iopl",
    "ioperm",
    "open_by_handle_at",
    "name_to_handle_at",
    "io_uring_setup",
};

// System calls that drivers of graphics and sound need only while they are opened: they start
// helper programs, create devices or change the owner of files.
constexpr const char* kNeededToOpen[] = {
    "execve",   "execveat", "fork",     "vfork", "kcmp",    "chown",  "lchown", "fchown",
    "fchownat", "chmod",    "fchmodat", "mknod", "mknodat", "listen", "accept", "accept4",
};

// System calls that a process with open sockets needs. All others fail.
constexpr const char* kOfConnections[] = {
    "recvfrom",
    "recvmsg",
    "read",
    "write",
    "writev",
    "shutdown",
    "close",
    "getsockopt",
    "setsockopt",
    "getsockname",
    "getpeername",
    "fcntl",
    "poll",
    "ppoll",
    "epoll_ctl",
    "epoll_wait",
    "epoll_pwait",
    "fstat",
    "brk",
    "munmap",
    "mremap",
    "madvise",
    "futex",
    "clock_gettime",
    "clock_nanosleep",
    "nanosleep",
    "gettimeofday",
    "time",
    "getrandom",
    "getpid",
    "gettid",
    "tgkill",
    "rt_sigaction",
    "rt_sigprocmask",
    "rt_sigreturn",
    "sigaltstack",
    "sched_yield",
    // A thread that has just been made calls these.
    "rseq",
    "set_robust_list",
    "restart_syscall",
    "exit",
    "exit_group",
#ifdef LARARIUM_SANITIZED
    // Sanitizers use pipes to check whether memory is mapped.
    "pipe",
    "pipe2",
#endif
};

// System calls that a client needs besides: it finds the address of its server, reads certificates,
// and gives up what takes too long.
constexpr const char* kOfClient[] = {
    "connect",   "sendmmsg", "pselect6",  "select", "ioctl",     "lseek",      "newfstatat",
    "fstatat64", "statx",    "readlink",  "uname",  "getuid",    "geteuid",    "getgid",
    "getegid",   "getcwd",   "setitimer", "access", "faccessat", "faccessat2", "readlinkat",
};

// Files that resolvers of names read.
constexpr const char* kOfResolver[] = {"/etc", "/run/systemd/resolve", "/run/NetworkManager",
                                       "/run/resolvconf"};

// Landlock as linux/landlock.h of Linux 6.7 has it; Debian 12's header is older.
constexpr uint64_t kAllFileRights = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
constexpr uint64_t kConnectTcp = 2;
constexpr uint64_t kBindTcp = 1;
constexpr int kPortRule = 2;
constexpr long kVersionWithPorts = 4;
struct LandlockRules {
  uint64_t files = kAllFileRights;
  uint64_t ports = kConnectTcp | kBindTcp;
};
struct LandlockPort {
  uint64_t allowed = kConnectTcp;
  uint64_t port = 0;
};

struct Release {
  void operator()(void* filter) const { seccomp_release(filter); }
};
using Filter = std::unique_ptr<void, Release>;

// A condition on the first argument of a system call.
scmp_arg_cmp First(scmp_compare op, scmp_datum_t a) {
  return {.arg = 0, .op = op, .datum_a = a, .datum_b = 0};
}

// The condition that a bit of an argument is not set.
scmp_arg_cmp Without(unsigned argument, scmp_datum_t bit) {
  return {.arg = argument, .op = SCMP_CMP_MASKED_EQ, .datum_a = bit, .datum_b = 0};
}

Status Problem(const char* what, int code) {
  return Status::Error("sandbox", std::string(what) + ": " + std::strerror(-code),
                       "run with --sandbox off if the system has no seccomp");
}

Status Forbid(const Filter& filter, std::span<const char* const> calls) {
  if (filter == nullptr) {
    return Problem("cannot be created", -ENOMEM);
  }
  for (const char* name : calls) {
    const int call = seccomp_syscall_resolve_name(name);
    if (call == __NR_SCMP_ERROR) {
      continue;  // this kernel or machine does not have the call
    }
    const int added = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), call, 0);
    if (added != 0 && added != -EDOM) {
      return Problem(name, added);
    }
  }
  return Status();
}

Status Load(scmp_filter_ctx filter) {
  seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1);
  const int loaded = seccomp_load(filter);
  return loaded == 0 ? Status() : Problem("the system does not take it", loaded);
}

using AllowCall = std::function<void(const char*, std::initializer_list<scmp_arg_cmp>)>;

// Enters a sandbox in which only the use of connections and memory is allowed, and `calls`, and
// what `more` allows.
Status EnterConnectionSandbox(std::span<const char* const> calls,
                              const std::function<void(const AllowCall&)>& more) {
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)));
  if (filter == nullptr) {
    return Problem("cannot be created", -ENOMEM);
  }
  int failed = 0;
  const AllowCall allow = [&](const char* name, std::initializer_list<scmp_arg_cmp> conditions) {
    const int call = seccomp_syscall_resolve_name(name);
    const int added =
        call == __NR_SCMP_ERROR  // this kernel or machine does not have the call
            ? 0
            : seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, call,
                                     static_cast<unsigned>(conditions.size()), conditions.begin());
    failed = added != 0 && added != -EDOM ? added : failed;
  };
  for (const std::span<const char* const> names :
       {std::span<const char* const>(kOfConnections), calls}) {
    for (const char* name : names) {
      allow(name, {});
    }
  }
  more(allow);
  // With MSG_FASTOPEN, sending would also connect.
  allow("sendto", {Without(3, MSG_FASTOPEN)});
  allow("sendmsg", {Without(2, MSG_FASTOPEN)});
  // Memory must not be executable, so that received data cannot be run.
  allow("mmap", {Without(2, PROT_EXEC)});
  allow("mprotect", {Without(2, PROT_EXEC)});
  return failed != 0 ? Problem("cannot be created", failed) : Load(filter.get());
}

// Permits to read `files` and the resolver's, and to connect to `port`, as far as the kernel knows
// such limits.
Status LimitFilesAndPorts(std::span<const std::filesystem::path> files, uint16_t port) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  const LandlockRules limits;
  const size_t size = version < kVersionWithPorts ? sizeof(limits.files) : sizeof(limits);
  const auto rules =
      static_cast<int>(version < 1 ? -1 : ::syscall(SYS_landlock_create_ruleset, &limits, size, 0));
  if (rules < 0) {
    return Status::Error("sandbox", "this kernel does not limit which files are read (Landlock)");
  }
  std::vector<std::filesystem::path> readable(files.begin(), files.end());
  readable.insert(readable.end(), std::begin(kOfResolver), std::end(kOfResolver));
  for (const std::filesystem::path& path : readable) {
    const int file = ::open(path.c_str(), O_PATH | O_CLOEXEC);
    if (file >= 0) {
      const landlock_path_beneath_attr beneath = {LANDLOCK_ACCESS_FS_READ_FILE, file};
      ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
      ::close(file);
    }
  }
  if (version >= kVersionWithPorts) {
    const LandlockPort allowed = {.port = port};
    ::syscall(SYS_landlock_add_rule, rules, kPortRule, &allowed, 0);
  }
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const long restricted = ::syscall(SYS_landlock_restrict_self, rules, 0);
  const int error = errno;
  ::close(rules);
  return restricted == 0 ? Status() : Problem("the system does not take it", -error);
}

}  // namespace

Status EnterOpeningSandbox() {
  const Filter filter(seccomp_init(SCMP_ACT_ALLOW));
  LARARIUM_RETURN_IF_ERROR(Forbid(filter, kNeverNeeded));
  return Load(filter.get());
}

namespace {

// A filter that forbids what neither readers nor connections need, other processes among it.
Result<Filter> ForbidOpening() {
  Filter filter(seccomp_init(SCMP_ACT_ALLOW));
  LARARIUM_RETURN_IF_ERROR(Forbid(filter, kNeverNeeded));
  LARARIUM_RETURN_IF_ERROR(Forbid(filter, kNeededToOpen));
  // New threads share their memory and are allowed; new processes do not and are forbidden.
  const int processes = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1,
                                         First(SCMP_CMP_MASKED_EQ, 0x00000100 /* CLONE_VM */));
  // The flags of clone3 lie in memory, which a filter cannot read. If it fails, libraries use
  // clone.
  const int clone3 = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
  for (const int added : {processes, clone3}) {
    if (added != 0) {
      return Problem("cannot be created", added);
    }
  }
  return filter;
}

}  // namespace

Status EnterSandbox() {
  LARARIUM_ASSIGN_OR_RETURN(const Filter filter, ForbidOpening());
  // Displays and sound need local sockets (AF_UNIX); all others are forbidden.
  const int added = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(socket), 1,
                                     First(SCMP_CMP_NE, AF_UNIX));
  return added != 0 ? Problem("cannot be created", added) : Load(filter.get());
}

Status EnterUpdateSandbox() {
  LARARIUM_ASSIGN_OR_RETURN(const Filter filter, ForbidOpening());
  return Load(filter.get());
}

Status EnterPageSandbox(int listening) {
  return EnterConnectionSandbox({}, [&](const AllowCall& allow) {
    for (const char* name : {"accept", "accept4"}) {
      allow(name, {First(SCMP_CMP_EQ, static_cast<scmp_datum_t>(listening))});
    }
  });
}

Status EnterClientSandbox(std::span<const std::filesystem::path> files, uint16_t port) {
  const Status limited = LimitFilesAndPorts(files, port);
  const Status entered = EnterConnectionSandbox(kOfClient, [](const AllowCall& allow) {
    for (const int family : {AF_INET, AF_INET6}) {
      allow("socket", {First(SCMP_CMP_EQ, static_cast<scmp_datum_t>(family))});
    }
    allow("socketpair", {First(SCMP_CMP_EQ, AF_UNIX)});
    allow("open", {Without(1, O_ACCMODE | O_CREAT)});
    allow("openat", {Without(2, O_ACCMODE | O_CREAT)});
  });
  return entered.ok() ? limited : entered;
}

}  // namespace lararium::player
