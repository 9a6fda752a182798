// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/tension_bench.hpp"

#include <exception>

namespace solidem {

void for_each_at_once(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (count == 1) {  // inside a parallel region the work itself would find no threads
    work(0);
    return;
  }
  std::vector<std::exception_ptr> thrown(count);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t k = 0; k < count; ++k) {
    try {
      work(k);
    } catch (...) {
      thrown[k] = std::current_exception();
    }
  }
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
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

std::vector<TensionFigures> TensionBench::tension(const BondParameters& bonds,
                                                  const std::vector<ElasticConstants>& elastic,
                                                  const TensionTest& test) const {
  std::vector<TensionFigures> figures(size());
  for_each_at_once(size(), [&](std::size_t k) {
    TensionTest own = test;
    own.bar = bars_[k];
    own.elastic = elastic[k];
    figures[k] = pull(bonds, specimens_[k], own).figures;
  });
  return figures;
}

}  // namespace solidem
