// SPDX-License-Identifier: GPL-2.0-or-later
//
// The hot loops of soft spheres, compiled once for each instruction set and chosen at run time. All
// of them give the same bits: each sphere adds up its neighbours in their order, nothing is fused.
#ifndef SOLIDEM_SPECIMEN_SOFT_SPHERE_KERNELS_HPP
#define SOLIDEM_SPECIMEN_SOFT_SPHERE_KERNELS_HPP

#include <cstddef>
#include <cstdint>

#include "model/specimen.hpp"

namespace solidem {

/// Spheres in blocks of eight, one in each lane. The last block is filled up with spheres of no
/// radius that are far away, and so are lists of neighbours: these add zeros.
struct SoftSphereColumns {
  const std::uint32_t* first_row;  ///< of the neighbours of each block; one more at the end
  const std::int32_t* neighbour;   ///< rows of eight: the k-th neighbour of each sphere
  double* ball;                    ///< of each sphere a row: x y z R
  const double* listed;            ///< likewise: x y z where the lists were made, nothing
  double *velocity, *force;        ///< of each block: eight of x, eight of y, eight of z
  double *contact_force,
      *contacts;  ///< of each sphere: the sum of eight times the depths, how many
  Vector period;  ///< lengths of the body where it is periodic, else infinity
  bool is_periodic;
};

/// Sums over spheres.
struct SoftSphereSums {
  double power = 0, force2 = 0, velocity2 = 0;
  double contact_force = 0, contacts = 0;
};

/// Spheres in the order of cells, with room for eight more behind each column.
struct SortedSpheres {
  const double *x, *y, *z, *reach;
};

/// Spheres that follow each other, or their images.
struct SphereRange {
  std::size_t first, last;
  Vector shift;  ///< of the images
};

/// Each but the last treats the blocks [first, last).
struct SoftSphereKernels {
  /// The forces of neighbours.
  void (*find_forces)(const SoftSphereColumns&, std::size_t first, std::size_t last);
  /// Adds the spheres to sums, one after the other.
  void (*add_up)(const SoftSphereColumns&, std::size_t first, std::size_t last, SoftSphereSums&);
  /// v ← keep v + push F, then a step; returns the largest squared distance from where the lists
  /// were made.
  double (*move)(const SoftSphereColumns&, std::size_t first, std::size_t last, double time_step,
                 double keep, double push);
  /// Writes the places of spheres in some ranges whose centres are nearer than the sum of both
  /// reaches, in their order; returns how many. `near` has room for all and eight more.
  std::size_t (*pick)(const SortedSpheres&, const SphereRange* ranges, std::size_t count,
                      const Vector& centre, double reach, std::uint32_t* near);
};

/// Those of this machine's best instruction set; they stand with all others, in effects/kernels.
const SoftSphereKernels& soft_sphere_kernels();

}  // namespace solidem

#endif
