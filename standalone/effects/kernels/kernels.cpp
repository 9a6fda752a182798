// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set, with SOLIDEM_INSTRUCTION_SET naming it.
#include "effects/kernels/kernels.hpp"

#include "effects/kernels/beam_motion.hpp"
#include "effects/kernels/central_motion.hpp"
#include "effects/kernels/heat_flow.hpp"
#include "effects/kernels/loose_kernels.hpp"
#include "effects/kernels/near.hpp"

#define SOLIDEM_TEXT_(x) #x
#define SOLIDEM_TEXT(x) SOLIDEM_TEXT_(x)

namespace solidem::SOLIDEM_INSTRUCTION_SET {

extern const Kernels kernels;
const Kernels kernels{
    SOLIDEM_TEXT(SOLIDEM_INSTRUCTION_SET),
    move_beams_by_kind,
    find_beam_efforts,
    move_by_central_forces,
    find_crack_faces,
    find_central_efforts,
    move_freely,
    damp,
    damp_bonds,
    push,
    lay_out_motion,
    pick_contacts,
    find_contact_loads,
    sum_contact_loads,
    pick_near,
    conduct,
    conducted_power_by_kind,
    {find_soft_forces, add_up_soft_spheres, move_soft_spheres, pick_soft_spheres}};

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
