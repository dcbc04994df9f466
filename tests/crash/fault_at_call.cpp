// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program, it lets the n-th call of open, write, fsync or rename below a folder fail, or the n-th
// memory (malloc and its kin) or fork (posix_spawn too) of a process.
//   FAULT_UNDER=/folder/    which files count
//   FAULT=write:17:28       the 17th write fails with errno 28; write:17+:28 every one from the 17th on
//   FAULT_COUNTS=file       how often each was called is added there when a process ends
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

namespace {

enum Call { open_call, write_call, fsync_call, rename_call, fork_call, memory_call, calls };
constexpr const char* names[calls] = {"open", "write", "fsync", "rename", "fork", "memory"};

// Memory is asked for before anything is constructed, by the construction too.
constinit std::atomic<long> memory_asked = 0, memory_denied_at = -1;

bool memory_is_denied() {
  if (++memory_asked != memory_denied_at) return false;
  errno = ENOMEM;
  return true;
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

struct Order {
  Call call = calls;
  long at = 0;
  bool from_there_on = false;
  int error = EIO;
  std::string under, counts;
  std::atomic<long> seen[calls] = {};

  Order() {
    if (const char* folder = std::getenv("FAULT_UNDER")) under = folder;
    if (const char* file = std::getenv("FAULT_COUNTS")) counts = file;
    const char* fault = std::getenv("FAULT");
    if (fault == nullptr) return;
    char name[16] = {}, mark = 0;
    if (std::sscanf(fault, "%15[a-z]:%ld%c%d", name, &at, &mark, &error) < 3) return;
    if (mark == '+') {
      from_there_on = true;
      error = std::atoi(std::strrchr(fault, ':') + 1);
    }
    for (int k = 0; k < calls; ++k)
      if (std::strcmp(name, names[k]) == 0) call = static_cast<Call>(k);
    if (call == memory_call) memory_denied_at = at;
  }
  ~Order() {
    if (counts.empty()) return;
    seen[memory_call] = memory_asked.load();
    const int file =
        original<int (*)(const char*, int, ...)>("open")(counts.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
    for (int k = 0; k < calls; ++k) dprintf(file, "%s %ld\n", names[k], seen[k].load());
    close(file);
  }

  bool strikes(Call what) {
    const long number = ++seen[what];
    if (what != call || number < at || (number > at && !from_there_on)) return false;
    errno = error;
    return true;
  }
  bool holds(const char* path) const {
    if (path == nullptr || under.empty()) return false;
    char whole[4096];
    if (path[0] == '/') {
      std::snprintf(whole, sizeof whole, "%s", path);
    } else {
      if (getcwd(whole, sizeof whole / 2) == nullptr) return false;
      std::strncat(whole, "/", 2);
      std::strncat(whole, path, sizeof whole / 2 - 2);
    }
    return std::strncmp(whole, under.c_str(), under.size()) == 0;
  }
  bool holds(int descriptor) const {
    char link[64], path[4096];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return false;
    path[length] = 0;
    return holds(path);
  }
};

Order& order() {
  static Order one;
  return one;
}

/// Before main(), so that the denial of memory is known.
[[maybe_unused]] const Order& at_start = order();

int opened(const char* function, const char* path, int how, mode_t mode) {
  if (order().holds(path) && order().strikes(open_call)) return -1;
  return original<int (*)(const char*, int, ...)>(function)(path, how, mode);
}

mode_t mode_of(int how, std::va_list& rest) {
  return (how & (O_CREAT | O_TMPFILE)) != 0 ? static_cast<mode_t>(va_arg(rest, int)) : 0;
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

int open(const char* path, int how, ...) {
  std::va_list rest;
  va_start(rest, how);
  const mode_t mode = mode_of(how, rest);
  va_end(rest);
  return opened("open", path, how, mode);
}

int open64(const char* path, int how, ...) {
  std::va_list rest;
  va_start(rest, how);
  const mode_t mode = mode_of(how, rest);
  va_end(rest);
  return opened("open64", path, how, mode);
}

FILE* fopen(const char* path, const char* mode) {
  if (order().holds(path) && order().strikes(open_call)) return nullptr;
  return original<FILE* (*)(const char*, const char*)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  if (order().holds(path) && order().strikes(open_call)) return nullptr;
  return original<FILE* (*)(const char*, const char*)>("fopen64")(path, mode);
}

ssize_t write(int descriptor, const void* data, size_t size) {
  if (order().holds(descriptor) && order().strikes(write_call)) {
    // A full disk takes a part first.
    if (order().error == ENOSPC && size > 1) {
      const auto real = original<ssize_t (*)(int, const void*, size_t)>("write");
      [[maybe_unused]] const ssize_t part = real(descriptor, data, size / 2);
      errno = ENOSPC;
    }
    return -1;
  }
  return original<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, data, size);
}

int fsync(int descriptor) {
  if (order().holds(descriptor) && order().strikes(fsync_call)) return -1;
  return original<int (*)(int)>("fsync")(descriptor);
}

int fdatasync(int descriptor) {
  if (order().holds(descriptor) && order().strikes(fsync_call)) return -1;
  return original<int (*)(int)>("fdatasync")(descriptor);
}

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) { return memory_is_denied() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return memory_is_denied() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, size_t size) { return memory_is_denied() ? nullptr : __libc_realloc(memory, size); }
void* aligned_alloc(size_t alignment, size_t size) {
  return memory_is_denied() ? nullptr : __libc_memalign(alignment, size);
}

pid_t fork() {
  if (order().strikes(fork_call)) return -1;
  return original<pid_t (*)()>("fork")();
}

int posix_spawn(pid_t* process, const char* path, const posix_spawn_file_actions_t* actions,
                const posix_spawnattr_t* attributes, char* const arguments[], char* const environment[]) {
  if (order().strikes(fork_call)) return order().error;
  return original<decltype(&posix_spawn)>("posix_spawn")(process, path, actions, attributes, arguments, environment);
}

int rename(const char* from, const char* to) {
  if (order().holds(to) && order().strikes(rename_call)) return -1;
  return original<int (*)(const char*, const char*)>("rename")(from, to);
}

}  // extern "C"
