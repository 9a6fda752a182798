// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/parameters.hpp"

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

const char* name_of(ConductionParameters::Law law) {
  switch (law) {
    case ConductionParameters::Law::platonic:
      return "platonic";
    case ConductionParameters::Law::platonic_calibrated:
      return "platonic-calibrated";
    case ConductionParameters::Law::voronoi:
      break;
  }
  return "voronoi";
}

const char* name_of(ConductionParameters::Integrator integrator) {
  switch (integrator) {
    case ConductionParameters::Integrator::explicit_euler:
      return "explicit";
    case ConductionParameters::Integrator::rkl2:
      return "rkl2";
    case ConductionParameters::Integrator::implicit:
      return "implicit";
    case ConductionParameters::Integrator::automatic:
      break;
  }
  return "auto";
}

const char* name_of(CentralForceParameters::Equilibrium equilibrium) {
  return equilibrium == CentralForceParameters::Equilibrium::initial ? "initial" : "radii";
}

const char* name_of(CentralForceParameters::Neighbours neighbours) {
  return neighbours == CentralForceParameters::Neighbours::changing ? "changing" : "fixed";
}

}  // namespace solidem
