// SPDX-License-Identifier: GPL-2.0-or-later
//
// Preloaded, it makes one of a program's calls to the file system fail, or kills the program there.
//
//   FAULTY_IO_FOLDER  only files below this folder count
//   FAULTY_IO_AT      which call, from 1; 0: none
//   FAULTY_IO_HOW     "fail": the call does nothing and returns an error; "kill": SIGKILL before it;
//                     "tear": a write puts half of its bytes there, then SIGKILL (writes alone count)
//   FAULTY_IO_LOG     where the number of calls is written at the end
//
// Counted are calls that look at, open, read, write, sync, close, lock, name and remove files and
// folders.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { most_descriptors = 1024 };

static char is_watched[most_descriptors];
static long calls;

static const char* setting(const char* name) {
  const char* const value = getenv(name);
  return value ? value : "";
}

/// Whether a path is below the folder; one that does not begin at the root is in the working folder.
static int concerns(const char* path) {
  const char* const folder = setting("FAULTY_IO_FOLDER");
  char here[PATH_MAX];
  if (!*folder) return 0;
  if (path[0] == '/') return strncmp(path, folder, strlen(folder)) == 0;
  return getcwd(here, sizeof here) && strncmp(here, folder, strlen(folder)) == 0;
}

static int is_watched_descriptor(int descriptor) {
  return descriptor >= 0 && descriptor < most_descriptors && is_watched[descriptor];
}

static int watch(int descriptor) {
  if (descriptor >= 0 && descriptor < most_descriptors) is_watched[descriptor] = 1;
  return descriptor;
}

static int tears(void) { return strcmp(setting("FAULTY_IO_HOW"), "tear") == 0; }

/// Counts a write. Whether it is the one of which half is done.
static int is_torn(void) { return tears() && ++calls == atol(setting("FAULTY_IO_AT")); }

/// Counts a call. Whether it is the one that fails; it does not return where the program is killed.
static int is_chosen(void) {
  if (tears()) return 0;
  if (++calls != atol(setting("FAULTY_IO_AT"))) return 0;
  if (strcmp(setting("FAULTY_IO_HOW"), "kill") == 0) syscall(SYS_kill, getpid(), SIGKILL);
  return 1;
}

static int fails(int error) {
  errno = error;
  return -1;
}

