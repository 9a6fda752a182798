// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonded bodies at rest under imposed displacements, turns and loads.
#ifndef SOLIDEM_SOLVE_STATICS_STATIC_EQUILIBRIUM_HPP
#define SOLIDEM_SOLVE_STATICS_STATIC_EQUILIBRIUM_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/setup.hpp"
#include "laws/beam.hpp"
#include "laws/virial_stress.hpp"
#include "model/specimen.hpp"
#include "solve/statics/linear_method.hpp"

namespace solidem {

/// A bonded body at rest: what equilibrium needs of it. Rest lengths and directions are those of
/// the specimen's rest chords. Elements without a bond are left out: they stay where they are.
struct BeamNetwork {
  const Specimen* specimen;                    ///< must outlive the network
  std::vector<Pair> bonds;                     ///< in the order of the specimen
  std::vector<BeamRigidity<double>> rigidity;  ///< of each bond: stiffness × rest length
  /// By how much each bond is longer free of load, over its rest length; empty: not at all. Counts
  /// in small_equilibrium.
  std::vector<double> thermal_strain{};
};

/// The largest bonded component of a specimen under beams.
BeamNetwork beam_network(const BeamParameters& parameters, const Specimen& specimen);

/// A degree of freedom held at a value.
struct Constraint {
  std::int32_t element;
  int degree;    ///< 0, 1, 2: displacement along x, y, z; 3, 4, 5: turn about x, y, z
  double value;  ///< m, rad
};

/// What acts on an element from outside.
struct ElementLoad {
  std::int32_t element;
  Vector force;   ///< N
  Vector moment;  ///< N·m
};

/// A matrix by rows.
using Matrix3 = std::array<Vector, 3>;

/// A body at rest.
struct Equilibrium {
  std::vector<Vector> displacement;     ///< of each element of the specimen, m
  std::vector<Vector> rotation;         ///< rotation vector of each element, rad
  std::vector<Vector> reaction;         ///< force of the constraints on each element, N
  std::vector<Vector> reaction_moment;  ///< N·m
  std::vector<Vector> bond_force;       ///< on element i of each bond of the network, N
  std::vector<double> bond_strain;      ///< equivalent strain of each bond, see beam_plasticity.hpp
  Matrix3 periodic_gradient{};          ///< of a periodic body, as asked for
  int iterations = 0;                   ///< of conjugate gradients; 1: factorised
  double residual =
      0;              ///< force out of balance, as a fraction of the bonds' forces on the elements
  double energy = 0;  ///< elastic, J
  /// Of finite_equilibrium: steps of the load, corrections by Newton's method, and whether the
  /// equilibrium is known to be unstable.
  int load_steps = 1, corrections = 1;
  bool unstable = false;
};

struct EquilibriumOptions {
  double tolerance = 1e-10;  ///< of `residual`
  LinearMethod method = LinearMethod::automatic;
  /// Of a periodic body: displacement of an image against its element, over their distance. A
  /// strain, if it is symmetric.
  Matrix3 periodic_gradient{};
  const Equilibrium* guess = nullptr;  ///< a state nearby: saves iterations
};

/// Small motion from rest: loads are linear in displacements and turns. Throws InputError when the
/// body is not held (naming the rigid motion that is free) or a load acts along a direction that
/// nothing resists; RunError when no equilibrium was found.
Equilibrium small_equilibrium(const BeamNetwork& network,
                              const std::vector<Constraint>& constraints,
                              const std::vector<ElementLoad>& loads,
                              const EquilibriumOptions& options = {});

/// Engineering stress and strains of a section between two planes, as engine/gauge.hpp has them.
struct GaugeMeasure {
  double stress;             ///< Pa
  double strain;             ///< along the axis
  double lateral_strain[2];  ///< along the next axis (x → y → z → x) and the one after
};
GaugeMeasure measure_gauge(const BeamNetwork& network, const Equilibrium& equilibrium,
                           const Gauge& gauge);

/// Stress of each element, Pa: half of Σ bond force ⊗ rest chord of its bonds, over the volume that
/// it stands for (m³), the mean of both shear stresses (laws/virial_stress.hpp), as frames of
/// a run have it (engine/element_tensors.hpp), for small displacements.
std::vector<SymmetricTensor<double>> element_stress(const BeamNetwork& network,
                                                    const Equilibrium& equilibrium,
                                                    const std::vector<double>& volume);

/// Mean stress of the body, Pa: Σ bond force ⊗ rest chord / volume. Row: axis of the force.
Matrix3 mean_stress(const BeamNetwork& network, const Equilibrium& equilibrium);

}  // namespace solidem

#endif
