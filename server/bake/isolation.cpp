#include "bake/isolation.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <memory>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace froxel::bake {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

void limit(__rlimit_resource resource, uint64_t amount) {
    const rlimit both{amount, amount};
    setrlimit(resource, &both);
}

// Where memory runs out, this process goes before the one that serves.
void yieldMemory() {
    const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (score >= 0) {
        (void)!write(score, "1000", 4);
        close(score);
    }
}

void limitResources(const ResourceLimits& limits) {
    limit(RLIMIT_CORE, 0);
    if (limits.address_bytes > 0) {
        limit(RLIMIT_AS, limits.address_bytes);
    }
    if (limits.data_bytes > 0) {
        limit(RLIMIT_DATA, limits.data_bytes);
    }
    if (limits.output_bytes > 0) {
        limit(RLIMIT_FSIZE, limits.output_bytes);
    }
    if (limits.cpu_s > 0) {
        limit(RLIMIT_CPU, limits.cpu_s);
    }
}

// Debian 12's headers end at the second version of Landlock; a kernel of a later one has more that
// can be denied.
constexpr uint64_t kTruncate = 1ULL << 14U; // from version 3
constexpr uint64_t kIoctl = 1ULL << 15U;    // 5
constexpr uint64_t kVersion1 = (1ULL << 13U) - 1;

uint64_t deniedAccess(long version) {
    uint64_t access = kVersion1;
    access |= version >= 2 ? LANDLOCK_ACCESS_FS_REFER : 0;
    access |= version >= 3 ? kTruncate : 0;
    access |= version >= 5 ? kIoctl : 0;
    return access;
}

// Below 1: there is none.
long landlockVersion() {
    return syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
}

// A set of rules without any rule denies all that it handles.
bool denyFiles() {
    const long version = landlockVersion();
    if (version < 1) {
        return false;
    }
    landlock_ruleset_attr rules{};
    rules.handled_access_fs = deniedAccess(version);
    const long set = syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0);
    if (set < 0) {
        return false;
    }
    const bool denied = syscall(SYS_landlock_restrict_self, set, 0) == 0;
    close(static_cast<int>(set));
    return denied;
}

struct Release {
    void operator()(void* filter) const { seccomp_release(filter); }
};
using Filter = std::unique_ptr<void, Release>;

constexpr std::array kAllowed = {SCMP_SYS(read),
                                 SCMP_SYS(pread64),
                                 SCMP_SYS(write),
                                 SCMP_SYS(lseek),
                                 SCMP_SYS(ftruncate),
                                 SCMP_SYS(writev),
                                 SCMP_SYS(close),
                                 SCMP_SYS(munmap),
                                 SCMP_SYS(mremap),
                                 SCMP_SYS(madvise),
                                 SCMP_SYS(brk),
                                 SCMP_SYS(futex),
                                 SCMP_SYS(rseq),
                                 SCMP_SYS(set_robust_list),
                                 SCMP_SYS(sched_yield),
                                 SCMP_SYS(clock_gettime),
                                 SCMP_SYS(clock_nanosleep),
                                 SCMP_SYS(getrandom),
                                 SCMP_SYS(sigaltstack),
                                 SCMP_SYS(rt_sigaction),
                                 SCMP_SYS(rt_sigprocmask),
                                 SCMP_SYS(rt_sigreturn),
                                 SCMP_SYS(sched_getaffinity),
                                 SCMP_SYS(recvmsg),
                                 SCMP_SYS(sendmsg),
                                 SCMP_SYS(restart_syscall),
                                 SCMP_SYS(exit),
                                 SCMP_SYS(exit_group),
                                 SCMP_SYS(getpid),
                                 SCMP_SYS(getppid), // libuuid, of lib3mf
                                 SCMP_SYS(getuid),
                                 SCMP_SYS(gettid)};

// What a C library tries and can do without.
constexpr std::array kDenied = {
    SCMP_SYS(open),   SCMP_SYS(openat),    SCMP_SYS(access),           SCMP_SYS(faccessat),
    SCMP_SYS(stat),   SCMP_SYS(lstat),     SCMP_SYS(newfstatat),       SCMP_SYS(statx),
    SCMP_SYS(fstat),  SCMP_SYS(readlink),  SCMP_SYS(readlinkat),       SCMP_SYS(getcwd),
    SCMP_SYS(socket), SCMP_SYS(connect),   SCMP_SYS(execve),           SCMP_SYS(execveat),
    SCMP_SYS(ioctl),  SCMP_SYS(prlimit64), SCMP_SYS(sched_setaffinity)};

bool addRules(void* filter) {
    const auto add = [filter](uint32_t action, int call) {
        return seccomp_rule_add(filter, action, call, 0) == 0;
    };
    const auto addWhere = [filter](int call, const scmp_arg_cmp& where) {
        return seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 1, where) == 0;
    };
    bool added = true;
    for (const int call : kAllowed) {
        added = added && add(SCMP_ACT_ALLOW, call);
    }
    for (const int call : kDenied) {
        added = added && add(SCMP_ACT_ERRNO(EACCES), call);
    }
    // Its arguments lie in memory, where no filter looks; C libraries then call clone.
    added = added && add(SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3));
    const auto memory = SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0);
    const auto self = static_cast<scmp_datum_t>(getpid()); // so that abort() is told as such
    return added && addWhere(SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, self)) &&
           addWhere(SCMP_SYS(mmap), memory) && addWhere(SCMP_SYS(mprotect), memory) &&
           addWhere(SCMP_SYS(clone), SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD)) &&
           addWhere(SCMP_SYS(prctl), SCMP_A0(SCMP_CMP_EQ, PR_SET_NAME));
}

bool filterCalls() {
    const Filter filter(seccomp_init(SCMP_ACT_KILL_PROCESS));
    return filter && addRules(filter.get()) && seccomp_load(filter.get()) == 0;
}

} // namespace

Isolation isolationHere() {
    if (kSanitized) {
        return {};
    }
    const uint32_t kill = SECCOMP_RET_KILL_PROCESS;
    return {.landlock = landlockVersion() >= 1,
            .seccomp = syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &kill) == 0};
}

Isolation isolate(const ResourceLimits& limits) {
    if (kSanitized) {
        return {};
    }
    yieldMemory();
    limitResources(limits);
    Isolation isolation;
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) {
        isolation.landlock = denyFiles();
        isolation.seccomp = filterCalls();
    }
    return isolation;
}

std::string wordsOf(const Isolation& isolation) {
    if (isolation.full()) {
        return "landlock and seccomp";
    }
    return isolation.landlock  ? "landlock alone"
           : isolation.seccomp ? "seccomp alone"
                               : "a process of its own alone";
}

std::string escapeOf(const Isolation& isolation) {
    if (isolation.landlock || isolation.seccomp) {
        if (open("/proc/self/maps", O_RDONLY | O_CLOEXEC) >= 0) {
            return "it opened /proc/self/maps";
        }
    }
    if (isolation.seccomp) {
        if (socket(AF_INET, SOCK_STREAM, 0) >= 0) {
            return "it made a socket";
        }
        char path[] = "/proc/self/exe";
        char* const arguments[] = {path, nullptr};
        execve(path, arguments, nullptr); // does not return where it works
    }
    return isolation.full() ? "" : "it has " + wordsOf(isolation);
}

} // namespace froxel::bake
