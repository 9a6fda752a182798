// SPDX-License-Identifier: GPL-2.0-or-later
//
// The grammar of the command line: commands, options and their words of help, once. Parsing, the
// manual and the completion follow from it.
#ifndef SOLIDEM_APP_COMMAND_LINE_HPP
#define SOLIDEM_APP_COMMAND_LINE_HPP

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace solidem {

/// What a command does; the exit status.
using Action = std::function<int()>;

/// Declares all commands and options. Parsing sets `chosen`.
void declare_commands(CLI::App& app, Action& chosen);

/// What is wrong with the words of a command line that could not be parsed, and what would be
/// right: "run: there is no option --ouput (did you mean --output?); ...".
std::string complaint_of(const CLI::App& app, const CLI::ParseError& error);

/// The commands below one, in the order of their declaration.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// Its options with a dash, of which --help is the first; those that stand alone.
std::vector<const CLI::Option*> options_of(const CLI::App& command);
std::vector<const CLI::Option*> positionals_of(const CLI::App& command);

/// Whether an option is followed by a value.
bool takes_value(const CLI::Option& option);

/// The manual of the program, as a page for man(1).
std::string manual_page(const CLI::App& app);

/// What bash reads to complete the words of a command.
std::string bash_completion(const CLI::App& app);

}  // namespace solidem

#endif
