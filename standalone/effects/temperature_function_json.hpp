// SPDX-License-Identifier: GPL-2.0-or-later
//
// What `solidem explain --json` says of a property over temperature.
#ifndef SOLIDEM_EFFECTS_TEMPERATURE_FUNCTION_JSON_HPP
#define SOLIDEM_EFFECTS_TEMPERATURE_FUNCTION_JSON_HPP

#include <nlohmann/json.hpp>

#include "model/temperature_function.hpp"

namespace solidem {

/// A constant as a number, a table as {temperature, value}.
inline nlohmann::ordered_json to_json(const TemperatureFunction& f) {
  if (f.is_constant()) return f(0);
  return {{"temperature", f.temperatures()}, {"value", f.values()}};
}

}  // namespace solidem

#endif
