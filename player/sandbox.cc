#include "player/sandbox.h"

#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

namespace lararium::player {
namespace {

// Of Linux' calls: other programs, other processes, the kernel and its modules, mounts, users and
// rights, the clock, and files' owners and rights. Drivers of graphics and sound use none of them
// once they are open.
constexpr const char* kForbidden[] = {
    "execve",
    "execveat",
    "fork",
    "vfork",
    "ptrace",
    "process_vm_readv",
    "process_vm_writev",
    "kcmp",
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
    "chown",
    "lchown",
    "fchown",
    "fchownat",
    "chmod",
    "fchmodat",
    "mknod",
    "mknodat",
    "acct",
    "quotactl",
    "syslog",
    "iopl",
    "ioperm",
    "open_by_handle_at",
    "name_to_handle_at",
    "io_uring_setup",
    "listen",
    "accept",
    "accept4",
};

struct Release {
  void operator()(void* filter) const { seccomp_release(filter); }
};

// A condition on a call's first argument.
scmp_arg_cmp First(scmp_compare op, scmp_datum_t a) {
  return {.arg = 0, .op = op, .datum_a = a, .datum_b = 0};
}

Status Problem(const char* what, int code) {
  return Status::Error("sandbox", std::string(what) + ": " + std::strerror(-code),
                       "run with --sandbox off if the system has no seccomp");
}

}  // namespace

Status EnterSandbox() {
  const std::unique_ptr<void, Release> filter(seccomp_init(SCMP_ACT_ALLOW));
  if (filter == nullptr) {
    return Problem("cannot be made", -ENOMEM);
  }
  for (const char* name : kForbidden) {
    const int call = seccomp_syscall_resolve_name(name);
    if (call == __NR_SCMP_ERROR) {
      continue;  // not of this kernel or machine
    }
    const int added = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), call, 0);
    if (added != 0 && added != -EDOM) {
      return Problem(name, added);
    }
  }
  // Sockets between programs of this machine are what displays and sound need: no others.
  const int sockets = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(socket), 1,
                                       First(SCMP_CMP_NE, AF_UNIX));
  // Threads share their memory: a new process does not.
  const int processes = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1,
                                         First(SCMP_CMP_MASKED_EQ, 0x00000100 /* CLONE_VM */));
  // Its flags lie in memory, where a filter cannot look; without it libraries take clone.
  const int clone3 = seccomp_rule_add(filter.get(), SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0);
  for (const int added : {sockets, processes, clone3}) {
    if (added != 0) {
      return Problem("cannot be made", added);
    }
  }
  seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1);
  if (const int loaded = seccomp_load(filter.get()); loaded != 0) {
    return Problem("the system does not take it", loaded);
  }
  return Status();
}

}  // namespace lararium::player
