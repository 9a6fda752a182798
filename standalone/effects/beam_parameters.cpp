// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beam_parameters.hpp"

namespace solidem {

const char* name_of(BeamParameters::Law law) {
  switch (law) {
    case BeamParameters::Law::timoshenko:
      return "timoshenko";
    case BeamParameters::Law::spring:
      return "spring";
    case BeamParameters::Law::euler_bernoulli:
      break;
  }
  return "euler-bernoulli";
}

const char* name_of(PlasticityParameters::Law law) {
  return name_in(flow_rules, law);
}

const char* name_of(JudgedSection section) {
  return name_in(judged_sections, section);
}

std::string name_of(const YieldLaw& law) {
  return std::visit([](const auto& any) { return any.name; }, law);
}

std::string name_of(const RuptureLaw& law) {
  return std::visit([](const auto& any) { return any.name; }, law);
}

}  // namespace solidem
