// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_COLOURS_HPP
#define SOLIDEM_APP_COLOURS_HPP

#include <cstdio>
#include <string>

namespace solidem {

enum class Look { error, note, result };

/// Whether a stream shows colours: a terminal that can, and nobody asked for none (NO_COLOR).
bool shows_colours(std::FILE* stream);

/// A text with the look of what it is, where the stream shows colours; else the text.
std::string with_look(Look look, const std::string& text, std::FILE* stream);

}  // namespace solidem

#endif
