// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_LINEAR_METHOD_HPP
#define SOLIDEM_SOLVE_STATICS_LINEAR_METHOD_HPP

namespace solidem {

/// How linear equations of a bonded body are solved.
enum class LinearMethod {
  automatic,   ///< whichever is foreseen to take less time
  factorised,  ///< LDLᵀ
  iterated     ///< conjugate gradients
};

}  // namespace solidem

#endif
