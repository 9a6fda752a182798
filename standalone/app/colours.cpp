// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/colours.hpp"

#include <fmt/color.h>
#include <unistd.h>

#include <cstdlib>

namespace solidem {

namespace {

fmt::text_style style_of(Look look) {
  switch (look) {
    case Look::error:
      return fmt::emphasis::bold | fg(fmt::terminal_color::red);
    case Look::note:
      return fg(fmt::terminal_color::yellow);
    case Look::result:
      break;
  }
  return fmt::emphasis::bold;
}

}  // namespace

bool shows_colours(std::FILE* stream) {
  const char* const unwanted = std::getenv("NO_COLOR");
  if (unwanted != nullptr && *unwanted != '\0') return false;
  const char* const terminal = std::getenv("TERM");
  if (terminal == nullptr || std::string(terminal) == "dumb") return false;
  return ::isatty(fileno(stream)) == 1;
}

std::string with_look(Look look, const std::string& text, std::FILE* stream) {
  return shows_colours(stream) ? fmt::format(style_of(look), "{}", text) : text;
}

}  // namespace solidem
