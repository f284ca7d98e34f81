// SPDX-License-Identifier: MIT
// For LD_PRELOAD: a file system that lacks what the variable LACKS names. "maps": shared mappings
// of files. "whole": locks on whole files. "ranges": locks of ranges. "nfs": locks on whole files
// that are not made of locks of ranges. "shared": it is not of one host alone.
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <unistd.h>

namespace {

bool lacks(const char* word) {
    const char* all = std::getenv("LACKS");
    return all && std::strstr(all, word);
}

int whole_locked_by = -1;  // number of a file that this process has locked as a whole

long control(int file, int command, void* argument) {
    const bool locks = command == F_SETLK || command == F_SETLKW || command == F_GETLK;
    if (locks && lacks("ranges")) {
        errno = ENOLCK;
        return -1;
    }
    if (command == F_SETLK && lacks("nfs") && whole_locked_by >= 0 && file != whole_locked_by) {
        errno = EAGAIN;
        return -1;
    }
    return syscall(SYS_fcntl, file, command, argument);
}

}  // namespace

extern "C" {

void* mmap64(void* at, size_t size, int protection, int flags, int file, off64_t offset) {
    if (file >= 0 && (flags & MAP_SHARED) != 0 && lacks("maps")) {
        errno = ENODEV;
        return MAP_FAILED;
    }
    return reinterpret_cast<void*>(syscall(SYS_mmap, at, size, protection, flags, file, offset));
}

int flock(int file, int kind) {
    if (lacks("whole")) {
        errno = ENOLCK;
        return -1;
    }
    const long result = syscall(SYS_flock, file, kind);
    if (result == 0) whole_locked_by = (kind & LOCK_EX) != 0 ? file : -1;
    return static_cast<int>(result);
}

int statfs(const char* path, struct statfs* found) {
    const long result = syscall(SYS_statfs, path, found);
    if (result == 0 && lacks("shared")) found->f_type = 0x6969;  // NFS
    return static_cast<int>(result);
}

int statfs64(const char* path, struct statfs64* found) {
    return statfs(path, reinterpret_cast<struct statfs*>(found));  // the same on 64 bits
}

int fcntl64(int file, int command, ...) {
    va_list rest;
    va_start(rest, command);
    void* argument = va_arg(rest, void*);
    va_end(rest);
    return static_cast<int>(control(file, command, argument));
}

int fcntl(int file, int command, ...) {
    va_list rest;
    va_start(rest, command);
    void* argument = va_arg(rest, void*);
    va_end(rest);
    return static_cast<int>(control(file, command, argument));
}

}  // extern "C"
