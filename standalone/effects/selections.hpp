// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which elements the regions of a setup mean, and complaints about those that mean nothing.
#ifndef SOLIDEM_EFFECTS_SELECTIONS_HPP
#define SOLIDEM_EFFECTS_SELECTIONS_HPP

#include <map>
#include <string>
#include <vector>

#include "model/material.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// By name: "grip.NAME", "temperature.NAME", "gauge", "sensor.NAME".
using Selections = std::map<std::string, std::vector<std::int32_t>>;

/// A number for a message, six digits.
std::string text(double value);

/// "element 12 at (0.1, 0.2, 0.3) m".
std::string place(const Specimen& specimen, std::size_t i);

/// "(0, 0, 0) and (1, 1, 1) m", the bounds of the body.
std::string bounds(const Specimen& specimen);

/// The elements of a region. Throws InputError that begins with its owner, `[[grips]] "left"`, when
/// it names a set or a body that there is not.
std::vector<std::int32_t> select_for(const std::string& owner, const Region& region,
                                     const Specimen& specimen);

/// The same; throws InputError when there are none, too.
std::vector<std::int32_t> select_some(const std::string& owner, const Region& region,
                                      const Specimen& specimen);

/// Notes who holds which element. Throws InputError when another one holds it already.
void claim(std::map<std::int32_t, std::string>& holders, const std::vector<std::int32_t>& elements,
           const std::string& section, const std::string& name, const Specimen& specimen);

/// The material of each element, or nothing where there is but one for all. Throws InputError when
/// an element lies in the region of none, or of several.
std::vector<std::size_t> assign_materials(const std::vector<Material>& materials,
                                          const Specimen& specimen);

}  // namespace solidem

#endif
