// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/tension_bench.hpp"

#include "effects/beam_parameters.hpp"
#include "model/blocks.hpp"

namespace solidem {

void for_each_at_once(std::size_t count, const std::function<void(std::size_t)>& work) {
  for_each_part(count, count > 1, work);  // one alone has all threads for what it does itself
}

TensionBench::TensionBench(const std::vector<Specimen>& specimens,
                           const std::optional<Gauge>& gauge)
    : specimens_(specimens), states_(specimens.size()) {
  for (const Specimen& specimen : specimens) bars_.push_back(tensile_bar(specimen, gauge));
}

std::vector<ElasticConstants> TensionBench::elasticity(const BeamParameters& beams) {
  std::vector<ElasticConstants> constants(size());
  for_each_at_once(size(), [&](std::size_t k) {
    constants[k] = elastic_constants(beams, specimens_[k], bars_[k], &states_[k]);
  });
  return constants;
}

std::vector<TensionCurve> TensionBench::tension(const BondParameters& bonds,
                                                const std::vector<ElasticConstants>& elastic,
                                                const TensionTest& test) const {
  std::vector<TensionCurve> curves(size());
  for_each_at_once(size(), [&](std::size_t k) {
    TensionTest own = test;
    own.bar = bars_[k];
    own.elastic = elastic[k];
    curves[k] = pull(bonds, specimens_[k], own);
  });
  return curves;
}

}  // namespace solidem
