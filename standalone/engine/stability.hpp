// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_STABILITY_HPP
#define SOLIDEM_ENGINE_STABILITY_HPP

#include "effects/mechanics.hpp"

namespace solidem {

/// The largest stable time step of elements near rest, s, from their largest frequency: 2/ω_max, or
/// what the mechanics make of it. ω_max by Lanczos' iteration on the accelerations that the kernel
/// itself gives for small displacements, until it grows by less than .2 % in four steps; the state
/// is left as it was. It comes from above: the result is at most about 2 % too long.
double stable_time_step(const Mechanics& mechanics, Model& model);

}  // namespace solidem

#endif
