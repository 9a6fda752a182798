// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_NEAREST_NAME_HPP
#define SOLIDEM_KEYS_NEAREST_NAME_HPP

#include <string>
#include <vector>

namespace solidem {

/// Letters to insert, delete, replace or swap with their neighbour to turn one word into another
/// (optimal string alignment), upper and lower case being the same.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The name a misspelt word was probably meant to be; empty when none is near.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// " (did you mean NAME?)" or nothing, to end the complaint about a word.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

/// "a, b, c".
std::string join(const std::vector<std::string>& names);

}  // namespace solidem

#endif
