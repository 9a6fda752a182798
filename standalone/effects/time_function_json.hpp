// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_TIME_FUNCTION_JSON_HPP
#define SOLIDEM_EFFECTS_TIME_FUNCTION_JSON_HPP

#include <nlohmann/json.hpp>

#include "model/time_function.hpp"

namespace solidem {

/// A function of time as `solidem explain --json` tells it: its table and its sine.
inline nlohmann::ordered_json to_json(const TimeFunction& f) {
  return {{"time", f.time},
          {"value", f.value},
          {"amplitude", f.amplitude},
          {"frequency", f.frequency},
          {"phase", f.phase}};
}

}  // namespace solidem

#endif
