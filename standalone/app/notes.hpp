// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_NOTES_HPP
#define SOLIDEM_APP_NOTES_HPP

#include <string>
#include <vector>

#include "app/colours.hpp"
#include "app/say.hpp"

namespace solidem {

/// Prints "note: ..." lines.
inline void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes)
    say("{} {}\n", with_look(Look::note, "note:", stdout), note);
}

}  // namespace solidem

#endif
