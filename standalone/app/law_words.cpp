// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/law_words.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "effects/central_force_parameters.hpp"
#include "keys/nearest_name.hpp"
#include "keys/units.hpp"
#include "model/error.hpp"
#include "model/specimen.hpp"
#include "scene/scene.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

namespace {

/// How a quantity of a law is written.
struct Writing {
  const char* unit;     ///< "" for bare numbers
  Dimension dimension;  ///< of quantities
};

Writing writing_of(LawQuantity quantity) {
  switch (quantity) {
    case LawQuantity::energy:
      return {"J", dimension::energy};
    case LawQuantity::force:
      return {"N", dimension::force};
    case LawQuantity::stiffness:
      return {"N/m", dimension::stiffness};
    case LawQuantity::ratio:
    case LawQuantity::exponent:
      break;
  }
  return {"", dimension::number};
}

/// A law with its words, before they are understood.
struct NamedLaw {
  std::string name;
  std::map<std::string, std::string> values;
};

[[noreturn]] void refuse(const NamedLaw& named, const std::string& key, const std::string& value,
                         const std::string& problem, const std::string& expected) {
  throw InputError(
      fmt::format("{} {} = {}: {}; expected {}", named.name, key, value, problem, expected));
}

double number_of(const NamedLaw& named, const std::string& key, const std::string& value,
                 const std::string& expected) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || !std::isfinite(number))
    refuse(named, key, value, "not a number", expected);
  return number;
}

double quantity_of(const NamedLaw& named, const std::string& key, const std::string& value,
                   const Dimension& dimension) {
  const std::string expected =
      fmt::format("{} above 0 such as \"{}\"", dimension.name, dimension.example);
  double si = 0;
  try {
    si = to_si(value, dimension);
  } catch (const InputError& error) {
    refuse(named, key, value, error.what(), expected);
  }
  if (!(si > 0)) refuse(named, key, value, "out of range", expected);
  return si;
}

/// The value of a parameter of a law.
double parameter_of(const NamedLaw& named, const std::string& key, const std::string& value,
                    LawQuantity quantity) {
  const Writing writing = writing_of(quantity);
  if (*writing.unit != '\0') return quantity_of(named, key, value, writing.dimension);
  const bool is_exponent = quantity == LawQuantity::exponent;
  const std::string expected = is_exponent ? "an integer of at least 1" : "a number above 0";
  const double number = number_of(named, key, value, expected);
  if (is_exponent && number != std::floor(number))
    refuse(named, key, value, "not an integer", expected);
  if (!(number > 0) || (is_exponent && number > 1000))
    refuse(named, key, value, "out of range",
           is_exponent ? expected + " and at most 1000" : expected);
  return number;
}

template <class Law>
std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const auto& parameter : Law::parameters()) names.emplace_back(parameter.name);
  return names;
}

template <class Law>
Law law_of(const NamedLaw& named) {
  Law law;
  for (const auto& parameter : Law::parameters()) {
    const auto given = named.values.find(parameter.name);
    const Writing writing = writing_of(parameter.quantity);
    if (given == named.values.end())
      throw InputError(fmt::format(
          "{}: {} is missing ({}); expected {}={}", named.name, parameter.name, parameter.meaning,
          parameter.name,
          *writing.unit != '\0' ? fmt::format("\"{}\"", writing.dimension.example) : "a number"));
    law.*parameter.place = parameter_of(named, parameter.name, given->second, parameter.quantity);
  }
  if (const char* complaint = law.complaint())
    throw InputError(fmt::format("{}: {}", named.name, complaint));
  return law;
}

const std::vector<std::string> common_names = {"equilibrium", "range", "interpenetration", "label"};

/// Refuses words that are no parameter of the law.
void refuse_unknown(const NamedLaw& named, std::vector<std::string> known) {
  const std::vector<std::string> parameters = known;
  known.insert(known.end(), common_names.begin(), common_names.end());
  for (const auto& [key, value] : named.values) {
    bool is_known = false;
    for (const std::string& name : known) is_known = is_known || name == key;
    if (!is_known)
      throw InputError(fmt::format("{} {} = {}: unknown parameter{}; expected {}one of {}",
                                   named.name, key, value, did_you_mean(key, known),
                                   parameters.empty() ? "" : join(parameters) + ", or ",
                                   join(common_names)));
  }
}

/// What a law is called in a legend when the user has no name for it: all its parameters.
template <class Law>
std::string label_of(const NamedLaw& named) {
  std::string text = Law::name;
  const char* between = " ";
  for (const auto& parameter : Law::parameters()) {
    text += between + named.values.at(parameter.name);
    between = ", ";
  }
  return text;
}

