// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every kind of effect, in the order in which they are read, planned and report: each is
// `EffectKind NAME_kind()` at the foot of its own file. A new one is a line here.
#include "effects/effect_kind.hpp"

// clang-format off
#define SOLIDEM_EFFECT_KINDS(kind) \
  kind(beams) \
  kind(plasticity) \
  kind(rupture) \
  kind(contact) \
  kind(damage) \
  kind(central_forces) \
  kind(gravity) \
  kind(tools) \
  kind(initial_velocities) \
  kind(grips) \
  kind(damping) \
  kind(conduction) \
  kind(thermal_contacts) \
  kind(heat_sources) \
  kind(heat_fluxes) \
  kind(convections) \
  kind(temperatures) \
  kind(plastic_heat) \
  kind(friction_heat) \
  kind(contact_conduction) \
  kind(expansion) \
  kind(softening) \
  kind(mass_scaling)
// clang-format on

namespace solidem {

#define SOLIDEM_DECLARE(name) EffectKind name##_kind();
SOLIDEM_EFFECT_KINDS(SOLIDEM_DECLARE)

std::vector<EffectKind>& effect_kinds() {
#define SOLIDEM_ENTER(name) name##_kind(),
  static std::vector<EffectKind> kinds{SOLIDEM_EFFECT_KINDS(SOLIDEM_ENTER)};
  return kinds;
}

}  // namespace solidem
