// SPDX-License-Identifier: GPL-2.0-or-later
//
// Laws of central force as a user names them on the command line:
//   mie "energy=0.1 mJ" repulsive_exponent=8 attractive_exponent=4 range=1.5 "label=8-4"
#ifndef SOLIDEM_APP_LAW_WORDS_HPP
#define SOLIDEM_APP_LAW_WORDS_HPP

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/law_curve.hpp"

namespace solidem {

/// What holds for every law unless its own words say otherwise; empty: what the scene says, else
/// the default.
struct LawDefaults {
  std::string equilibrium, range, interpenetration;
};

/// The laws that words name, in their order: each the name of a law followed by its parameters, or
/// a scene file (.toml) with a section [central_forces]. Beside its parameters a law may have
/// `equilibrium` (a length), `range`, `interpenetration` and `label`. Throws InputError with the
/// word, what is wrong with it, and what would be right.
std::vector<ShownLaw> laws_from_words(const std::vector<std::string>& words,
                                      const LawDefaults& defaults);

/// A table of all laws: parameters, units, meanings.
std::string list_of_laws();
/// The same for programs.
nlohmann::ordered_json json_of_laws();

}  // namespace solidem

#endif
