// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_ASSEMBLY_HPP
#define SOLIDEM_EFFECTS_ASSEMBLY_HPP

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <vector>

#include "effects/conduction_geometry.hpp"
#include "effects/effect.hpp"
#include "effects/selections.hpp"
#include "effects/setup.hpp"

namespace solidem {

/// What effects are made of: the setup, a model that has their columns, and the effects that were
/// made before.
class Assembly {
 public:
  Assembly(const Setup& of_setup, Model& of_model, Selections& into)
      : setup(of_setup), model(of_model), selections(into) {}

  const Setup& setup;
  Model& model;
  Selections& selections;             ///< elements of the regions that were named so far
  std::vector<std::size_t> material;  ///< of each element; empty: all of the first
  std::vector<double> mass;           ///< of each element, kg; empty where nothing moves
  ConductionGeometry geometry;        ///< where something conducts

  const Specimen& specimen() const { return model.specimen(); }

  /// The effect of a type that was made first; null: none was.
  template <class Type>
  Type* find() const {
    for (const auto& effect : made_)
      if (auto* found = dynamic_cast<Type*>(effect)) return found;
    return nullptr;
  }
  /// All effects of a type that were made, in the order of the plan.
  template <class Type>
  std::vector<Type*> all() const {
    std::vector<Type*> found;
    for (Effect* effect : made_)
      if (auto* one = dynamic_cast<Type*>(effect)) found.push_back(one);
    return found;
  }
  /// The same, which must be there.
  template <class Type>
  Type& need() const {
    if (Type* found = find<Type>()) return *found;
    throw std::logic_error(std::string("no effect of the type ") + typeid(Type).name() +
                           " was made before");
  }
  void made(Effect* effect) { made_.push_back(effect); }

  /// Notes that an entry of a section holds elements. Throws InputError when another one of that
  /// section holds one of them.
  void claim(const std::string& section, const std::string& name,
             const std::vector<std::int32_t>& elements) {
    solidem::claim(holders_[section], elements, section, name, specimen());
  }

 private:
  std::vector<Effect*> made_;
  std::map<std::string, std::map<std::int32_t, std::string>> holders_;  ///< by section
};

}  // namespace solidem

#endif
