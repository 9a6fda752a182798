// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_BEAMS_HPP
#define SOLIDEM_EFFECTS_BEAMS_HPP

#include <optional>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/beam_properties.hpp"
#include "effects/bond_columns.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/mechanics.hpp"
#include "effects/setup.hpp"
#include "laws/constants.hpp"

namespace solidem {

/// What a scene asks of the bonds between elements.
struct BeamDemands {
  BeamParameters elasticity;
  std::optional<PlasticityParameters> plasticity;
  std::optional<RuptureParameters> rupture;
  bool rebonding = false;  ///< bonds may be made anew, between elements that have turned
  bool expands = false, softens = false;  ///< with temperature

  /// What the hot loop must look out for.
  Watch watch() const;
  /// Whether bonds are judged where the hot loop cannot tell how strained they are, so that each is
  /// looked at in each step.
  bool looks_at_all() const;
  bool feels_rate() const { return plasticity && follows_rate(plasticity->hardening); }
  bool feels_temperature() const {
    return plasticity && follows_temperature(plasticity->hardening);
  }
  const YieldLaw* yield() const { return plasticity ? &plasticity->hardening : nullptr; }
  /// The limits of beams of each two materials over those of the laws; none: one material.
  std::vector<BeamPairing> pairings() const;
  BondNeeds needs(bool periodic) const;
  bool has_rotation() const { return elasticity.law != BeamParameters::Law::spring; }
};

/// What a setup asks of its bonds; it must have some.
BeamDemands demands_of(const Setup& setup);

struct BondEffort;

/// Elements in motion under beam bonds: laws/beam.hpp, with laws/beam_plasticity.hpp where bonds
/// flow; velocity Verlet, with rotations unless the bonds are springs.
///
/// A step flows, pulls and moves in one pass: bonds flow to the pose that the step begins with, and
/// that flow is kept. A look at the state (`bond`, `observe`) sees the same flow and keeps nothing.
class Beams : public Mechanics {
 public:
  /// Columns that the effect needs.
  static std::vector<const Column*> columns(const BeamDemands& demands, bool periodic);

  /// Bonds are made at the specimen's rest positions, elements at rest. `mass` per element, kg.
  Beams(const BeamDemands& demands, const std::vector<double>& mass, Model& model);

  /// min over bonds of sqrt(m/k_axial), sqrt(J/k_bend), sqrt(J/k_tors), with m and J of the lighter
  /// end, k_axial = ES/l, k_bend = EI/l, k_tors = GI_0/l.
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  double longest_time_step(double squared_frequency) const override;

  /// E S l of a bond of mean radius as long as its elements touch, J.
  double typical_energy(const Model& model) const override {
    return 2 * rigidity_.axial * mean_radius(model.specimen());
  }

  /// E S / l
  double mean_stiffness(const Model& model) const override;

  void advance(Model& model, const Step& step) override;

  /// The elastic accelerations of the present pose, in the columns of the velocities, which must be
  /// zero; nothing moves, flows or breaks.
  void accelerate(Model& model) const override;
  void for_each_pair(const Model& model, const PairVisit& visit) const override;

  /// Slots that reached their limit in the last step, in increasing order; a bond may stand once or
  /// twice.
  const std::vector<std::uint32_t>& breaking() const { return breaking_; }

  /// Loads, velocities, elastic energy and plastic work.
  void observe(const Model& model, Observation& observation) const override;
  double spent(const Model& model) const override;
  /// Stress, plastic strain and state of the bonds, where they may flow or break.
  void show(const Model& model, Frame& frame) const override;
  void finish_move(Model& model) override;

  /// A bond at one instant, seen from element i, after the flow that the instant asks for.
  struct Bond {
    std::int32_t i, j;
    Vector chord;  ///< from i to j, m
    YieldingBeam<double> beam;
    BeamResponse<double> response;
    const BeamLoad<double>& load() const { return response.load; }
    double energy() const { return response.energy; }
    double rest_length() const { return beam.rest_length; }
    const BeamRigidity<double>& rigidity() const { return beam.rigidity; }
    double section() const { return pi * beam.radius * beam.radius; }  ///< m²
  };

  /// The bond in a slot.
  Bond bond(const Model& model, std::int32_t i, std::int32_t j, std::size_t row, int lane) const;
  /// The same for who looks at many: of motion().
  Bond bond(const BeamMotion& motion, std::int32_t i, std::int32_t j, std::size_t row,
            int lane) const;

  /// Fills a slot of element i, and no other, with a bond to j free of load; `chord` from i to j.
  /// Elements may have turned only where bonds remember their normals.
  void bind(Model& model, std::int32_t i, std::int32_t j, std::size_t row, int lane,
            const Vector& chord) const;

  /// Empties a slot.
  static void release(Model& model, std::size_t row, int lane);

  /// Fits the strains up to which bonds surely do not flow to the temperatures of now.
  void refresh_limits(Model& model) const;

  void state(Archive& archive) override;

  const BeamProperties& properties() const { return properties_; }

  /// The columns and figures that the hot loop works on; without a step and a list for what breaks.
  BeamMotion motion(Model& model) const;

 private:
  BeamMotion columns_of(const Model& model) const;  ///< to be read alone
  /// Of the bond in a slot.
  BondEffort effort(const BeamMotion& motion, std::int32_t i, std::int32_t j, std::size_t row,
                    int lane) const;
  /// Of a new bond.
  double limit_of(const LimitScale<double>& scale, double temperature) const;
  /// Of a bond, where it counts, K; else 0.
  double temperature_of(const Model& model, std::int32_t i, std::int32_t j) const;
  double time_of_rates(const Model& model) const;
  NewBond new_bond(const Model& model, std::int32_t i, std::int32_t j, const Vector& chord) const;
  const YieldLaw* yield() const { return demands_.yield(); }
  const RuptureLaw* rupture() const { return demands_.rupture ? &demands_.rupture->law : nullptr; }
  FlowRule flow_rule() const {
    return demands_.plasticity ? demands_.plasticity->law : FlowRule::radial_return;
  }

  BeamDemands demands_;
  BeamProperties properties_;
  BeamSection<double> section_;    ///< of every beam, where all are alike
  BeamRigidity<double> rigidity_;  ///< likewise
  double least_limit_;             ///< strain up to which no new bond flows or breaks
  double time_ = 0;                ///< of the pose, s
  double time_step_ = 0;           ///< that led to it, s
  double rate_time_ = 0;           ///< over which rates of flow are averaged, s
  std::vector<std::uint32_t> breaking_;
};

}  // namespace solidem

#endif
