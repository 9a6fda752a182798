// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of each effect: plain data, in SI units, filled by the scene reader and read
// by the effects.
#ifndef SOLIDEM_EFFECTS_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_PARAMETERS_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "effects/beam_materials.hpp"
#include "laws/bond_limit.hpp"
#include "laws/central_laws.hpp"
#include "laws/oriented_modulus.hpp"
#include "model/region.hpp"
#include "model/shape.hpp"
#include "model/time_function.hpp"
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
  /// Of the law; places and velocities are double always.
  enum class Precision { whole, mixed };
  Law law = Law::euler_bernoulli;
  Precision precision = Precision::whole;
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

/// Central forces between elements.
struct CentralForceParameters {
  enum class Equilibrium {
    initial,  ///< neighbours at the start keep the distance they had
    radii     ///< R_i + R_j
  };
  enum class Neighbours {
    changing,  ///< whoever is within range
    fixed      ///< those of the start, while within range
  };
  CentralLaw law;
  double range = 0;  ///< α: elements nearer than α (R_i + R_j) act on each other
  Equilibrium equilibrium = Equilibrium::initial;
  Neighbours neighbours = Neighbours::changing;
  double interpenetration = 0.1;      ///< a: deepest overlap, of the equilibrium distance, that the
                                      ///< time step allows for
  std::optional<double> dissipation;  ///< c, N·s/m
  std::optional<double> skin;         ///< of the lists of neighbours, mean radii; none: chosen as
                                      ///< elements move
  double bond_tolerance = 0;  ///< t: neighbours at the start are nearer than (1 + t)(R_i + R_j)
};

/// Micro-cracks between elements, and elements that have lost their hold.
struct DamageParameters {
  std::optional<double> crack_threshold;  ///< C
  std::int64_t every = 1;                 ///< steps between two looks for crack faces
  int minimal_neighbours = 0;             ///< elements that keep fewer within range are removed
  std::int64_t removal_every = 100;       ///< steps between two such looks
  bool leaves_out_free_faces = false;     ///< faces of the start are none of cracks
  std::optional<double> range{};          ///< α, of beams; none: 1.2
};

/// Two materials that touch imperfectly.
struct Contact {
  std::string first, second;  ///< names of the materials
  double conductance = 0;     ///< h_c, W/(m² K)
};

/// Heat conduction between neighbouring elements.
struct ConductionParameters {
  enum class Law {
    platonic,             ///< contacts; areas and volumes of platonic solids
    platonic_calibrated,  ///< the same, scaled to the conductivity and mass of the body
    voronoi               ///< faces and volumes of radical Voronoi cells
  };
  enum class Integrator { explicit_euler, rkl2, implicit, automatic };
  enum class BrokenBonds {
    insulate,  ///< a pair whose bond broke conducts no heat any more
    conduct    ///< it goes on as before
  };
  Law law = Law::platonic;
  double initial_temperature = 0;     ///< K
  std::optional<double> area_factor;  ///< of platonic_calibrated; none: found by a steady bar test
  Integrator integrator = Integrator::explicit_euler;
  std::optional<double> tolerance;  ///< error allowed in time integration, K; none: fixed steps
  std::vector<Contact> contacts{};
  std::optional<BrokenBonds> broken_bonds;  ///< with rupture only; none: insulate
  std::int64_t every = 1;                   ///< steps of the motion from one heat step to the next
  std::optional<double> largest_change;     ///< of a temperature between two heat steps, K: their
                                            ///< number is chosen
};

/// As a scene spells them.
const char* name_of(BeamParameters::Law law);
const char* name_of(PlasticityParameters::Law law);
const char* name_of(JudgedSection section);
const char* name_of(CentralForceParameters::Equilibrium equilibrium);
const char* name_of(CentralForceParameters::Neighbours neighbours);
const char* name_of(ConductionParameters::Law law);
const char* name_of(ConductionParameters::Integrator integrator);

/// What a grip imposes on its elements along one axis.
struct AxisControl {
  enum class Kind { free, displacement, velocity, force };
  Kind kind = Kind::free;
  TimeFunction function;  ///< m, m/s, or N for the whole grip (shared by mass)
};

/// Elements held, moved or loaded together.
struct GripParameters {
  std::string name;
  Region region;
  std::array<AxisControl, 3> axis;
  bool rotation_fixed = true;
};

/// A temperature imposed on elements, or on a wall of the body.
struct ImposedTemperatureParameters {
  std::string name;
  Region region;
  TimeFunction temperature;  ///< K
  std::string wall{};        ///< if given, of this wall, and not of the elements of a region
};

/// Heat that flows into the body through a wall, or through a part of it that may move.
struct HeatFluxParameters {
  std::string name;
  std::string wall;
  TimeFunction flux;                       ///< W/m², or W in all
  bool is_power = false;                   ///< `flux` is in W
  std::optional<Shape> shape{};            ///< around its origin: the part of the wall inside
  std::optional<double> spot_radius{};     ///< of a Gaussian spot: where it has fallen to 1/e², m
  std::array<TimeFunction, 3> position{};  ///< of the shape's origin or the spot's centre, m
};

/// Heat exchanged with a fluid along a wall.
struct ConvectionParameters {
  std::string name;
  std::string wall;
  TimeFunction coefficient;  ///< h, W/(m² K)
  TimeFunction temperature;  ///< of the fluid, K
};

/// Heat that arises inside the body, in a region at rest or in a shape that may move.
struct HeatSourceParameters {
  std::string name;
  std::optional<Region> region;
  std::optional<Shape> shape;            ///< around the origin
  std::array<TimeFunction, 3> position;  ///< of the shape's origin, m
  bool is_density = true;                ///< `power` is in W/m³, else W in all
  TimeFunction power;
};

/// Elements that start with a velocity.
struct InitialVelocity {
  Region region;
  Vector velocity;      ///< m/s
  Vector stretching{};  ///< 1/s: besides, along x, y, z as far as from the middle of the body
};

}  // namespace solidem

#endif
