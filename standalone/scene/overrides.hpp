// SPDX-License-Identifier: GPL-2.0-or-later
//
// Values that are given beside a scene file and hold instead of those in it:
//
//   beams.young_modulus=3 TPa      a key of a section, which is made if the file has none
//   grips.right.velocity.0=1 m/s   of a list, the section of this name; of an array, the first
//   entry run.duration=                  without a value the key goes
#ifndef SOLIDEM_SCENE_OVERRIDES_HPP
#define SOLIDEM_SCENE_OVERRIDES_HPP

#include <toml++/toml.h>
#include <string>

namespace solidem {

/// Puts the value of "KEY=VALUE" into a scene. Keys are dotted as in TOML; entries of lists are
/// known by their `name` or by their number, from 0. A value is TOML, or a text without quotation
/// marks. What is put in says by its source that it stands in no file: "--set KEY=VALUE". Throws
/// InputError, which begins so, where this is no key and value, or leads nowhere.
void override_value(toml::table& scene, const std::string& assignment);

}  // namespace solidem

#endif
