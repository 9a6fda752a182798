// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_BOND_TEMPERATURE_HPP
#define SOLIDEM_EFFECTS_BOND_TEMPERATURE_HPP

#include <optional>
#include <vector>

#include "effects/beams.hpp"
#include "effects/conduction.hpp"
#include "effects/temperature_acts.hpp"

namespace solidem {

/// Thermal expansion of beams; coefficients are those of the materials.
struct ExpansionParameters {
  std::optional<double>
      reference_temperature;  ///< at which the body was made, K; none: the initial
};

/// Moduli of beams over temperature.
struct SofteningParameters {
  TemperatureFunction modulus_ratio;  ///< to what [beams] gives
};

/// What temperatures change about bonds: their length free of load, their stiffness, and where they
/// yield (of which the bounds of the hot loop are kept here).
///
/// An element's thermal strain is ε(T) = ∫ α dT from the reference temperature, a bond's the mean
/// of its ends', ½(ε_i + ε_j): either half of a beam has the temperature and the material of its
/// end. For one α that is α times the rise of the mean temperature. l becomes l₀ (1 + ε), also
/// where the law of beams says l. Moduli change by 2 r_i r_j / (r_i + r_j), two halves in series.
///
/// Both follow when heat has stepped. The energy that bonds gain in the pose of that moment (and
/// what the flow of that pose then takes) is the work of heating. So is ½ Δt v·ΔF of each element:
/// velocities are half a step behind, and what a step conserves knows one force from then on.
class BondTemperature : public FollowsTemperature {
 public:
  struct Demands {
    std::optional<ExpansionParameters> expansion;
    std::optional<SofteningParameters> softening;
    bool yields_warm = false;  ///< beams yield otherwise when they are warm
    bool changes_bonds() const { return expansion || softening; }
  };
  BondTemperature(Demands demands, ThermalProperties properties, double initial_temperature,
                  const Beams& beams, Model& model);

  void follow(Model& model, double time_step) override;

  double stiffening() const override;
  double stiffened() const override { return stiffened_; }
  double work(const Model& /*model*/) const override { return work_; }
  void observe(const Model& model, Observation& observation) const override;
  void state(Archive& archive) override;

 private:
  /// What temperature makes of an element.
  struct Effects {
    std::vector<double> strain, ratio;  ///< of each element; empty: not asked for
  };
  Effects effects_now() const;
  /// Makes columns of bonds those of the temperatures of now; the work of heating, J.
  double refresh(bool adopts_new_bonds, double time_step);
  double refresh_block(std::size_t block, const Effects& now, const BeamMotion& columns,
                       bool adopts_new_bonds, double time_step);
  /// Notes what a bond is at the reference temperature, if it was made since heat last stepped and
  /// is to be adopted. Whether that is known then.
  bool adopt(std::size_t i, std::size_t j, std::size_t row, int lane, bool adopts_new_bonds);
  void note_stiffness();

  Demands demands_;
  ThermalProperties properties_;
  double reference_temperature_;
  const Beams& beams_;
  Model& model_;
  Effects effects_;                               ///< that the columns of bonds show
  double least_ratio_ = 1, largest_stretch_ = 1;  ///< at the start
  double work_ = 0;                               ///< J
  double stiffened_ = 1;
};

}  // namespace solidem

#endif
