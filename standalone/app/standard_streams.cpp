// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <initializer_list>

namespace solidem {

void secure_standard_streams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(number, F_GETFD) >= 0) continue;
    // It takes the lowest number. The wrong way round, so that using it still is an error.
    if (::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
  std::signal(SIGPIPE, SIG_IGN);
}

int status_with_output(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  const char* const reason = errno != 0 ? std::strerror(errno) : "it could not be written";
  std::fprintf(stderr, "error: cannot write the standard output: %s\n", reason);
  return status == 0 ? 1 : status;
}

}  // namespace solidem
