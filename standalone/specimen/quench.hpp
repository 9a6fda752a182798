// SPDX-License-Identifier: GPL-2.0-or-later
//
// Soft spheres pushed apart to rest. Two spheres whose centres are d apart, nearer than s = R_i +
// R_j, repel each other with the force (s² − d²) d/8: for radii near 1 and small overlaps that is
// the overlap, and it needs no root and no division. Walls repel by the overlap. The energy is
// minimised with FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) for unit masses. Neighbour
// lists come from linked cells. Sums over all elements run over fixed blocks in fixed order, so the
// result is the same on any number of threads.
#ifndef SOLIDEM_SPECIMEN_QUENCH_HPP
#define SOLIDEM_SPECIMEN_QUENCH_HPP

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "model/buffer.hpp"
#include "model/facet_tree.hpp"
#include "model/specimen.hpp"
#include "specimen/soft_sphere_kernels.hpp"

namespace solidem {

/// Spheres in a body with walls. Lengths in a unit that makes the mean radius about 1.
class SoftSpheres {
 public:
  /// `surface`: the walls of a body that is a mesh, else null; it must outlive the spheres.
  SoftSpheres(const Domain& domain, std::vector<Vector> position, std::vector<double> radius,
              const FacetTree* surface = nullptr);

  /// Multiplies all radii.
  void inflate(double factor);

  /// Moves the spheres until no force is larger than `precision` times the mean contact force (or
  /// the packing is loose), or `most_steps` are done. Returns the number of steps. `progress`, if
  /// given, is told now and then the fraction of the way to that precision on a logarithmic scale.
  int relax(double precision, int most_steps, const std::function<void(double)>& progress = {});

  /// Pulls apart pairs that coincide, nearly: their force vanishes with their distance, and what is
  /// around holds the two as if they were one. Returns how many there were.
  int separate_coinciding();

  /// Contacts between spheres: twice their number per sphere, and the mean overlap in mean
  /// diameters.
  double coordination_number() const;
  double mean_overlap() const;

  /// Centres, in periodic directions the image inside the body.
  std::vector<Vector> position() const;
  std::vector<double> radius() const;
  std::size_t size() const { return size_; }

 private:
  void build_lists();
  void find_near_walls();
  bool may_reach_walls(const Vector& centre, double reach) const;
  Vector image_inside(Vector point) const;
  Vector nearest_image(Vector d) const;
  void add_walls(std::size_t chunk_number);
  void wall_force(const Vector& centre, double radius, Vector& force) const;
  void compute_forces();
  double move(double time_step, double keep, double steer);
  SoftSphereColumns columns();

  Vector centre(std::size_t i) const { return {ball_[4 * i], ball_[4 * i + 1], ball_[4 * i + 2]}; }
  double radius(std::size_t i) const { return ball_[4 * i + 3]; }
  void place(std::size_t i, const Vector& centre);

  Domain domain_;
  const FacetTree* surface_;
  std::size_t size_;
  Vector extent_{};
  Vector axis_point_{}, first_normal_{}, last_normal_{};  // of round bodies; of a wedge, outward
  Buffer<double> ball_, velocity_, force_, listed_, contact_force_, contacts_;
  std::vector<std::uint32_t> first_row_;
  std::vector<std::int32_t> neighbour_;      // both sides of each listed pair
  std::vector<std::uint32_t> near_walls_;    // may reach one before the lists are made anew
  std::vector<std::size_t> first_of_chunk_;  // of those, in each chunk of blocks
  double mean_diameter_ = 2;
  double skin_ = 0.4;  // of the lists
  SoftSphereSums sums_;
};

}  // namespace solidem

#endif
