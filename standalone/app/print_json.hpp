// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_PRINT_JSON_HPP
#define SOLIDEM_APP_PRINT_JSON_HPP

#include <nlohmann/json.hpp>

#include "app/say.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// Prints figures for programs. Names in another encoding than UTF-8 must not cost them.
inline void print_json(const nlohmann::ordered_json& json) {
  say("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// A vector in the order x, y, z.
inline nlohmann::ordered_json json_of(const Vector& v) {
  return {v.x, v.y, v.z};
}

}  // namespace solidem

#endif
