// SPDX-License-Identifier: GPL-2.0-or-later
//
// Stress and deformation of single elements: averages over an element and its neighbours that stand
// for a continuum's tensors.
#ifndef SOLIDEM_ENGINE_ELEMENT_TENSORS_HPP
#define SOLIDEM_ENGINE_ELEMENT_TENSORS_HPP

#include <Eigen/Core>
#include <vector>

#include "effects/acting_effects.hpp"

namespace solidem {

/// One tensor for each element; rows and columns are x, y, z.
using ElementTensors = std::vector<Eigen::Matrix3d>;

/// Virial stress (laws/virial_stress.hpp), Pa, tension positive: of bonds or central forces,
/// contacts and tools, with chords and levers as they are now, over the volume at rest that the
/// element represents (a Kirchhoff stress). The mean over a body at rest, by volume, is the body's
/// own. Grips and loads act at centres and add nothing.
ElementTensors element_stress(const Model& model,
                              const std::vector<const ActsBetweenElements*>& actors,
                              const std::vector<const TouchesElements*>& tools);

/// Deformation gradient F by least squares (Falk and Langer 1998, 10.1103/PhysRevE.57.7192): that
/// which takes the chords at rest, from an element to its present neighbours and to theirs, closest
/// to what they are now. Neighbours alone would tell a seventh less than a packing is strained, as
/// chords along which it is stiff stretch less than others. Across what the chords do not span F
/// leaves lengths as they were. Contacts make nobody a neighbour.
ElementTensors deformation_gradient(const Model& model,
                                    const std::vector<const ActsBetweenElements*>& actors);

/// Temperature gradient of each element by least squares over those that it exchanges heat with,
/// K/m, at rest; 0 in directions that these do not span.
std::vector<Vector> temperature_gradient(const Model& model);

}  // namespace solidem

#endif
