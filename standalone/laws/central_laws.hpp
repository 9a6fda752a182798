// SPDX-License-Identifier: GPL-2.0-or-later
//
// The table of central laws: a new law is a header like these and a line here. Scene sections,
// kernels, pair styles and plots are made from it.
#ifndef SOLIDEM_LAWS_CENTRAL_LAWS_HPP
#define SOLIDEM_LAWS_CENTRAL_LAWS_HPP

#include "laws/law_table.hpp"
#include "laws/lennard_jones.hpp"
#include "laws/mie.hpp"
#include "laws/piecewise.hpp"
#include "laws/shifted_lennard_jones.hpp"
#include "laws/threshold.hpp"

namespace solidem {

using CentralLaws = LawTable<Piecewise,            //
                             LennardJones,         //
                             ShiftedLennardJones,  //
                             Mie,                  //
                             Threshold>;

/// Any of them, with its parameters.
using CentralLaw = CentralLaws::Any;

}  // namespace solidem

#endif
