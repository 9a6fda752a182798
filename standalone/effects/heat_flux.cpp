// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_flux.hpp"

#include "effects/effect_kind.hpp"
#include "effects/heat_places.hpp"
#include "keys/rules.hpp"

namespace solidem {

void HeatFlux::powers(double time, const double* /*temperature*/,
                      std::vector<ElementValue>& powers) const {
  const double flux = flux_(time);
  for (const WallFace& face : faces_) powers.push_back({face.element, flux * face.area});
}

namespace {

std::vector<Key> flux_keys(HeatFluxParameters& p, Reading& reading) {
  return {must_have("name", name(p.name, reading.taken)).means("names its columns"),
          must_have("wall", wall(p.wall)),
          must_have("flux", function(p.flux, dimension::heat_flux)).means("into the body")};
}

void plan_fluxes(const Setup& setup, Plan& plan) {
  for (const HeatFluxParameters& flux : setup.all<HeatFluxParameters>())
    plan.effects.push_back(
        {"heat flux " + flux.name, "[[heat_fluxes]]", "", Phase::heat, [flux](Assembly& assembly) {
           return std::make_unique<HeatFlux>(
               flux, faces_of(assembly, "heat_fluxes", flux.name, flux.wall));
         }});
}

}  // namespace

EffectKind heat_fluxes_kind() {
  EffectKind kind =
      list_kind<HeatFluxParameters>("heat_fluxes", flux_keys, as_read<HeatFluxParameters>);
  kind.needs = Provides::heat;
  kind.plan = plan_fluxes;
  kind.example =
      "[[heat_fluxes]]\n"
      "name = \"lamp\"\n"
      "wall = \"y_high\"\n"
      "flux = \"1 MW/m^2\"\n";
  return kind;
}

}  // namespace solidem
