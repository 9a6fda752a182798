// SPDX-License-Identifier: GPL-2.0-or-later
//
// Force and potential between two elements by the laws themselves: what the pair style must give
// too.
//
//   central_pair interpenetration law name value ... < lines of distance, equilibrium, range
//
// A line of the output: force, N, positive when it pushes apart; potential, J. Both 0 beyond the
// range.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <variant>

#include "laws/central_interaction.hpp"
#include "laws/central_laws.hpp"

int main(int count, char** words) {
  const double interpenetration = std::atof(words[1]);
  solidem::CentralLaw law;
  solidem::CentralLaws::for_each([&](auto known) {
    if (std::string(words[2]) != known.name) return;
    for (int k = 3; k + 1 < count; k += 2)
      for (const auto& parameter : known.parameters())
        if (std::string(words[k]) == parameter.name)
          known.*parameter.place = std::atof(words[k + 1]);
    law = known;
  });
  double distance, equilibrium, range;
  while (std::cin >> distance >> equilibrium >> range) {
    double force = 0, potential = 0;
    if (distance < range)
      std::visit(
          [&](const auto& of) {
            force = solidem::central_force(of, interpenetration, distance, equilibrium).force;
            potential =
                solidem::central_potential(of, interpenetration, range, distance, equilibrium);
          },
          law);
    std::printf("%.17g %.17g\n", force, potential);
  }
}
