// SPDX-License-Identifier: GPL-2.0-or-later
//
// Parts that are taken out of a body: notches, holes. An element goes when its centre lies in one;
// the volume that the body keeps is computed from the shapes, not from the elements.
#ifndef SOLIDEM_SPECIMEN_CUT_HPP
#define SOLIDEM_SPECIMEN_CUT_HPP

#include <memory>
#include <vector>

#include "model/outline.hpp"

namespace solidem {

/// Takes the elements with their centres in the cuts out of a specimen of one body that has a
/// shape, and their volume out of the body's; both stand in the specimen's outline. `surface`: of a
/// body that is a mesh, else null. Sets follow, bonds are dropped. Throws InputError when a cut
/// takes away no volume or no element, or leaves none; when one is narrower than an element, so
/// that bonds would join what it parts; when cuts reach through a periodic side; when the body's
/// shape is not known.
void cut_out(Specimen& specimen, const std::vector<Cut>& cuts,
             std::shared_ptr<const FacetTree> surface = {});

/// The volume that cuts leave of a body, m³. Exact to round-off where no two round surfaces (of
/// cuts, of the body) meet; where they do, one of them counts as facets there, and the volume is
/// within 1e-7 of the body's.
double volume_left(const Domain& body, const std::vector<Cut>& cuts,
                   const FacetTree* surface = nullptr);

}  // namespace solidem

#endif
