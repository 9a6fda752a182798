// SPDX-License-Identifier: GPL-2.0-or-later
//
// [beams.anisotropy] and [beams.fibres].
#include <cmath>

#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

Rule direction(Vector& place) {
  const std::string expected = "three numbers [x, y, z], not all zero";
  return {expected, [&place, expected](const Value& value) {
            const std::vector<Value> entries = value.entries(3, expected);
            Vector v{};
            for (int k = 0; k < 3; ++k)
              component(v, k) = read_number(entries[static_cast<std::size_t>(k)], anything);
            const double length = norm(v);
            if (!(length > 0) || !std::isfinite(length)) value.refuse("no direction", expected);
            place = (1 / length) * v;
          }};
}

/// Makes the radial axis perpendicular to the grain to the last bit, if it is within a thousandth.
bool square_up(GrainAxes<double>& axes) {
  const double along = dot(axes.radial, axes.longitudinal);
  if (std::abs(along) > 1e-3) return false;
  const Vector across = axes.radial - along * axes.longitudinal;
  axes.radial = (1 / norm(across)) * across;
  return true;
}

/// Some direction across the grain, where all of them are alike.
Vector any_radial(const Vector& grain) {
  Vector least{};
  const double size[] = {std::abs(grain.x), std::abs(grain.y), std::abs(grain.z)};
  component(least, size[0] <= size[1] && size[0] <= size[2] ? 0 : size[1] <= size[2] ? 1 : 2) = 1;
  const Vector across = cross(cross(grain, least), grain);
  return (1 / norm(across)) * across;
}

}  // namespace

Rule anisotropy_section(BeamParameters& beams) {
  return table([&beams](const Section& section) {
    Anisotropy grain;
    section.read(
        {must_have("grain", direction(grain.axes.longitudinal)),
         may_have("radial", direction(grain.axes.radial)),
         must_have("tangential_modulus",
                   quantity(grain.tangential_modulus, dimension::modulus, positive)),
         may_have("radial_modulus", quantity(grain.radial_modulus, dimension::modulus, positive)),
         may_have("transverse_shear_modulus",
                  quantity(grain.transverse_shear_modulus, dimension::modulus, positive)),
         may_have("exponent", number(grain.exponent, positive))});
    if (section.has("radial") != section.has("radial_modulus"))
      section.refuse(section.has("radial") ? "radial" : "radial_modulus",
                     "one of radial and radial_modulus without the other",
                     "both, or neither: all directions across the grain are alike");
    if (!section.has("radial")) {
      grain.axes.radial = any_radial(grain.axes.longitudinal);
      grain.radial_modulus = grain.tangential_modulus;
    } else if (!square_up(grain.axes)) {
      section.refuse("radial", "not perpendicular to the grain",
                     "a direction at right angles to grain");
    }
    if (section.has("transverse_shear_modulus") && beams.law == BeamParameters::Law::spring)
      section.refuse("transverse_shear_modulus", "a spring has no shear modulus",
                     "no such key beside law = \"spring\"");
    beams.anisotropy = grain;
  });
}

Rule fibres_section(BeamParameters& beams) {
  return table([&beams](const Section& section) {
    Fibres fibres;
    section.read({may_have("direction", direction(fibres.rule.direction)),
                  may_have("reach", number(fibres.rule.reach, Range{1, 10, false, true})),
                  may_have("alignment", number(fibres.rule.alignment, Range{0, 1, true, false})),
                  may_have("stiffness_ratio", number(fibres.stiffness_ratio, positive))});
    if (!section.has("direction")) {
      if (!beams.anisotropy)
        section.refuse("direction", "nothing says along what",
                       "direction = [x, y, z], or a section [beams.anisotropy] with its grain");
      fibres.rule.direction = beams.anisotropy->axes.longitudinal;
    }
    beams.fibres = fibres;
  });
}

}  // namespace solidem
