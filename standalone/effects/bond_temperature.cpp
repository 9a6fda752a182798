// SPDX-License-Identifier: GPL-2.0-or-later
//
// [expansion] and [softening].
#include "effects/bond_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/bond_slot.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/effect_kind.hpp"
#include "effects/temperature_function_json.hpp"
#include "keys/rules.hpp"
#include "laws/heat_exchange.hpp"
#include "model/blocks.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr std::size_t rigidities = columns::bond_rigidity.components;

double least_of(const std::vector<double>& values) {
  return values.empty() ? 1 : *std::min_element(values.begin(), values.end());
}
double largest_of(const std::vector<double>& values) {
  return values.empty() ? 1 : *std::max_element(values.begin(), values.end());
}

/// l / l₀ of a bond.
double stretch(const std::vector<double>& strain, std::size_t i, std::size_t j) {
  return 1 + 0.5 * (strain[i] + strain[j]);
}
/// E / E₀ of a bond.
double softness(const std::vector<double>& ratio, std::size_t i, std::size_t j) {
  return series_conductivity(ratio[i], ratio[j]);
}

/// What temperature makes of a bond: its length free of load, m, and its stiffness, as a multiple.
struct ChangedBond {
  double length, stiffness;
};

/// Whether a bond may flow in its pose: the bound of the hot loop, laws/beam_plasticity.hpp.
bool may_flow(const BeamMotion& m, const SlotReader& slot, const BondNow<double>& bond) {
  if (m.yield == nullptr) return false;
  double radius = m.radius, shear_ratio = m.shear_ratio;
  if (m.bond_rigidity != nullptr) {
    radius = slot.number(m.bond_radius);
    shear_ratio = 2 * bond.rigidity.torsion / (bond.rigidity.axial * radius * radius);
  }
  const double safe = slot.number(m.limit_strain) * bond.rest_length;
  return bound_of_squared_extension(radius, shear_ratio, bond.pose, bond.deformation) > safe * safe;
}

/// A bond in a pose: its energy, with the plastic work of the flow that the pose asks for, J, and
/// what it does to its element.
struct PosedEnergy {
  double energy;
  BeamLoad<double> load;
};

PosedEnergy elastic(const BeamMotion& m, const BondNow<double>& bond) {
  const double energy = beam_energy(bond.rigidity, bond.pose, bond.deformation);
  if (m.has_rotation) return {energy, beam_load(bond.rigidity, bond.pose, bond.deformation)};
  return {energy, {spring_force(bond.rigidity, bond.deformation), {}, {}}};
}

/// A bond before and after it changes in its pose; none where it may flow in it.
std::optional<std::pair<PosedEnergy, PosedEnergy>> elastic_change(const BeamMotion& m,
                                                                  const SlotReader& slot,
                                                                  std::int32_t i, std::int32_t j,
                                                                  const ChangedBond& changed) {
  const auto [chord, q_i, q_j] = ends_in(m.pose, m, slot, i, j);
  const BondNow<double> before =
      load_bond(bond_kind(m), m, slot, true, chord, q_i, conjugate(q_i), q_j);
  BondNow<double> after = before;
  after.rest_length = changed.length;
  after.deformation.extension -= changed.length - before.rest_length;
  after.deformation.inverse_rest_length = 1 / changed.length;
  for (double* part : {&after.rigidity.axial, &after.rigidity.bending, &after.rigidity.shear,
                       &after.rigidity.torsion})
    *part *= changed.stiffness;
  if (may_flow(m, slot, before) || may_flow(m, slot, after)) return {};
  return std::pair{elastic(m, before), elastic(m, after)};
}

/// What changes along the velocity of an element, W.
double power(const BeamMotion& m, std::size_t element, const BeamLoad<double>& before,
             const BeamLoad<double>& after) {
  const std::size_t at = Model::at(columns::velocity, element);
  const double along = dot(lanes_vector(m.velocity, at), after.force - before.force);
  if (!m.has_rotation) return along;
  return along + dot(lanes_vector(m.angular_velocity, at), after.moment_i - before.moment_i);
}

}  // namespace

BondTemperature::BondTemperature(Demands demands, ThermalProperties properties,
                                 double initial_temperature, const Beams& beams, Model& model)
    : demands_(std::move(demands)),
      properties_(std::move(properties)),
      reference_temperature_(initial_temperature),
      beams_(beams),
      model_(model) {
  if (demands_.expansion)
    reference_temperature_ =
        demands_.expansion->reference_temperature.value_or(initial_temperature);
  // The bonds of the start were made at the reference temperature.
  if (demands_.expansion) effects_.strain.assign(model.elements(), 0);
  if (demands_.softening) effects_.ratio.assign(model.elements(), 1);
  refresh(true, 0);
  least_ratio_ = least_of(effects_.ratio);
  if (demands_.expansion) largest_stretch_ = 1 + largest_of(effects_.strain);
}

