// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A library for LD_PRELOAD that lets a program fail: the Nth of its calls that change files, or of
/// its allocations, fails or is its last.
///
///     TANGENCY_FAULT=files:17:kill       the process is killed at the 17th, as by kill -9
///     TANGENCY_FAULT=files:17:half       killed when half of a write, or nothing else, is done
///     TANGENCY_FAULT=files:17:28         the 17th fails with errno 28
///     TANGENCY_FAULT=files:17+:28        it and all after it, as on a disk that is full
///     TANGENCY_FAULT=memory:17:12        the 17th allocation of the program fails; + as above
///     TANGENCY_FAULT_COUNT=FILE          how many there were, written when the program ends
///
/// Files: open for writing, write, close of what was written, rename, link, unlink, rmdir, mkdir,
/// ftruncate, fsync; not what goes to the three standard streams. Allocations count from main() on.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

extern "C" {
// The allocator of glibc by its own names, so that no look-up allocates.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

enum class Kind { none, files, memory };
enum class Way { fail, kill, half };

/// What the environment asks for; read without an allocation.
struct Fault {
  Kind kind = Kind::none;
  long at = 0;
  bool lasts = false;
  Way way = Way::fail;
  int error = 0;

  Fault() {
    const char* text = std::getenv("TANGENCY_FAULT");
    if (text == nullptr) return;
    kind = std::strncmp(text, "memory:", 7) == 0 ? Kind::memory : Kind::files;
    text = std::strchr(text, ':') + 1;
    char* rest = nullptr;
    at = std::strtol(text, &rest, 10);
    lasts = *rest == '+';
    rest = std::strchr(rest, ':') + 1;
    if (std::strcmp(rest, "kill") == 0)
      way = Way::kill;
    else if (std::strcmp(rest, "half") == 0)
      way = Way::half;
    else
      error = static_cast<int>(std::strtol(rest, nullptr, 10));
  }
};

std::atomic<long> files{0}, allocations{0};
std::atomic<bool> in_main{false};

const Fault& fault() {
  static const Fault wanted;
  return wanted;
}

template <class Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(dlsym(RTLD_NEXT, name));
}

bool is_due(Kind kind, long count) {
  const Fault& wanted = fault();
  return wanted.kind == kind && (count == wanted.at || (wanted.lasts && count > wanted.at));
}

/// Is this call to fail, with errno set? Where it is to be the last it does not return.
/// @param takes_room  does it need some of the disk? Others succeed on one that is full.
bool fails_now(bool takes_room = true) {
  if (!is_due(Kind::files, ++files)) return false;
  const bool is_full = fault().error == ENOSPC || fault().error == EDQUOT;
  if (is_full && !takes_room) return false;
  if (fault().way != Way::fail) ::kill(::getpid(), SIGKILL);
  errno = fault().error;
  return true;
}

bool allocation_fails() {
  if (!in_main || !is_due(Kind::memory, ++allocations)) return false;
  errno = ENOMEM;
  return true;
}

bool changes(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0; }

/// Files that were opened for writing.
constexpr int kMostFiles = 1024;
std::atomic<bool> is_written[kMostFiles];

int opened(int file, int flags) {
  if (file >= 0 && file < kMostFiles) is_written[file] = changes(flags);
  return file;
}
bool is_written_to(int file) { return file > 2 && file < kMostFiles && is_written[file]; }

/// The count, by a system call of its own.
struct AtTheEnd {
  ~AtTheEnd() {
    const char* name = std::getenv("TANGENCY_FAULT_COUNT");
    if (name == nullptr) return;
    char text[64];
    char* end = text + sizeof text;
    *--end = '\n';
    const auto put = [&](long number) {
      do {
        *--end = static_cast<char>('0' + number % 10);
        number /= 10;
      } while (number > 0);
    };
    put(allocations);
    *--end = ' ';
    put(files);
    const auto file =
        static_cast<int>(::syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_TRUNC, 0666));
    ::syscall(SYS_write, file, end, static_cast<std::size_t>(text + sizeof text - end));
    ::syscall(SYS_close, file);
  }
} at_the_end;

using Main = int (*)(int, char**, char**);
Main program = nullptr;

int counted_main(int count, char** arguments, char** environment) {
  fault();
  in_main = true;
  return program(count, arguments, environment);
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int count, char** arguments, void (*begin)(), void (*end)(),
                      void (*loader_end)(), void* stack) {
  program = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  return next<Start>("__libc_start_main")(counted_main, count, arguments, begin, end, loader_end,
                                          stack);
}

void* malloc(std::size_t size) { return allocation_fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
  return allocation_fails() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  return allocation_fails() ? nullptr : __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return allocation_fails() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (allocation_fails()) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : mode_t{0};
  va_end(rest);
  if (changes(flags) && fails_now()) return -1;
  return opened(next<int (*)(const char*, int, ...)>("open")(name, flags, mode), flags);
}
int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : mode_t{0};
  va_end(rest);
  if (changes(flags) && fails_now()) return -1;
  return opened(next<int (*)(const char*, int, ...)>("open64")(name, flags, mode), flags);
}
ssize_t write(int file, const void* bytes, std::size_t size) {
  const auto real = next<ssize_t (*)(int, const void*, std::size_t)>("write");
  if (!is_written_to(file)) return real(file, bytes, size);
  if (fault().way == Way::half && files + 1 == fault().at) real(file, bytes, size / 2);
  return fails_now() ? -1 : real(file, bytes, size);
}
int close(int file) {
  const auto real = next<int (*)(int)>("close");
  if (!is_written_to(file)) return real(file);
  is_written[file] = false;
  if (!fails_now()) return real(file);
  const int error = errno;
  real(file);
  errno = error;
  return -1;
}
int rename(const char* from, const char* to) {
  return fails_now() ? -1 : next<int (*)(const char*, const char*)>("rename")(from, to);
}
int link(const char* from, const char* to) {
  return fails_now() ? -1 : next<int (*)(const char*, const char*)>("link")(from, to);
}
int unlink(const char* name) {
  return fails_now(false) ? -1 : next<int (*)(const char*)>("unlink")(name);
}
int rmdir(const char* name) {
  return fails_now(false) ? -1 : next<int (*)(const char*)>("rmdir")(name);
}
int remove(const char* name) {
  return fails_now(false) ? -1 : next<int (*)(const char*)>("remove")(name);
}
int mkdir(const char* name, mode_t mode) {
  return fails_now() ? -1 : next<int (*)(const char*, mode_t)>("mkdir")(name, mode);
}
int ftruncate(int file, off_t size) {
  return fails_now() ? -1 : next<int (*)(int, off_t)>("ftruncate")(file, size);
}
int fsync(int file) { return fails_now() ? -1 : next<int (*)(int)>("fsync")(file); }

}  // extern "C"
