// SPDX-License-Identifier: GPL-2.0-or-later
//
// [calibration] with targets along the axes of a grain.
#include "effects/beam_parameters.hpp"
#include "keys/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

const char* const groups[] = {"young_moduli", "shear_moduli", "poisson_ratios"};

/// Targets of one kind by the names of their axes; `first` is the place of the first of them.
Rule moduli(OrthotropicRequest& request, std::size_t first, const std::vector<std::string>& axes) {
  return table([&request, first, axes](const Section& section) {
    std::vector<Key> keys;
    for (std::size_t k = 0; k < axes.size(); ++k)
      keys.push_back(
          may_have(axes[k], quantity(request.target[first + k], dimension::modulus, positive)));
    section.read(keys);
  });
}

Rule poisson_ratios(OrthotropicRequest& request) {
  return table([&request](const Section& section) {
    section.read({may_have("LR", number(request.target[6], positive)),
                  may_have("LT", number(request.target[7], positive)),
                  may_have("RT", number(request.target[8], positive))});
  });
}

Rule weights(OrthotropicRequest& request) {
  return table([&request](const Section& section) {
    std::vector<Key> keys;
    for (std::size_t k = 0; k < 3; ++k)
      keys.push_back(may_have(groups[k], number(request.weight[k], positive)));
    section.read(keys);
  });
}

}  // namespace

bool asks_for_orthotropic_calibration(const Section& section) {
  for (const char* group : groups)
    if (section.has(group)) return true;
  return false;
}

OrthotropicRequest read_orthotropic_calibration(const Section& section,
                                                const std::optional<BeamParameters>& beams) {
  OrthotropicRequest request;
  section.read(
      {may_have("young_moduli", moduli(request, 0, {"L", "R", "T"})),
       may_have("shear_moduli", moduli(request, 3, {"LR", "LT", "RT"})),
       may_have("poisson_ratios", poisson_ratios(request)), may_have("weights", weights(request)),
       may_have("tolerance", number(request.tolerance, positive)),
       may_have("specimens", integer(request.specimens, 1, 1000)),
       may_have("iterations", integer(request.iterations, 1, 1000))},
      "a calibration along the axes of a grain");
  if (beams && !beams->anisotropy)
    section.refuse("the beams have no grain", "a section [beams.anisotropy]");
  return request;
}

}  // namespace solidem
