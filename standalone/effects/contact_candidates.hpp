// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONTACT_CANDIDATES_HPP
#define SOLIDEM_EFFECTS_CONTACT_CANDIDATES_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "model/archive.hpp"
#include "model/columns.hpp"
#include "model/slots.hpp"
#include "neighbours/neighbourhood.hpp"

namespace solidem {

/// Two elements that touch or may soon.
struct ContactCandidate {
  Pair pair{0, 0};
  Image image;           ///< of the second, that is meant
  double distance = 0;   ///< at which they touch, m
  double stiffness = 0;  ///< k_n, N/m
  double damping = 0;    ///< c_n, N·s/m

  void state(Archive& archive) {
    std::int64_t code = image.code();
    archive(pair, code, distance, stiffness, damping);
    image = Image::of_code(static_cast<std::uint32_t>(code));
  }
};

inline bool stands_before(const ContactCandidate& a, const ContactCandidate& b) {
  return a.pair < b.pair || (a.pair == b.pair && a.image < b.image);
}

/// Candidates in columns, as kernels read them: `lanes` more than there are, which touch nothing.
class ContactCandidates {
 public:
  ContactCandidates() = default;
  ContactCandidates(const Domain& domain, const std::vector<ContactCandidate>& all)
      : size_(all.size()) {
    for (auto* column : {&i_, &j_}) column->resize(size_ + lanes);
    for (auto* column : {&distance_, &stiffness_, &damping_}) column->resize(size_ + lanes);
    const bool periodic = domain.is_periodic();
    if (periodic) image_.resize(size_);
    if (periodic)
      for (auto& column : shift_) column.resize(size_ + lanes);
    for (std::size_t k = 0; k < size_; ++k) {
      i_[k] = all[k].pair.i;
      j_[k] = all[k].pair.j;
      distance_[k] = all[k].distance;
      stiffness_[k] = all[k].stiffness;
      damping_[k] = all[k].damping;
      if (!periodic) continue;
      image_[k] = all[k].image;
      const Vector shift = image_shift(domain, image_[k]);
      for (int axis = 0; axis < 3; ++axis)
        shift_[static_cast<std::size_t>(axis)][k] = component(shift, axis);
    }
  }

  std::size_t size() const { return size_; }
  Pair pair(std::size_t k) const { return {i_[k], j_[k]}; }
  ContactCandidate operator[](std::size_t k) const {
    return {pair(k), image_.empty() ? Image{} : image_[k], distance_[k], stiffness_[k],
            damping_[k]};
  }
  std::vector<ContactCandidate> all() const {
    std::vector<ContactCandidate> all;
    all.reserve(size_);
    for (std::size_t k = 0; k < size_; ++k) all.push_back((*this)[k]);
    return all;
  }

  // The columns.
  const std::int32_t* element_i() const { return i_.data(); }
  const std::int32_t* element_j() const { return j_.data(); }
  const double* distance() const { return distance_.data(); }
  const double* stiffness() const { return stiffness_.data(); }
  const double* damping() const { return damping_.data(); }
  /// From the second to its image along an axis, m; null where nothing is periodic.
  const double* shift(std::size_t axis) const {
    return shift_[axis].empty() ? nullptr : shift_[axis].data();
  }

 private:
  std::size_t size_ = 0;
  std::vector<std::int32_t> i_, j_;
  std::vector<Image> image_;
  std::vector<double> distance_, stiffness_, damping_;
  std::array<std::vector<double>, 3> shift_;
};

}  // namespace solidem

#endif
