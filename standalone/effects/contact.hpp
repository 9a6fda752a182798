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
  ElementContacts(const ContactParameters& parameters, const Beams& beams, Rupture& rupture,
                  Model& model);

  /// Pushes the elements that touch, in the poses and velocities that the bonds left.
  void advance(Model& model, const Step& step) override;
  /// Forces of the contacts, their energy and their number.
  void observe(const Model& model, Observation& observation) const override;
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  /// Contacts that take the places of bonds may be stiffer than these; root of the stiffness.
  double stiffening() const override;
  void state(Archive& archive) override;

 private:
  /// Two elements that touch or may soon.
  struct Candidate {
    Pair pair;
    double distance;   ///< at which they touch, m
    double stiffness;  ///< N/m
    double section;    ///< of the bond they had or would have, m²
    Vector shift;      ///< added to the chord across a periodic face, m

    void state(Archive& archive) { archive(pair, distance, stiffness, section, shift); }
  };
  Vector chord(const Candidate& candidate) const;
  /// Candidates among the elements as they stand in a buffer of poses.
  void search(const double* pose);
  bool must_search(const double* pose) const;
  void bond_anew(const Candidate& candidate);

  ContactParameters parameters_;
  const Beams& beams_;
  Rupture& rupture_;
  Model& model_;
  std::vector<Candidate> candidates_;  ///< sorted by pair
  std::map<Pair, double> nearer_;      ///< contact distance of pairs that were nearer when found
  std::vector<std::int32_t> surface_elements_;  ///< elements that lost a bond, sorted
  std::vector<Vector> searched_at_;             ///< where they stood when candidates were sought
  std::size_t broken_then_ = 0;                 ///< bonds broken by then
  std::size_t bonded_anew_ = 0;
  double skin_ = 0;  ///< m, by which candidates may be apart
};

}  // namespace solidem

#endif
