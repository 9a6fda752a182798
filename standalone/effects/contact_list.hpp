// SPDX-License-Identifier: GPL-2.0-or-later
//
// Who may touch whom: a Verlet list of the elements that something can reach. Neighbours are sought
// anew when one of them has moved half the skin; in between nothing is sought.
#ifndef SOLIDEM_EFFECTS_CONTACT_LIST_HPP
#define SOLIDEM_EFFECTS_CONTACT_LIST_HPP

#include <algorithm>
#include <cstdint>
#include <vector>

#include "effects/contact_candidates.hpp"
#include "effects/kernels/kernels.hpp"
#include "model/model.hpp"

namespace solidem {

class ContactList {
 public:
  /// Of a body whose elements are where the specimen says.
  explicit ContactList(const Model& model);

  /// Elements that can be reached, ascending.
  const std::vector<std::int32_t>& elements() const { return elements_; }
  /// Elements to add, or to take away, when the list is made anew, which it must be now; what was
  /// not there or is already does no harm.
  void expose(const std::vector<std::int32_t>& more);
  void withdraw(const std::vector<std::int32_t>& fewer);
  /// Whether an element can be reached since the list was last made.
  bool is_new(std::int32_t element) const;

  const ContactCandidates& candidates() const { return candidates_; }
  /// From the first to the second of a candidate, as they stand now, and in these poses.
  Vector chord(const ContactCandidate& candidate) const {
    return chord(model_.data(columns::pose), candidate);
  }
  Vector chord(const double* pose, const ContactCandidate& candidate) const {
    const Vector to = position(pose, candidate.pair.j) - position(pose, candidate.pair.i);
    return periodic_ ? to + image_shift(model_.specimen().domain, candidate.image) : to;
  }

  /// Whether the list must be made anew for the present poses.
  bool is_outdated();
  /// Whether the elements may have come so near since the list was made that some touch.
  bool may_touch() const { return !(2 * moved_ < clearance_); }
  /// Makes the list anew. `make(pair, chord, is_new)` gives what a candidate is that was none
  /// before; carry(k): where one stood that still is. Pairs that are bonded are none.
  template <class Make, class Carry>
  void renew(const Make& make, const Carry& carry);
  /// Asks for that at the next look.
  void outdate() { outdated_ = true; }

  /// Calls visit(side) for the candidates of the k-th of the elements, in their order.
  template <class Visit>
  void for_each_side(std::size_t k, const Visit& visit) const {
    for (std::uint32_t n = first_side_[k]; n < first_side_[k + 1]; ++n) visit(sides_[n]);
  }
  /// All of them: those of the k-th stand from first_side()[k] to first_side()[k + 1].
  const std::uint32_t* first_side() const { return first_side_.data(); }
  const ContactSide* sides() const { return sides_.data(); }

  void state(Archive& archive);

 private:
  void come_and_go();
  /// Pairs within reach, sorted, with nothing known of them but pair and image.
  std::vector<ContactCandidate> find_pairs();
  void list_sides();
  static Vector position(const double* pose, std::int32_t element) {
    const double* row = pose + std::ptrdiff_t{8} * element;
    return {row[0], row[1], row[2]};
  }

  const Model& model_;
  bool periodic_;
  double skin_;                               ///< m, by which candidates may be apart
  std::vector<std::int32_t> elements_;        ///< ascending
  std::vector<std::int32_t> new_;             ///< of these, those that the list is made with first
  std::vector<std::int32_t> coming_, going_;  ///< when it is made anew
  std::vector<Vector> listed_at_;             ///< where they stood when it was made
  ContactCandidates candidates_;
  std::vector<std::uint32_t> first_side_{0};
  std::vector<ContactSide> sides_;
  bool outdated_ = true;
  double clearance_ = 0;  ///< by which the nearest of them were apart when it was made, m
  double moved_ = 0;      ///< since then, the farthest, m
};

template <class Make, class Carry>
void ContactList::renew(const Make& make, const Carry& carry) {
  come_and_go();
  std::vector<ContactCandidate> now = find_pairs();
  const ContactCandidates& then = candidates_;
  const double* pose = model_.data(columns::pose);
  clearance_ = skin_;
  for (std::size_t k = 0, before = 0; k < now.size(); ++k) {
    while (before < then.size() && stands_before(then[before], now[k])) ++before;
    const Vector to = chord(pose, now[k]);
    if (before < then.size() && !stands_before(now[k], then[before])) {
      now[k] = then[before];
      carry(before);
    } else {
      const Image image = now[k].image;
      now[k] = make(now[k].pair, to, is_new(now[k].pair.i) || is_new(now[k].pair.j));
      now[k].image = image;
    }
    clearance_ = std::min(clearance_, norm(to) - now[k].distance);
  }
  candidates_ = ContactCandidates(model_.specimen().domain, now);
  new_.clear();
  outdated_ = false;
  moved_ = 0;
  list_sides();
}

}  // namespace solidem

#endif
