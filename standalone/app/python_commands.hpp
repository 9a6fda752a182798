// SPDX-License-Identifier: GPL-2.0-or-later
//
// Commands that the Python module has: `solidem view`, `solidem converge` and
// `solidem advise`.
#ifndef SOLIDEM_APP_PYTHON_COMMANDS_HPP
#define SOLIDEM_APP_PYTHON_COMMANDS_HPP

#include <string>
#include <vector>

namespace solidem {

/// Becomes Python, which calls solidem.COMMAND with these words. The module is looked for beside
/// the program, where a build puts it, then where Python finds it: Debian's, or that of the virtual
/// environment which is active. Throws RunError where there is no Python.
[[noreturn]] void call_python(const std::string& command, const std::vector<std::string>& words);

}  // namespace solidem

#endif
