// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of beam bonds, their flow, rupture and contact: plain data in SI units,
// filled by the scene reader and read by the effects.
#ifndef SOLIDEM_EFFECTS_BEAM_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_BEAM_PARAMETERS_HPP

#include <optional>
#include <string>
#include <vector>

#include "effects/beam_materials.hpp"
#include "laws/bond_limit.hpp"
#include "laws/oriented_modulus.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

/// Moduli of beams that depend on their direction against a grain: laws/oriented_modulus.hpp.
struct Anisotropy {
  GrainAxes<double> axes{{1, 0, 0}, {0, 1, 0}};  ///< L and R
  double radial_modulus = 0;                     ///< E_R of the beams, Pa; E_L is young_modulus
  double tangential_modulus = 0;                 ///< E_T of the beams, Pa
  /// G of beams across the grain, Pa; none: all beams have the ratio G/E of those along it.
  std::optional<double> transverse_shear_modulus;
  double exponent = 4;  ///< p
};

/// Bonds beyond contact along a direction, stiffer than the others.
struct Fibres {
  FibreRule rule;
  double stiffness_ratio = 10;  ///< of their moduli to young_modulus and shear_modulus
};

/// Beam bonds and their elasticity.
struct BeamParameters {
  enum class Law {
    euler_bernoulli,
    timoshenko,  ///< shears as well
    spring       ///< resists a change of length and nothing else
  };
  /// What the radius of a beam is a multiple of.
  enum class RadiusFrom {
    mean,  ///< the mean radius R_m of the specimen
    pair   ///< (R_i + R_j) / 2 of the two elements
  };
  Law law = Law::euler_bernoulli;
  double young_modulus = 0;        ///< E of the beams (microscopic), Pa
  double shear_modulus = 0;        ///< G of the beams (microscopic), Pa; 0 for springs
  double shear_coefficient = 0.9;  ///< κ of Timoshenko beams
  double radius_ratio = 0;         ///< r̃
  RadiusFrom radius_from = RadiusFrom::mean;
  std::optional<Anisotropy> anisotropy;
  std::optional<Fibres> fibres;
  std::optional<double> poisson_ratio{};    ///< where it is given in place of the shear modulus
  std::vector<BeamMaterial> materials{};    ///< of regions; elsewhere the figures above hold
  std::vector<BeamInterface> interfaces{};  ///< that are not in series
};

/// Plastic flow of beam bonds.
struct PlasticityParameters {
  using Law = FlowRule;
  Law law = Law::radial_return;
  YieldLaw hardening;
  JudgedSection section = JudgedSection::middle;
  std::optional<double> rate_time{};  ///< over which rates of flow are averaged, s
};

/// Rupture of beam bonds.
struct RuptureParameters {
  RuptureLaw law;
  int minimal_bonds = 0;  ///< elements that lost bonds and keep fewer are removed
  JudgedSection section = JudgedSection::middle;
};

/// Names of laws of bonds, as a scene spells them.
std::string name_of(const YieldLaw& law);
std::string name_of(const RuptureLaw& law);

/// Contact of elements that have lost bonds.
struct ContactParameters {
  double stiffness_ratio = 1;  ///< of E S / l
  std::optional<double>
      rebonding_pressure;  ///< contact force over beam section that bonds anew, Pa
};

/// As a scene spells them.
const char* name_of(BeamParameters::Law law);
const char* name_of(PlasticityParameters::Law law);
const char* name_of(JudgedSection section);

}  // namespace solidem

#endif
