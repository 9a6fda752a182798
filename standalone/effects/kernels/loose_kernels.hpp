// SPDX-License-Identifier: GPL-2.0-or-later
//
// Kernels of what observers see of bonds and of central forces, of damping, of elements that touch
// or that nothing joins, and of spheres that are packed, each in a source of its own: said in
// kernels.hpp and specimen/soft_sphere_kernels.hpp.
#ifndef SOLIDEM_EFFECTS_KERNELS_LOOSE_KERNELS_HPP
#define SOLIDEM_EFFECTS_KERNELS_LOOSE_KERNELS_HPP

#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

void find_beam_efforts(const BeamMotion& motion, const BeamEfforts& efforts, std::size_t first,
                       std::size_t last);
void find_central_efforts(const CentralMotion& motion, const CentralEfforts& efforts,
                          std::size_t first, std::size_t last);
void move_freely(const FreeMotionColumns& columns, std::size_t first, std::size_t last);
void damp(const DampedElements& elements, std::size_t first, std::size_t last);
void damp_bonds(const BeamMotion& motion, const DampedBonds& bonds, std::size_t first,
                std::size_t last);
void push(const PushedElements& pushed);
void lay_out_motion(const MotionRows& motion, const std::int32_t* element, std::size_t count);
void pick_contacts(const ContactColumns& columns, std::size_t first, std::size_t last);
void find_contact_loads(const ContactColumns& columns, std::size_t first, std::size_t last);
std::size_t sum_contact_loads(const ContactSides& sides, std::size_t first, std::size_t last,
                              std::int32_t* element, double* sums);
void find_soft_forces(const SoftSphereColumns& spheres, std::size_t first, std::size_t last);
void add_up_soft_spheres(const SoftSphereColumns& spheres, std::size_t first, std::size_t last,
                         SoftSphereSums& sums);
double move_soft_spheres(const SoftSphereColumns& spheres, std::size_t first, std::size_t last,
                         double time_step, double keep, double push);
std::size_t pick_soft_spheres(const SortedSpheres& spheres, const SphereRange* ranges,
                              std::size_t count, const Vector& centre, double reach,
                              std::uint32_t* near);

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