void apply_common(ShownLaw& shown, const NamedLaw& named, const LawDefaults& defaults) {
  const auto word = [&](const char* key, const std::string& otherwise) {
    const auto given = named.values.find(key);
    return given == named.values.end() ? otherwise : given->second;
  };
  if (const std::string text = word("equilibrium", defaults.equilibrium); !text.empty())
    shown.equilibrium = quantity_of(named, "equilibrium", text, dimension::length);
  if (const std::string text = word("range", defaults.range); !text.empty()) {
    shown.range = number_of(named, "range", text, "a number above 1");
    if (!(shown.range > 1)) refuse(named, "range", text, "out of range", "a number above 1");
  }
  if (const std::string text = word("interpenetration", defaults.interpenetration); !text.empty()) {
    const std::string expected = "a number above 0 and below 1";
    shown.interpenetration = number_of(named, "interpenetration", text, expected);
    if (!(shown.interpenetration > 0 && shown.interpenetration < 1))
      refuse(named, "interpenetration", text, "out of range", expected);
  }
  if (const std::string text = word("label", ""); !text.empty()) shown.label = text;
}

bool is_scene(const std::string& word) {
  const std::string ending = ".toml";
  return word.size() > ending.size() &&
         word.compare(word.size() - ending.size(), ending.size(), ending) == 0;
}

/// The mean radius of a scene's elements, m; the body is made only where the recipe does not say
/// it.
double mean_radius_of(const Scene& scene) {
  if (!scene.bodies.empty()) return mean_radius(make_bodies(scene.bodies));
  const SpecimenRecipe& recipe = scene.specimen;
  if (recipe.file.empty() && recipe.element_radius > 0) return recipe.element_radius;
  if (recipe.file.empty() && recipe.mean_radius > 0) return recipe.mean_radius;
  return mean_radius(make_specimen(recipe));
}

/// The law of a scene's [central_forces].
ShownLaw scene_law(const NamedLaw& named, const LawDefaults& defaults) {
  const Scene scene = read_scene(named.name);
  if (!scene.setup.get<CentralForceParameters>())
    throw InputError(named.name +
                     ": no central forces; expected a scene with a section [central_forces]");
  refuse_unknown(named, {});
  const CentralForceParameters& forces = *scene.setup.get<CentralForceParameters>();
  ShownLaw shown;
  shown.label = std::visit([](const auto& law) { return std::string(law.name); }, forces.law) +
                " of " + scene.title;
  shown.law = forces.law;
  shown.range = forces.range;
  shown.interpenetration = forces.interpenetration;
  if (named.values.count("equilibrium") == 0 && defaults.equilibrium.empty())
    shown.equilibrium = 2 * at_places_of(scene, [&] { return mean_radius_of(scene); });
  apply_common(shown, named, defaults);
  return shown;
}

ShownLaw shown_law(const NamedLaw& named, const LawDefaults& defaults) {
  if (is_scene(named.name)) return scene_law(named, defaults);
  ShownLaw shown;
  std::vector<std::string> names;
  bool is_found = false;
  CentralLaws::for_each([&](auto law) {
    using Law = decltype(law);
    names.emplace_back(Law::name);
    if (named.name != Law::name) return;
    is_found = true;
    refuse_unknown(named, parameter_names<Law>());
    shown.law = law_of<Law>(named);
    shown.label = label_of<Law>(named);
  });
  if (!is_found)
    throw InputError(fmt::format("no law is called {}{}; there are {}", named.name,
                                 did_you_mean(named.name, names), join(names)));
  apply_common(shown, named, defaults);
  return shown;
}

}  // namespace

std::vector<ShownLaw> laws_from_words(const std::vector<std::string>& words,
                                      const LawDefaults& defaults) {
  std::vector<NamedLaw> named;
  for (const std::string& word : words) {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos) {
      named.push_back({word, {}});
      continue;
    }
    if (named.empty())
      throw InputError(word +
                       ": no law stands before it; expected the name of a law, then its "
                       "parameters");
    const std::string key = word.substr(0, sign);
    if (!named.back().values.emplace(key, word.substr(sign + 1)).second)
      throw InputError(fmt::format("{} {}: given twice", named.back().name, key));
  }
  std::vector<ShownLaw> laws;
  for (const NamedLaw& law : named) laws.push_back(shown_law(law, defaults));
  return laws;
}

std::string list_of_laws() {
  std::string text;
  CentralLaws::for_each([&](auto law) {
    text += fmt::format("{}\n", law.name);
    for (const auto& parameter : law.parameters()) {
      const char* unit = writing_of(parameter.quantity).unit;
      const char* shown = *unit != '\0'                                 ? unit
                          : parameter.quantity == LawQuantity::exponent ? "integer"
                                                                        : "number";
      text += fmt::format("  {:<28}{:<10}{}\n", parameter.name, shown, parameter.meaning);
    }
  });
  return text;
}

nlohmann::ordered_json json_of_laws() {
  nlohmann::ordered_json laws = nlohmann::ordered_json::array();
  CentralLaws::for_each([&](auto law) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
    for (const auto& parameter : law.parameters())
      parameters.push_back({{"name", parameter.name},
                            {"unit", writing_of(parameter.quantity).unit},
                            {"is_integer", parameter.quantity == LawQuantity::exponent},
                            {"meaning", parameter.meaning}});
    laws.push_back({{"name", law.name}, {"parameters", parameters}});
  });
  return laws;
}

}  // namespace solidem
