// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/selections.hpp"

#include <cstdio>

#include "model/error.hpp"
#include "model/region.hpp"

namespace solidem {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

std::string place(const Specimen& specimen, std::size_t i) {
  const Vector& p = specimen.position[i];
  return "element " + std::to_string(i) + " at (" + text(p.x) + ", " + text(p.y) + ", " +
         text(p.z) + ") m";
}

std::string bounds(const Specimen& specimen) {
  const Vector &low = specimen.domain.lower, &high = specimen.domain.upper;
  return "(" + text(low.x) + ", " + text(low.y) + ", " + text(low.z) + ") and (" + text(high.x) +
         ", " + text(high.y) + ", " + text(high.z) + ") m";
}

std::vector<std::int32_t> select_for(const std::string& owner, const Region& region,
                                     const Specimen& specimen) {
  try {
    return select(region, specimen);
  } catch (const InputError& error) {
    throw InputError(owner + " region: " + error.what());
  }
}

std::vector<std::int32_t> select_some(const std::string& owner, const Region& region,
                                      const Specimen& specimen) {
  std::vector<std::int32_t> elements = select_for(owner, region, specimen);
  if (elements.empty())
    throw InputError(owner + " region: holds no element; the specimen's centres lie between " +
                     bounds(specimen));
  return elements;
}

void claim(std::map<std::int32_t, std::string>& holders, const std::vector<std::int32_t>& elements,
           const std::string& section, const std::string& name, const Specimen& specimen) {
  const auto refuse = [&](std::int32_t element, const std::string& holder) {
    throw InputError(section + " \"" + name + "\" and \"" + holder + "\" share elements, " +
                     place(specimen, static_cast<std::size_t>(element)) +
                     " for one; their regions must not overlap");
  };
  for (const std::int32_t element : elements) {
    const auto [holder, alone] = holders.emplace(element, name);
    if (!alone) refuse(element, holder->second);
  }
}

std::vector<std::size_t> assign_materials(const std::vector<Material>& materials,
                                          const Specimen& specimen) {
  if (materials.size() == 1 && materials[0].region.kind == Region::Kind::all) return {};
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> material(specimen.size(), none);
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const std::string owner = "[[material]] " + std::to_string(m + 1);
    for (const std::int32_t e : select_for(owner, materials[m].region, specimen)) {
      const auto i = static_cast<std::size_t>(e);
      if (material[i] != none)
        throw InputError(owner + " region: " + place(specimen, i) + " lies in that of material " +
                         std::to_string(material[i] + 1) + ", too; each element must lie in one");
      material[i] = m;
    }
  }
  for (std::size_t i = 0; i < specimen.size(); ++i)
    if (material[i] == none)
      throw InputError("[[material]] region: " + place(specimen, i) +
                       " lies in the region of no material; each element must lie in one");
  return material;
}

}  // namespace solidem
