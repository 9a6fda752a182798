// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_SAY_HPP
#define SOLIDEM_APP_SAY_HPP

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace solidem {

/// Prints on the standard output. That it cannot be written does not end what is going on: main
/// tells it at the end.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// Says things to people, or nothing where a program asked for figures alone.
struct Voice {
  bool is_silent;
  template <class... Values>
  void operator()(fmt::format_string<Values...> format, Values&&... values) const {
    if (!is_silent) say(format, std::forward<Values>(values)...);
  }
};

}  // namespace solidem

#endif
