// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEATED_FACES_HPP
#define SOLIDEM_EFFECTS_HEATED_FACES_HPP

#include <memory>
#include <vector>

#include "specimen/tessellation.hpp"

namespace solidem {

/// Faces through which heat comes and goes: of a wall, or of the exposed surface, which cracks may
/// enlarge.
struct HeatedFaces {
  std::shared_ptr<const std::vector<WallFace>> now;
  std::vector<WallFace> largest;  ///< that they can become
  bool stay;                      ///< they never change
};

}  // namespace solidem

#endif
