// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_BODY_FIGURES_HPP
#define SOLIDEM_ENGINE_BODY_FIGURES_HPP

#include <nlohmann/json_fwd.hpp>

#include "model/model.hpp"

namespace solidem {

/// Of each of several bodies: name, shape, number of elements, volume (m³) and, where elements
/// move, mass (kg).
nlohmann::ordered_json body_figures(const Model& model);

}  // namespace solidem

#endif
