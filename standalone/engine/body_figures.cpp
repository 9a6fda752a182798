// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/body_figures.hpp"

#include <nlohmann/json.hpp>

namespace solidem {

nlohmann::ordered_json body_figures(const Model& model) {
  nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
  for (const Body& body : model.specimen().bodies) {
    nlohmann::ordered_json figures = {{"name", body.name},
                                      {"shape", body.shape},
                                      {"elements", body.elements.size()},
                                      {"volume", body.volume}};
    if (model.has(columns::inverse_mass)) {
      double mass = 0;
      for (const std::int32_t element : body.elements)
        mass += 1 / model.data(columns::inverse_mass)[element];
      figures["mass"] = mass;
    }
    bodies.push_back(std::move(figures));
  }
  return bodies;
}

}  // namespace solidem
