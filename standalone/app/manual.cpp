// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cctype>

#include "app/command_line.hpp"
#include "output/summary.hpp"

namespace solidem {

namespace {

/// Text for troff: dashes that can be copied, no line that would be a request.
std::string escaped(const std::string& text) {
  std::string safe;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool opens_line = k == 0 || text[k - 1] == '\n';
    if (opens_line && (text[k] == '.' || text[k] == '\'')) safe += "\\&";
    if (text[k] == '\\')
      safe += "\\e";
    else if (text[k] == '-')
      safe += "\\-";
    else
      safe += text[k];
  }
  return safe;
}

std::string in_bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}
std::string in_italics(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string names_of(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : option.get_snames())
    text += (text.empty() ? "" : ", ") + in_bold("-" + name);
  for (const std::string& name : option.get_lnames())
    text += (text.empty() ? "" : ", ") + in_bold("--" + name);
  return takes_value(option) ? text + " " + in_italics(option.get_type_name()) : text;
}

std::string entry(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + escaped(text) + "\n";
}

std::string synopsis_of(const CLI::App& command, const std::string& name) {
  std::string text = in_bold(name) + " [options]";
  for (const CLI::Option* word : positionals_of(command)) {
    const std::string shown = in_italics(word->get_name(true));
    text += word->get_required() ? " " + shown : " [" + shown + "]";
  }
  return text;
}

/// A command; those below it instead, where there are some.
std::string section_of(const CLI::App& command, const std::string& before) {
  const std::string name = before + " " + command.get_name();
  std::string text;
  for (const CLI::App* below : commands_of(command)) text += section_of(*below, name);
  if (!text.empty()) return text;
  text = ".SS " + synopsis_of(command, name) + "\n" + escaped(command.get_description()) + ".\n";
  for (const CLI::Option* word : positionals_of(command))
    text += entry(in_italics(word->get_name(true)), word->get_description());
  for (const CLI::Option* option : options_of(command))
    if (!option->check_lname("help")) text += entry(names_of(*option), option->get_description());
  if (!command.get_footer().empty())
    text += ".PP\n.nf\n" + escaped(command.get_footer()) + "\n.fi\n";
  return text;
}

constexpr const char* foot = R"(.SH ENVIRONMENT
.TP
.B OMP_NUM_THREADS
Number of threads, where \-\-threads does not say it.
.TP
.B SOLIDEM_INSTRUCTION_SET
One of those that \-\-version tells, in place of the best.
.TP
.B NO_COLOR
Where it is set and not empty, the terminal is shown no colours.
.SH EXIT STATUS
.TP
.B 0
All was done.
.TP
.B 1
It could not go on: a run diverged, a file could not be written.
.TP
.B 2
Something given cannot be used; the message names it and says what would be right.
.TP
.B 130
A run was interrupted; \-\-resume goes on with it.
.SH EXAMPLES
.nf
solidem explain tension.toml
solidem run tension.toml \-\-output results/tension \-\-set beams.young_modulus="3 TPa"
solidem solve tension.toml \-\-json \-\-output results/rest
solidem completion > ~/.local/share/bash\-completion/completions/solidem
.fi
.SH SEE ALSO
.BR paraview (1)
)";

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::string text = ".TH SOLIDEM 1 \"\" \"solidem " + version() + "\" \"User Commands\"\n";
  std::string description = app.get_description();
  description[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(description[0])));
  text += ".SH NAME\nsolidem \\- " + escaped(description) + "\n.SH SYNOPSIS\n";
  for (const CLI::App* command : commands_of(app))
    text += in_bold("solidem " + command->get_name()) + " [options] ...\n.br\n";
  text += in_bold("solidem") + " [" + in_bold("--help") + " | " + in_bold("--version") + "]\n";
  text +=
      ".SH DESCRIPTION\nSimulates continuous solids by the discrete element method. A scene "
      "file says what body, of what, how it is loaded; its keys are told by " +
      in_bold("solidem keys") + ".\n.SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) text += section_of(*command, "solidem");
  return text + foot;
}

}  // namespace solidem
