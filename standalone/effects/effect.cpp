// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/effect.hpp"

namespace solidem {

void EnergyLedger::add(Kind kind, const std::string& name, double energy) {
  for (Account& account : accounts_)
    if (account.name == name) {
      account.energy += energy;
      return;
    }
  accounts_.push_back({kind, name, energy});
}

double EnergyLedger::sum(Kind kind) const {
  double sum = 0;
  for (const Account& account : accounts_)
    if (account.kind == kind) sum += account.energy;
  return sum;
}

double EnergyLedger::of(const std::string& name) const {
  for (const Account& account : accounts_)
    if (account.name == name) return account.energy;
  return 0;
}

}  // namespace solidem
