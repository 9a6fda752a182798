// SPDX-License-Identifier: GPL-2.0-or-later
//
// A kind of effect: all that the rest of the house knows of it. A new effect is a file in effects/
// that ends with its kind, and a line in effects/all_effects.cpp; scene files, plan, simulation,
// checkpoints, `solidem explain` and `solidem keys` then know it.
#ifndef SOLIDEM_EFFECTS_EFFECT_KIND_HPP
#define SOLIDEM_EFFECTS_EFFECT_KIND_HPP

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "effects/plan.hpp"
#include "effects/setup.hpp"
#include "keys/regions.hpp"
#include "keys/section.hpp"

namespace solidem {

/// What others need that some effects bring.
enum class Provides {
  nothing,
  motion,  ///< elements move
  heat     ///< elements have temperatures
};

/// A section that a kind makes no sense with, and why.
struct Conflict {
  std::string section, problem, expected;
};

/// What a section is read with besides its own text.
struct Reading {
  Setup& setup;
  const NamedRegions& regions;
  const std::optional<double>& bond_tolerance;  ///< t of [bonds], if given
  std::set<std::string> taken;                  ///< names of the entries of this section so far
};

/// Is shown the name of a section, such as "beams.fibres", and its keys.
using VisitKeys = std::function<void(const std::string&, const std::vector<Key>&)>;

struct EffectKind {
  std::string section;   ///< of the scene file, "grips"
  bool is_list = false;  ///< may stand several times, [[grips]]
  Provides provides = Provides::nothing;
  Provides needs = Provides::nothing;
  std::vector<std::string> beside;  ///< sections of which it needs one; empty: none
  std::string problem_alone;        ///< what is wrong without
  std::vector<Conflict> conflicts;

  /// Reads the section into the setup.
  std::function<void(const Value&, Reading&)> read;
  /// A section that makes it act on a small body of a metal: for the pages, and for the tests that
  /// every effect goes through.
  std::string example;
  /// Shows the keys of its section, and of those inside, bound to parameters that hold the
  /// defaults.
  std::function<void(const VisitKeys&)> visit_keys;
  /// Whether a setup names it.
  std::function<bool(const Setup&)> is_named;
  /// Adds to the plan, if the setup names it, the effects that act and the columns they work on.
  std::function<void(const Setup&, Plan&)> plan;
  /// Sets the state that a run begins with, once elements can move and before anything is imposed.
  std::function<void(const Setup&, Model&)> start;
  /// Adds what `solidem explain --json` says of its parameters, in SI units.
  std::function<void(const Setup&, const Specimen&, nlohmann::ordered_json&)> explain;
};

/// Every kind there is, in the order in which effects are planned and report. A program that links
/// the library may add kinds of its own before it reads a scene.
std::vector<EffectKind>& effect_kinds();

/// Whether a setup names an effect that provides something.
bool provides(const Setup& setup, Provides what);

/// "a section [beams] or [central_forces]": one of these.
std::string any_section(const std::vector<std::string>& sections);
/// The same of what a scene needs for one of these to be provided.
std::string sections_that_provide(const std::vector<Provides>& any_of);

/// Adds the values of keys in their places, in SI units; keys that are no single value are left
/// out.
void add_values(const std::vector<Key>& keys, nlohmann::ordered_json& values);
/// The same as one more entry of a list.
void append_values(const std::vector<Key>& keys, nlohmann::ordered_json& list);

/// Binds the keys of a section to parameters.
template <class Parameters>
using BindKeys = std::vector<Key> (*)(Parameters&, Reading&);
/// Checks what a key's own rule cannot know, and works out what depends on other sections.
template <class Parameters>
using FinishReading = void (*)(const Section&, Parameters&, Reading&);

/// A reading of nothing, for whoever wants to look at keys.
struct EmptyReading {
  Setup setup;
  NamedRegions regions;
  std::optional<double> bond_tolerance;
  Reading reading{setup, regions, bond_tolerance, {}};
};

/// What every kind knows of its keys, whether its section stands once or several times.
template <class Parameters>
EffectKind kind_with_keys(const std::string& section, BindKeys<Parameters> keys) {
  EffectKind kind;
  kind.section = section;
  kind.visit_keys = [section, keys](const VisitKeys& visit) {
    EmptyReading empty;
    Parameters parameters;
    visit(section, keys(parameters, empty.reading));
  };
  return kind;
}

/// The parameters that one section gives.
template <class Parameters>
Parameters read_parameters(const Section& given, BindKeys<Parameters> keys,
                           FinishReading<Parameters> finish, Reading& reading) {
  Parameters parameters;
  given.read(keys(parameters, reading));
  finish(given, parameters, reading);
  return parameters;
}

/// A kind whose section stands once.
template <class Parameters>
EffectKind single_kind(const std::string& section, BindKeys<Parameters> keys,
                       FinishReading<Parameters> finish) {
  EffectKind kind = kind_with_keys(section, keys);
  kind.is_named = [](const Setup& setup) { return setup.get<Parameters>().has_value(); };
  kind.read = [keys, finish](const Value& value, Reading& reading) {
    table([&](const Section& given) {
      reading.setup.get<Parameters>() = read_parameters(given, keys, finish, reading);
    }).read(value);
  };
  kind.explain = [keys](const Setup& setup, const Specimen&, nlohmann::ordered_json& values) {
    EmptyReading empty;
    Parameters parameters = *setup.get<Parameters>();
    add_values(keys(parameters, empty.reading), values);
  };
  return kind;
}

/// A kind whose section may stand several times.
template <class Parameters>
EffectKind list_kind(const std::string& section, BindKeys<Parameters> keys,
                     FinishReading<Parameters> finish) {
  EffectKind kind = kind_with_keys(section, keys);
  kind.is_list = true;
  kind.is_named = [](const Setup& setup) { return !setup.all<Parameters>().empty(); };
  kind.read = [keys, finish](const Value& value, Reading& reading) {
    tables([&](const Section& given) {
      reading.setup.all<Parameters>().push_back(read_parameters(given, keys, finish, reading));
    }).read(value);
  };
  kind.explain = [keys](const Setup& setup, const Specimen&, nlohmann::ordered_json& list) {
    EmptyReading empty;
    Parameters shown;
    for (const Parameters& parameters : setup.all<Parameters>()) {
      shown = parameters;
      append_values(keys(shown, empty.reading), list);
    }
  };
  return kind;
}

/// Where nothing but the keys' own rules is to be checked.
template <class Parameters>
void as_read(const Section& /*section*/, Parameters& /*parameters*/, Reading& /*reading*/) {}

}  // namespace solidem

#endif
