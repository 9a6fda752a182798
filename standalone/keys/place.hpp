// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_PLACE_HPP
#define SOLIDEM_KEYS_PLACE_HPP

#include <toml++/toml.h>

#include <string>

namespace solidem {

/// Where a value of a scene file stands: "scene.toml:12"; what was given beside the file says so
/// itself, "--set run.steps=3".
std::string place_of(const toml::node& node, const std::string& file);

/// Whether a value is a list of sections: [[grips]].
bool is_array_of_tables(const toml::node& node);

}  // namespace solidem

#endif
