// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONTACT_HPP
#define SOLIDEM_EFFECTS_CONTACT_HPP

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/contact_heat.hpp"
#include "effects/contact_law.hpp"
#include "effects/contact_list.hpp"
#include "effects/grips.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/pair_loads.hpp"
#include "effects/rupture.hpp"
#include "laws/linear_contact.hpp"
#include "model/buffer.hpp"

namespace solidem {

/// Elements that no bond joins push each other when they touch, and rub: laws/linear_contact.hpp.
///
/// Forces are found once elements have moved, at the poses and with the velocities that hold then,
/// and act in the step that follows. Elements are looked at that something can reach: those at free
/// surfaces, those that have lost a bond, and all that have none. While they are apart nothing is
/// sought (effects/contact_list.hpp).
///
/// Two elements touch where their spheres meet; if their bond broke, where laws/contact.hpp says;
/// and if they stood nearer when both could be reached for the first time, where they stood:
/// nothing is thrown apart by being looked at. Above a pressure they are bonded anew, free of load.
class ElementContacts : public Effect, public ActsBetweenElements {
 public:
  /// `rebonding_strain`: of a contact that becomes a bond; 0: none does. Beams and rupture: null
  /// where elements have no bonds, or none breaks.
  ElementContacts(const ContactParameters& parameters, const ContactLaw& law,
                  double rebonding_strain, const Beams* beams, Rupture* rupture, Model& model);

  /// Tells which elements are held, once it is known: their velocities stand in no column.
  void follow(const std::vector<Grip*>& grips);
  /// From now on what contacts lose is entered as heat of their elements (columns::friction_heat).
  void warm(const ContactHeat& heat) { heat_ = &heat; }

  /// Finds who touches at the start. Throws InputError where elements overlap that may not.
  void start(const Model& model, double duration) override;
  /// Pushes the elements that touch, and bonds anew.
  void advance(Model& model, const Step& step) override;
  /// Calls visit(pair, overlap) for each contact that acts, in the order of their pairs; m.
  template <class Visit>
  void for_each_acting(const Visit& visit) const {
    for (std::size_t k = 0; k < list_.candidates().size(); ++k)
      if (acts_[k] != 0) visit(list_.candidates().pair(k), overlap(k));
  }
  /// Those at the poses that were last looked at, friction too.
  void for_each_pair(const Model& model, const PairVisit& visit) const override;
  bool lets_elements_meet() const override { return true; }
  /// Looks at the poses that a step has led to.
  void look(const Step& step);
  /// Forces of the contacts, their energy and their number.
  void observe(const Model& model, Observation& observation) const override;
  double spent(const Model& /*model*/) const override { return friction_ + damped_; }
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  /// The longest stable time step of two equal elements that touch, s; infinite where they are as
  /// stiff as bonds.
  double longest_time_step() const;
  /// Contacts that take the places of bonds may be stiffer than these; root of the stiffness.
  double stiffening() const override;
  double stiffened() const override;
  void state(Archive& archive) override;

 private:
  /// What a contact did when it was last looked at: all zero where it does not act. One line of
  /// memory, which both elements read.
  struct alignas(64) Load {
    Vector force{};    ///< on i, N
    double arm_i = 0;  ///< of the contact from the centre of i, m
    Vector moment{};   ///< of the force about the contact a metre on along the chord, N
    double arm_j = 0;  ///< of the contact from the centre of j, m

    void state(Archive& archive) { archive(force, moment, arm_i, arm_j); }
  };
  struct alignas(64) History : ContactHistory<double> {
    void state(Archive& archive) { archive(normal, spring, dashpot); }
  };
  static_assert(sizeof(Load) == 8 * sizeof(double) && sizeof(History) == 8 * sizeof(double),
                "kernels read and write rows of eight");

  // Who touches where.
  void list_contacts();
  ContactCandidate candidate(Pair pair, const Vector& chord, bool is_reached_now);
  double stiffness(Pair pair, const Vector& chord) const;
  double damping(Pair pair, double stiffness) const;
  double section(Pair pair, const Vector& chord) const;
  const BrokenBond* broken_bond(Pair pair) const;
  void refuse_overlaps() const;

  // Forces.
  double inverse_mass(const double* column, std::int32_t element) const;
  /// Gives an element along the axes that a grip moves the velocity between its last two poses.
  void impose(double time_step, std::int32_t element);
  /// Lays the rows out that contacts read, a line of memory for each element: of all in the list,
  /// or of those whose pairs are picked where these are few.
  void fill_rows(double time_step, std::size_t picks);
  /// Calls visit(k) for the candidates that were picked last.
  template <class Visit>
  void for_each_pick(const Visit& visit) const;
  void find_forces(double time_step);
  ContactColumns kernel_columns(double time_step, ContactSums* sums);
  /// Force and moment on i; on j the force is opposite.
  BeamLoad<double> load(std::size_t k) const;
  /// What contacts do to their elements.
  ContactSides sides() const;
  /// Of a contact that acts, when it was last looked at, m.
  double overlap(std::size_t k) const {
    return list_.candidates()[k].distance - (load_[k].arm_i + load_[k].arm_j);
  }
  void push_elements(Model& model, const Step& step);
  double stored(std::size_t k) const;
  void observe_loads(const Model& model, Observation& observation) const;
  /// Enters what contacts lost in a step as heat of their elements.
  void warm_elements();

  // Bonds.
  void follow_ruptures();
  void take_over(const BrokenBond& bond);
  void lose_contact(std::size_t k);
  void bond_anew(std::size_t k);

  // Time step.
  /// Stiffness of a contact over its k_n with which elements that also rub and turn vibrate.
  double stiffness_with_friction() const;
  std::vector<double> stiffness_of_bonds() const;
  void add_stiffness(std::vector<double>& sums, Pair pair, double stiffness) const;
  double largest_over_mass(const std::vector<double>& sums) const;
  double present_stiffness() const;

  ContactParameters parameters_;
  ContactLaw law_;
  double rebonding_strain_;
  double damping_ratio_;  ///< ζ
  const Beams* beams_;
  Rupture* rupture_;
  Model& model_;
  bool has_rotation_;
  ContactList list_;
  std::vector<History> history_;       ///< of each candidate of the list
  std::vector<Load> load_;             ///< likewise
  std::vector<char> acts_;             ///< likewise: 1 where it touches; with lanes more
  std::vector<std::uint32_t> picked_;  ///< in blocks, candidates that are looked at closely
  std::vector<std::size_t> picks_;     ///< of each block how many
  Buffer<double> rows_;
  std::map<Pair, double> nearer_;       ///< contact distance of pairs that were nearer when found
  std::map<Pair, std::size_t> broken_;  ///< the last of the broken bonds between two elements
  std::size_t broken_seen_ = 0, removed_seen_ = 0;  ///< bonds and elements, by now
  std::size_t bonded_anew_ = 0, acting_ = 0;
  double friction_ = 0, damped_ = 0;   ///< dissipated since the start, J
  const ContactHeat* heat_ = nullptr;  ///< null: contacts make none
  std::vector<double> lost_;       ///< of each candidate in the last step, as heat, J; with that
  std::vector<char> imposed_;      ///< axes along which a grip moves an element; empty: none
  std::vector<double> bonded_;     ///< sum of E S / l of the bonds of each element, N/m
  double stiffness_at_start_ = 0;  ///< of an element, over its mass, 1/s²
  double largest_stiffness_ = 0;   ///< that was met, likewise
};

}  // namespace solidem

#endif
