// SPDX-License-Identifier: GPL-2.0-or-later
//
// The table of yield laws of bonds: a new law is a header like these and a line here. Keys of
// scenes, kernels and words of the bond style are made from it.
#ifndef SOLIDEM_LAWS_YIELD_LAWS_HPP
#define SOLIDEM_LAWS_YIELD_LAWS_HPP

#include "laws/law_table.hpp"
#include "laws/linear_hardening.hpp"
#include "laws/voce_hardening.hpp"

namespace solidem {

using YieldLaws = LawTable<LinearHardening,  //
                           VoceHardening>;

/// Any of them, with its parameters.
using YieldLaw = YieldLaws::Any;

}  // namespace solidem

#endif
