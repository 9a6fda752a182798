// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_TENSION_BENCH_HPP
#define SOLIDEM_ENGINE_TENSION_BENCH_HPP

#include <functional>
#include <optional>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "engine/calibration.hpp"

namespace solidem {

/// Calls work(0) … work(count − 1), several at once where there are threads for it. An exception
/// passes on when all are done, that of the lowest number.
void for_each_at_once(std::size_t count, const std::function<void(std::size_t)>& work);

/// Specimens that are tested again and again with other bonds between their elements.
class TensionBench {
 public:
  /// Keeps a reference to the specimens. Throws InputError when one of them is no bar.
  TensionBench(const std::vector<Specimen>& specimens, const std::optional<Gauge>& gauge);

  /// The static test of every specimen.
  std::vector<ElasticConstants> elasticity(const BeamParameters& beams);

  /// The dynamic test of every specimen; `test` holds all that is the same for each.
  std::vector<TensionCurve> tension(const BondParameters& bonds,
                                    const std::vector<ElasticConstants>& elastic,
                                    const TensionTest& test) const;

  std::size_t size() const { return specimens_.size(); }
  const Specimen& first() const { return specimens_.front(); }
  const TensileBar& first_bar() const { return bars_.front(); }

 private:
  const std::vector<Specimen>& specimens_;
  std::vector<TensileBar> bars_;
  std::vector<std::optional<Equilibrium>> states_;  ///< where the next static test begins
};

}  // namespace solidem

#endif