BondTemperature::Effects BondTemperature::effects_now() const {
  const double* temperature = model_.data(columns::temperature);
  Effects now;
  for (std::size_t i = 0; demands_.expansion && i < model_.elements(); ++i) {
    const TemperatureFunction& alpha = properties_.of(i).expansion_coefficient;
    now.strain.push_back(alpha.integral(temperature[i]) - alpha.integral(reference_temperature_));
  }
  for (std::size_t i = 0; demands_.softening && i < model_.elements(); ++i)
    now.ratio.push_back(demands_.softening->modulus_ratio(temperature[i]));
  return now;
}

bool BondTemperature::adopt(std::size_t i, std::size_t j, std::size_t row, int lane,
                            bool adopts_new_bonds) {
  const std::size_t at = Slots::Place{row, lane}.index();
  const std::size_t first = Model::at_slot(columns::bond_rigidity, row, lane);
  double* length = demands_.expansion ? model_.data(columns::reference_length) : nullptr;
  double* made_with = demands_.softening ? model_.data(columns::reference_rigidity) : nullptr;
  const bool is_adopted =
      length != nullptr ? length[at] != 0 : made_with != nullptr && made_with[first] != 0;
  if (is_adopted) return true;
  if (!adopts_new_bonds) return false;
  if (length != nullptr)
    length[at] = model_.data(columns::rest_length)[at] / stretch(effects_.strain, i, j);
  const double* rigidity = made_with != nullptr ? model_.data(columns::bond_rigidity) : nullptr;
  for (std::size_t k = first; rigidity != nullptr && k < first + rigidities * lanes; k += lanes)
    made_with[k] = rigidity[k];
  return true;
}

double BondTemperature::refresh_block(std::size_t block, const Effects& now,
                                      const BeamMotion& columns, bool adopts_new_bonds,
                                      double time_step) {
  double* length = model_.data(columns::rest_length);
  const double* cold = demands_.expansion ? model_.data(columns::reference_length) : nullptr;
  double* rigidity = demands_.softening ? model_.data(columns::bond_rigidity) : nullptr;
  const double* hard = demands_.softening ? model_.data(columns::reference_rigidity) : nullptr;
  double gained = 0;
  model_.slots().for_each_in(block, [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    if (!adopt(a, b, row, lane, adopts_new_bonds)) return;
    const std::size_t at = Slots::Place{row, lane}.index();
    const std::size_t first = Model::at_slot(columns::bond_rigidity, row, lane);
    const double long_now = cold != nullptr ? cold[at] * stretch(now.strain, a, b) : length[at];
    const double soft_now = hard != nullptr ? softness(now.ratio, a, b) : 1;
    const std::size_t end = hard != nullptr ? first + rigidities * lanes : first;
    bool is_the_same = long_now == length[at];
    for (std::size_t k = first; k < end; k += lanes)
      is_the_same = is_the_same && rigidity[k] == soft_now * hard[k];
    if (is_the_same) return;
    const double stiffer = hard != nullptr ? soft_now * hard[first] / rigidity[first] : 1;
    const auto look = [&] {
      const Beams::Bond bond = beams_.bond(columns, i, j, row, lane);
      return PosedEnergy{bond.energy() + bond.response.plastic_work, bond.load()};
    };
    auto change = elastic_change(columns, {row, lane}, i, j, {long_now, stiffer});
    const bool may_flow = !change;
    if (may_flow) change = {look(), {}};
    length[at] = long_now;
    for (std::size_t k = first; k < end; k += lanes) rigidity[k] = soft_now * hard[k];
    if (may_flow) change->second = look();
    const auto& [before, after] = *change;
    gained += after.energy - before.energy + time_step * power(columns, a, before.load, after.load);
  });
  return gained;
}

double BondTemperature::refresh(bool adopts_new_bonds, double time_step) {
  if (demands_.yields_warm) beams_.refresh_limits(model_);
  if (!demands_.changes_bonds()) return 0;
  Effects now = effects_now();
  const std::size_t blocks = model_.slots().blocks();
  std::vector<double> gained(blocks, 0.0);
  const BeamMotion columns = beams_.motion(model_);
  for_blocks(blocks, 40, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block)
      gained[block] = refresh_block(block, now, columns, adopts_new_bonds, time_step);
  });
  effects_ = std::move(now);
  double sum = 0;
  for (const double part : gained) sum += part;
  return 0.5 * sum;  // each bond was met from both of its ends
}

void BondTemperature::follow(Model& /*model*/, double time_step) {
  work_ += refresh(true, time_step);
  note_stiffness();
}

