// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONTACT_HPP
#define SOLIDEM_EFFECTS_CONTACT_HPP

#include <cstdint>
#include <map>
#include <vector>

#include "effects/rupture.hpp"

namespace solidem {

/// Elements that lost bonds push each other when they touch: laws/contact.hpp. Where no bond has
/// broken nothing is looked for.
///
/// Two elements touch where their spheres meet; if their bond broke, where laws/contact.hpp says;
/// and if they stood nearer when both had lost a bond for the first time, where they stood: nothing
/// is thrown apart by being looked at. Above a pressure they are bonded anew, free of load.
class ElementContacts : public Effect {
 public:
  /// `rebonding_strain`: of a contact that becomes a bond; 0: none does.
  ElementContacts(const ContactParameters& parameters, double rebonding_strain, const Beams& beams,
                  Rupture& rupture, Model& model);

  /// Pushes the elements that touch, in the poses and velocities that the bonds left.
  void advance(Model& model, const Step& step) override;
  /// Forces of the contacts, their energy and their number.
  void observe(const Model& model, Observation& observation) const override;
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  /// Contacts that take the places of bonds may be stiffer than these; root of the stiffness.
  double stiffening() const override;
  double stiffened() const override;
  void state(Archive& archive) override;

 private:
  /// Two elements that touch or may soon.
  struct Candidate {
    Pair pair;
    double distance;   ///< at which they touch, m
    double stiffness;  ///< N/m
    double section;    ///< of the bond they had or would have, m²
    Vector shift;      ///< added to the chord across a periodic face, m
    bool is_new;       ///< found in the last step: if nearer now, it touches where it stands

    void state(Archive& archive) { archive(pair, distance, stiffness, section, shift, is_new); }
  };
  Vector chord(const Candidate& candidate) const;
  /// Whether the two push each other, with this chord.
  static bool is_pressed(const Candidate& candidate, const Vector& chord);
  /// Candidates among the elements as they stand in a buffer of poses.
  void search(const double* pose);
  bool must_search(const double* pose) const;
  void bond_anew(const Candidate& candidate);
  /// Lets candidates that were found in the last step touch no farther than where they stand.
  void settle_new();
  /// Enters what a contact holds as lost in this step (sign 1) or as taken over (−1).
  void hand_over(const Candidate& candidate, double sign);
  /// Looks how stiffly elements are held by now, by bonds and by contacts that press.
  void measure_stiffness();
  void add_stiffness(std::vector<double>& sums, const Pair& pair, double stiffness) const;
  double largest_over_mass(const std::vector<double>& sums) const;

  ContactParameters parameters_;
  double rebonding_strain_;
  const Beams& beams_;
  Rupture& rupture_;
  Model& model_;
  std::vector<Candidate> candidates_;  ///< sorted by pair
  std::map<Pair, double> nearer_;      ///< contact distance of pairs that were nearer when found
  std::vector<std::int32_t> surface_elements_;  ///< elements that lost a bond, sorted
  std::vector<Vector> searched_at_;             ///< where they stood when candidates were sought
  std::size_t broken_then_ = 0;                 ///< bonds broken by then
  std::size_t bonded_anew_ = 0;
  double skin_ = 0;             ///< m, by which candidates may be apart
  std::vector<double> bonded_;  ///< sum of E S / l of the bonds of each element, N/m
  std::size_t subtracted_ = 0;  ///< broken bonds that are taken from it
  double stiffness_at_start_ = 0, largest_stiffness_ = 0;  ///< of an element, over its mass, 1/s²
};

}  // namespace solidem

#endif