__attribute__((destructor)) static void tell(void) {
  char text[32];
  const int length = snprintf(text, sizeof text, "%ld\n", calls);
  const long file =
      syscall(SYS_openat, AT_FDCWD, setting("FAULTY_IO_LOG"), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0) return;
  if (syscall(SYS_write, file, text, length) != length) _exit(99);
  syscall(SYS_close, file);
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static mode_t mode_of(int flags, va_list words) {
  return flags & (O_CREAT | __O_TMPFILE) ? va_arg(words, mode_t) : 0;
}

#define OPEN(name)                                            \
  int name(const char* path, int flags, ...) {                \
    va_list words;                                            \
    va_start(words, flags);                                   \
    const mode_t mode = mode_of(flags, words);                \
    va_end(words);                                            \
    if (!concerns(path)) return NEXT(name)(path, flags, mode); \
    if (is_chosen()) return fails(EIO);                       \
    return watch(NEXT(name)(path, flags, mode));              \
  }
OPEN(open)
OPEN(open64)

int openat(int folder, const char* path, int flags, ...) {
  va_list words;
  va_start(words, flags);
  const mode_t mode = mode_of(flags, words);
  va_end(words);
  if (!concerns(path)) return NEXT(openat)(folder, path, flags, mode);
  if (is_chosen()) return fails(EIO);
  return watch(NEXT(openat)(folder, path, flags, mode));
}

/// Streams of the C and C++ libraries, which read and write by calls that are counted.
#define OPEN_STREAM(name)                                    \
  FILE* name(const char* path, const char* mode) {           \
    if (!concerns(path)) return NEXT(name)(path, mode);      \
    if (is_chosen()) return fails(EIO), NULL;                \
    FILE* const stream = NEXT(name)(path, mode);             \
    if (stream) watch(fileno(stream));                       \
    return stream;                                           \
  }
OPEN_STREAM(fopen)
OPEN_STREAM(fopen64)

DIR* opendir(const char* path) {
  if (!concerns(path)) return NEXT(opendir)(path);
  if (is_chosen()) return fails(EIO), NULL;
  DIR* const folder = NEXT(opendir)(path);
  if (folder) watch(dirfd(folder));
  return folder;
}

#define READ_FOLDER(name, entry)                                                      \
  struct entry* name(DIR* folder) {                                                  \
    if (is_watched_descriptor(dirfd(folder)) && is_chosen()) return fails(EIO), NULL; \
    return NEXT(name)(folder);                                                       \
  }
READ_FOLDER(readdir, dirent)
READ_FOLDER(readdir64, dirent64)

int closedir(DIR* folder) {
  const int file = dirfd(folder);
  if (file >= 0 && file < most_descriptors) is_watched[file] = 0;
  return NEXT(closedir)(folder);
}

ssize_t write(int file, const void* bytes, size_t size) {
  if (!is_watched_descriptor(file)) return NEXT(write)(file, bytes, size);
  if (is_torn()) {
    NEXT(write)(file, bytes, size / 2);
    syscall(SYS_kill, getpid(), SIGKILL);
  }
  return is_chosen() ? fails(ENOSPC) : NEXT(write)(file, bytes, size);
}

#define ON_DESCRIPTOR(result, name, error, parameters, ...)                      \
  result name parameters {                                                      \
    if (is_watched_descriptor(file) && is_chosen()) return fails(error);         \
    return NEXT(name)(__VA_ARGS__);                                             \
  }
ON_DESCRIPTOR(ssize_t, pwrite, ENOSPC, (int file, const void* b, size_t n, off_t at), file, b, n, at)
ON_DESCRIPTOR(ssize_t, pwrite64, ENOSPC, (int file, const void* b, size_t n, off64_t at), file, b, n,
              at)
ON_DESCRIPTOR(ssize_t, read, EIO, (int file, void* b, size_t n), file, b, n)
ON_DESCRIPTOR(ssize_t, pread, EIO, (int file, void* b, size_t n, off_t at), file, b, n, at)
ON_DESCRIPTOR(ssize_t, pread64, EIO, (int file, void* b, size_t n, off64_t at), file, b, n, at)
ON_DESCRIPTOR(int, fsync, EIO, (int file), file)
ON_DESCRIPTOR(int, fdatasync, EIO, (int file), file)
ON_DESCRIPTOR(int, ftruncate, EIO, (int file, off_t size), file, size)
ON_DESCRIPTOR(int, ftruncate64, EIO, (int file, off64_t size), file, size)
ON_DESCRIPTOR(off_t, lseek, EIO, (int file, off_t at, int from), file, at, from)
ON_DESCRIPTOR(off64_t, lseek64, EIO, (int file, off64_t at, int from), file, at, from)
ON_DESCRIPTOR(int, fstat, EIO, (int file, struct stat* s), file, s)
ON_DESCRIPTOR(int, fstat64, EIO, (int file, struct stat64* s), file, s)
ON_DESCRIPTOR(int, flock, ENOLCK, (int file, int how), file, how)

/// A file is closed even where the call returns an error.
int close(int file) {
  if (!is_watched_descriptor(file)) return NEXT(close)(file);
  const int chosen = is_chosen();
  is_watched[file] = 0;
  const int closed = NEXT(close)(file);
  return chosen ? fails(EIO) : closed;
}

#define ON_PATH(name, parameters, ...)                              \
  int name parameters {                                            \
    if (concerns(path) && is_chosen()) return fails(EIO);           \
    return NEXT(name)(__VA_ARGS__);                                \
  }
ON_PATH(rename, (const char* path, const char* to), path, to)
ON_PATH(unlink, (const char* path), path)
ON_PATH(remove, (const char* path), path)
ON_PATH(rmdir, (const char* path), path)
ON_PATH(mkdir, (const char* path, mode_t mode), path, mode)
ON_PATH(stat, (const char* path, struct stat* s), path, s)
ON_PATH(stat64, (const char* path, struct stat64* s), path, s)
ON_PATH(lstat, (const char* path, struct stat* s), path, s)
ON_PATH(lstat64, (const char* path, struct stat64* s), path, s)
ON_PATH(access, (const char* path, int mode), path, mode)
ON_PATH(truncate, (const char* path, off_t size), path, size)

ssize_t readlink(const char* path, char* target, size_t size) {
  if (concerns(path) && is_chosen()) return fails(EIO);
  return NEXT(readlink)(path, target, size);
}

char* realpath(const char* path, char* resolved) {
  if (concerns(path) && is_chosen()) return fails(EIO), NULL;
  return NEXT(realpath)(path, resolved);
}

#define AT_FOLDER(name, parameters, ...)                    \
  int name parameters {                                    \
    if (concerns(path) && is_chosen()) return fails(EIO);   \
    return NEXT(name)(folder, path, __VA_ARGS__);          \
  }
AT_FOLDER(fstatat, (int folder, const char* path, struct stat* s, int how), s, how)
AT_FOLDER(fstatat64, (int folder, const char* path, struct stat64* s, int how), s, how)
AT_FOLDER(faccessat, (int folder, const char* path, int mode, int how), mode, how)
AT_FOLDER(unlinkat, (int folder, const char* path, int how), how)
AT_FOLDER(statx, (int folder, const char* path, int how, unsigned mask, struct statx* s), how, mask, s)
