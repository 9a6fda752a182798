// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "app/command_line.hpp"

namespace solidem {

namespace {

std::string options_text(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : options_of(command)) {
    for (const std::string& name : option->get_snames()) text += " -" + name;
    for (const std::string& name : option->get_lnames()) text += " --" + name;
  }
  return text.empty() ? text : text.substr(1);
}

/// One branch of the script for each command: what may follow it.
std::string branches_of(const CLI::App& app, const std::string& before) {
  std::string text, names;
  for (const CLI::App* command : commands_of(app)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    const std::string path =
        before.empty() ? command->get_name() : before + " " + command->get_name();
    text += branches_of(*command, path);
  }
  return text + fmt::format("    \"{}\") commands=\"{}\" options=\"{}\" ;;\n", before, names,
                            options_text(app));
}

constexpr const char* script = R"(# Completes the words of solidem in bash.
_solidem() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} command="" commands options k
  COMPREPLY=()
  for ((k = 0; k < COMP_CWORD; k++)); do
    case $command in
{}    esac
    [ $k -gt 0 ] && [[ " $commands " == *" ${{COMP_WORDS[k]}} "* ]] &&
      command="${{command:+$command }}${{COMP_WORDS[k]}}"
  done
  case $command in
{}  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif [ -n "$commands" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _solidem solidem
)";

}  // namespace

std::string bash_completion(const CLI::App& app) {
  const std::string branches = branches_of(app, "");
  return fmt::format(script, branches, branches);
}

}  // namespace solidem
