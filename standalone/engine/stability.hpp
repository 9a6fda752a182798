// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_STABILITY_HPP
#define SOLIDEM_ENGINE_STABILITY_HPP

#include "effects/beams.hpp"

namespace solidem {

/// The largest stable time step of beams at rest, 2/ω_max, s. ω_max by power iteration on the
/// accelerations that the beam kernel itself gives for small displacements; the state is left as it
/// was. The iteration comes from above: the result is at most about 2 % too long.
double stable_time_step(Beams& beams, Model& model);

}  // namespace solidem

#endif