double BondTemperature::stiffening() const {
  return demands_.softening ? std::sqrt(demands_.softening->modulus_ratio.largest() / least_ratio_)
                            : 1;
}

void BondTemperature::note_stiffness() {
  const double stretched = demands_.expansion ? 1 + least_of(effects_.strain) : 1;
  stiffened_ = std::max(stiffened_, std::sqrt(largest_of(effects_.ratio) / least_ratio_ *
                                              largest_stretch_ / stretched));
}

void BondTemperature::observe(const Model& /*model*/, Observation& observation) const {
  if (demands_.changes_bonds())
    observation.energies.add(EnergyLedger::Kind::input, "thermal_work", work_);
}

void BondTemperature::state(Archive& archive) {
  archive(work_, stiffened_);
  if (!archive.is_reading()) return;
  // Bonds made since heat last stepped, which nothing has changed yet, the checkpoint has whole.
  effects_ = effects_now();
  refresh(false, 0);
}

namespace {

std::vector<Key> expansion_keys(ExpansionParameters& p, Reading& /*reading*/) {
  return {may_have("reference_temperature",
                   quantity(p.reference_temperature, dimension::temperature, not_negative))
              .means("at which the body is as large as its specimen")
              .without("`initial_temperature` of `[conduction]`")};
}

std::vector<Key> softening_keys(SofteningParameters& p, Reading& /*reading*/) {
  return {must_have("modulus_ratio", property(p.modulus_ratio, dimension::number, positive))
              .means("E at a temperature over that of `[beams]`; G and all stiffness with it")};
}

bool yields_warm(const Setup& setup) {
  const auto& plasticity = setup.get<PlasticityParameters>();
  return plasticity && follows_temperature(plasticity->hardening);
}

/// One effect serves both sections and yield laws; the one that comes first plans it.
void plan_bond_temperature(const Setup& setup, Plan& plan) {
  const BondTemperature::Demands demands{setup.get<ExpansionParameters>(),
                                         setup.get<SofteningParameters>(), yields_warm(setup)};
  std::string reason = demands.expansion ? "[expansion]" : "";
  if (demands.softening) reason += (reason.empty() ? "" : " ") + std::string("[softening]");
  if (demands.yields_warm) reason += (reason.empty() ? "" : " ") + std::string("[plasticity]");
  plan.effects.push_back(
      {"temperature of bonds", reason, "", Phase::heat, [demands](Assembly& assembly) {
         return std::make_unique<BondTemperature>(
             demands, ThermalProperties{assembly.setup.materials, assembly.material},
             assembly.setup.get<ConductionParameters>()->initial_temperature,
             assembly.need<Beams>(), assembly.model);
       }});
}

void plan_expansion(const Setup& setup, Plan& plan) {
  if (setup.get<ExpansionParameters>()) plan_bond_temperature(setup, plan);
}

void plan_softening(const Setup& setup, Plan& plan) {
  if ((setup.get<SofteningParameters>() || yields_warm(setup)) && !setup.get<ExpansionParameters>())
    plan_bond_temperature(setup, plan);
}

template <class Parameters>
EffectKind kind_of_warm_beams(const std::string& section, BindKeys<Parameters> keys) {
  EffectKind kind = single_kind<Parameters>(section, keys, as_read<Parameters>);
  kind.needs = Provides::heat;
  kind.beside = {"beams"};
  kind.problem_alone = "there are no beams";
  return kind;
}

}  // namespace

EffectKind expansion_kind() {
  EffectKind kind = kind_of_warm_beams<ExpansionParameters>("expansion", expansion_keys);
  kind.plan = plan_expansion;
  kind.explain = [values = kind.explain](const Setup& setup, const Specimen& specimen,
                                         nlohmann::ordered_json& json) {
    values(setup, specimen, json);
    if (setup.materials.size() == 1)
      json["expansion_coefficient"] = to_json(setup.materials[0].expansion_coefficient);
  };
  kind.example =
      "[expansion]\n"
      "reference_temperature = \"290 K\"\n";
  return kind;
}

EffectKind softening_kind() {
  EffectKind kind = kind_of_warm_beams<SofteningParameters>("softening", softening_keys);
  kind.plan = plan_softening;
  kind.explain = [](const Setup& setup, const Specimen& /*specimen*/,
                    nlohmann::ordered_json& json) {
    json["modulus_ratio"] = to_json(setup.get<SofteningParameters>()->modulus_ratio);
  };
  kind.example =
      "[softening]\n"
      "modulus_ratio = { temperature = [\"290 K\", \"700 K\"], value = [1, 0.5] }\n";
  return kind;
}

}  // namespace solidem
