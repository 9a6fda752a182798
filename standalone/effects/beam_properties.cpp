// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beam_properties.hpp"

#include "effects/beam_parameters.hpp"

namespace solidem {

using Law = BeamParameters::Law;
using RadiusFrom = BeamParameters::RadiusFrom;

bool beams_are_alike(const BeamParameters& parameters) {
  return parameters.radius_from == RadiusFrom::mean && parameters.law != Law::timoshenko &&
         !parameters.anisotropy && !parameters.fibres && parameters.materials.empty();
}

namespace {

/// The two moduli of a beam along a direction.
void orient(const Anisotropy& grain, const Vector& direction, BeamSection<double>& section) {
  const double young = modulus_along(
      {section.young_modulus, grain.radial_modulus, grain.tangential_modulus, grain.exponent},
      grain.axes, direction);
  if (grain.transverse_shear_modulus) {
    const double across = *grain.transverse_shear_modulus;
    section.shear_modulus = modulus_along({section.shear_modulus, across, across, grain.exponent},
                                          grain.axes, direction);
  } else {
    section.shear_modulus *= young / section.young_modulus;
  }
  section.young_modulus = young;
}

}  // namespace

namespace {

BeamElasticity rest_of(const BeamParameters& p) {
  return {p.young_modulus, p.shear_modulus, p.radius_ratio};
}

BeamMaterialTable table_of(const BeamParameters& p, const Specimen& specimen,
                           const YieldLaw* yield) {
  if (p.materials.empty()) return {};
  return {p.materials, pairings(p, yield), specimen};
}

}  // namespace

std::vector<BeamPairing> pairings(const BeamParameters& parameters, const YieldLaw* yield) {
  return pairings(rest_of(parameters), parameters.materials, parameters.interfaces, yield);
}

BeamProperties::BeamProperties(const BeamParameters& parameters, const Specimen& specimen,
                               const YieldLaw* yield)
    : parameters_(parameters),
      materials_(table_of(parameters, specimen, yield)),
      mean_radius_(mean_radius(specimen)),
      bond_tolerance_(specimen.bond_tolerance),
      contact_margin_(specimen.contact_margin) {}

BeamSection<double> BeamProperties::section(const BeamElasticity& made_of, double radius_i,
                                            double radius_j, const Vector& chord) const {
  const double radius =
      parameters_.radius_from == RadiusFrom::mean ? mean_radius_ : 0.5 * (radius_i + radius_j);
  BeamSection<double> section{made_of.young_modulus, made_of.shear_modulus,
                              made_of.radius_ratio * radius};
  if (parameters_.fibres &&
      is_fibre(radius_i, radius_j, norm(chord), bond_tolerance_, contact_margin_)) {
    section.young_modulus *= parameters_.fibres->stiffness_ratio;
    section.shear_modulus *= parameters_.fibres->stiffness_ratio;
  } else if (parameters_.anisotropy) {
    orient(*parameters_.anisotropy, (1 / norm(chord)) * chord, section);
  }
  return section;
}

BeamSection<double> BeamProperties::section(const Specimen& specimen, Pair pair,
                                            const Vector& chord) const {
  return section(parameters_.materials.empty() ? rest_of(parameters_)
                                               : materials_.between(pair.i, pair.j).elasticity,
                 specimen.radius[static_cast<std::size_t>(pair.i)],
                 specimen.radius[static_cast<std::size_t>(pair.j)], chord);
}

BeamSection<double> BeamProperties::section(double radius_i, double radius_j,
                                            const Vector& chord) const {
  return section(rest_of(parameters_), radius_i, radius_j, chord);
}

BeamSection<double> BeamProperties::common_section() const {
  return section(mean_radius_, mean_radius_, {1, 0, 0});
}

BeamRigidity<double> BeamProperties::rigidity(const BeamSection<double>& section,
                                              double rest_length) const {
  switch (parameters_.law) {
    case Law::timoshenko:
      return timoshenko_rigidity(section, rest_length, parameters_.shear_coefficient);
    case Law::spring:
      return spring_rigidity(section);
    case Law::euler_bernoulli:
      break;
  }
  return euler_bernoulli_rigidity(section);
}

}  // namespace solidem
