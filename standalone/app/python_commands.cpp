// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/python_commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "model/error.hpp"

namespace solidem {

namespace {

constexpr const char* call = R"(
import sys
try:
    from solidem.{0} import main
except ModuleNotFoundError as missing:
    print(f"error: solidem {0} needs Python's {{missing.name}}, which {{sys.executable}} has not; "
          f"Debian's package python3-{{missing.name}} brings it, as does pip", file=sys.stderr)
    sys.exit(1)
sys.exit(main())
)";

/// Lets Python find the module of the build that this program stands in.
void prefer_the_module_beside() {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  const auto beside = program.parent_path() / "python";
  if (failed || !std::filesystem::exists(beside / "solidem" / "__init__.py", failed)) return;
  const char* others = std::getenv("PYTHONPATH");
  const std::string path = beside.string() + (others != nullptr ? ":" + std::string(others) : "");
  setenv("PYTHONPATH", path.c_str(), 1);
}

}  // namespace

void call_python(const std::string& command, const std::vector<std::string>& words) {
  prefer_the_module_beside();
  std::vector<std::string> all{"python3", "-c", fmt::format(call, command)};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // Another Python may come first on the path and not see Debian's modules.
  if (std::getenv("VIRTUAL_ENV") == nullptr) execv("/usr/bin/python3", arguments.data());
  execvp("python3", arguments.data());
  throw RunError(fmt::format("solidem {} needs Python: python3 cannot be called: {}", command,
                             std::strerror(errno)));
}

}  // namespace solidem
