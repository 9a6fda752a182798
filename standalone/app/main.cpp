// SPDX-License-Identifier: GPL-2.0-or-later
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "app/colours.hpp"
#include "app/command_line.hpp"
#include "app/standard_streams.hpp"
#include "model/error.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

/// Threads that wait for the next loop spin only shortly: long spinning takes the processor from
/// whatever else runs, and from the very thread that is waited for. OpenMP reads this before main
/// begins, so the program starts itself again.
void wait_patiently(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "2000", 1);  // some microseconds: what a loop of a small body takes
  execv("/proc/self/exe", argv);        // where that cannot be, all goes on as it is
}

/// Tells what went wrong; the exit status.
int fail(int status, const char* what, const std::string& reason) {
  const std::string opening = solidem::with_look(solidem::Look::error, what, stderr);
  std::fprintf(stderr, "%s %s\n", opening.c_str(), reason.c_str());
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  wait_patiently(argv);
  solidem::secure_standard_streams();
#if defined(__GLIBC__)
  // Arrays larger than this get pages of their own, which go back to the system when they are
  // freed; left to itself glibc would soon keep them.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
  CLI::App app{"Continuous solids as compact packings of spheres", "solidem"};
  solidem::Action chosen;
  solidem::declare_commands(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // for help, or for the version
    return solidem::status_with_output(app.exit(asked));
  } catch (const CLI::ParseError& error) {
    return fail(2, "error:", solidem::complaint_of(app, error));
  }
  try {
    return solidem::status_with_output(chosen());
  } catch (const solidem::InputError& error) {
    return fail(2, "error:", error.what());
  } catch (const solidem::RunError& error) {
    return fail(1, "error:", error.what());
  } catch (const std::bad_alloc&) {
    return fail(1, "error:", "out of memory; fewer elements, or a larger machine");
  } catch (const std::exception& error) {
    return fail(3, "internal error:", error.what());
  }
}
