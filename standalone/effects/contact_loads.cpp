// SPDX-License-Identifier: GPL-2.0-or-later
//
// What contacts do in each step: kernels find their loads, sum them and move elements by them.
#include <algorithm>
#include <numeric>

#include "effects/contact.hpp"
#include "effects/push.hpp"
#include "model/blocks.hpp"

namespace solidem {

namespace {

constexpr std::size_t elements_a_block = 256;

/// Where the elements stood before they moved.
const double* poses_before(Model& model) {
  return model.has(columns::last_pose) ? model.data(columns::last_pose) : model.next(columns::pose);
}

}  // namespace

void ElementContacts::impose(double time_step, std::int32_t element) {
  const auto i = static_cast<std::size_t>(element);
  if (imposed_[i] == 0) return;
  const double *pose = model_.data(columns::pose), *before = poses_before(model_);
  double* row = rows_.data() + 8 * i;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if ((imposed_[i] >> axis & 1) != 0 && time_step > 0)
      row[axis] = (pose[8 * i + axis] - before[8 * i + axis]) / time_step;
  row[3] = inverse_mass(model_.data(columns::inverse_mass), element);
}

void ElementContacts::fill_rows(double time_step, std::size_t picks) {
  if (rows_.size() == 0) rows_ = Buffer<double>(8 * model_.elements());
  const MotionRows motion{model_.data(columns::velocity),
                          has_rotation_ ? model_.data(columns::angular_velocity) : nullptr,
                          model_.data(columns::inverse_mass), model_.specimen().radius.data(),
                          rows_.data()};
  const auto fill = [&](const std::int32_t* element, std::size_t count) {
    kernels().lay_out_motion(motion, element, count);
    if (imposed_.empty()) return;
    for (std::size_t n = 0; n < count; ++n) impose(time_step, element[n]);
  };
  const std::vector<std::int32_t>& elements = list_.elements();
  if (picks < elements.size() / 4) {
    for_each_pick([&](std::size_t k) {
      const Pair pair = list_.candidates().pair(k);
      fill(&pair.i, 1);
      fill(&pair.j, 1);
    });
    return;
  }
  for_blocks(elements.size() / elements_a_block + 1, 8, [&](std::size_t first, std::size_t last) {
    const std::size_t from = std::min(elements.size(), first * elements_a_block),
                      to = std::min(elements.size(), last * elements_a_block);
    fill(elements.data() + from, to - from);
  });
}

template <class Visit>
void ElementContacts::for_each_pick(const Visit& visit) const {
  for (std::size_t block = 0; block < picks_.size(); ++block)
    for (std::size_t n = 0; n < picks_[block]; ++n)
      visit(picked_[block * ContactColumns::pairs_a_block + n]);
}

ContactColumns ElementContacts::kernel_columns(double time_step, ContactSums* sums) {
  const ContactCandidates& all = list_.candidates();
  ContactColumns c{};
  c.pairs = all.size();
  c.element_i = all.element_i();
  c.element_j = all.element_j();
  c.distance = all.distance();
  c.stiffness = all.stiffness();
  c.damping = all.damping();
  c.shift_x = all.shift(0);
  c.shift_y = all.shift(1);
  c.shift_z = all.shift(2);
  c.pose = model_.data(columns::pose);
  c.tangential_stiffness_ratio = law_.tangential_stiffness_ratio;
  c.friction = law_.friction;
  c.time_step = time_step;
  c.history = reinterpret_cast<double*>(history_.data());
  c.load = reinterpret_cast<double*>(load_.data());
  c.acts = acts_.data();
  if (heat_ != nullptr) {
    c.heat_of_friction = heat_->of(1, 0);
    c.heat_of_damping = heat_->of(0, 1);
  }
  c.picked = picked_.data();
  c.picks = picks_.data();
  c.sums = sums;
  return c;
}

void ElementContacts::find_forces(double time_step) {
  const std::size_t pairs = list_.candidates().size(),
                    blocks = pairs / ContactColumns::pairs_a_block + 1;
  picked_.resize(pairs);
  picks_.resize(blocks);
  std::vector<ContactSums> parts(blocks);
  ContactColumns columns = kernel_columns(time_step, parts.data());
  for_blocks(blocks, 4, [&](std::size_t first, std::size_t last) {
    kernels().pick_contacts(columns, first, last);
  });
  acting_ = 0;
  const std::size_t picks = std::accumulate(picks_.begin(), picks_.end(), std::size_t{0});
  if (picks == 0) return;
  fill_rows(time_step, picks);
  columns.motion = rows_.data();
  if (heat_ != nullptr) lost_.assign(pairs, 0.0);
  columns.heat = heat_ != nullptr ? lost_.data() : nullptr;
  for_blocks(blocks, 4, [&](std::size_t first, std::size_t last) {
    kernels().find_contact_loads(columns, first, last);
  });
  for (const ContactSums& part : parts) {
    friction_ += part.friction;
    damped_ += part.damped;
    acting_ += part.acting;
  }
  if (heat_ != nullptr) warm_elements();
}

void ElementContacts::warm_elements() {
  double* heat = model_.data(columns::friction_heat);
  const std::vector<std::int32_t>& elements = list_.elements();
  for_blocks(elements.size() / elements_a_block + 1, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first * elements_a_block;
         n < std::min(elements.size(), last * elements_a_block); ++n) {
      const std::int32_t element = elements[n];
      list_.for_each_side(n, [&](const ContactSide& side) {
        const Pair pair = list_.candidates().pair(side.pair);
        heat[element] += heat_->share(element, side.is_first ? pair.j : pair.i) * lost_[side.pair];
      });
    }
  });
}

ContactSides ElementContacts::sides() const {
  return {list_.elements().data(), list_.first_side(), list_.sides(),
          reinterpret_cast<const double*>(load_.data()), acts_.data()};
}

void ElementContacts::push_elements(Model& model, const Step& step) {
  PushedElements pushed{};
  pushed.pose = model.data(columns::pose);
  pushed.next_pose = model.next(columns::pose);
  pushed.velocity = model.data(columns::velocity);
  pushed.inverse_mass = model.data(columns::inverse_mass);
  if (has_rotation_) {
    pushed.angular_velocity = model.data(columns::angular_velocity);
    pushed.inverse_inertia = model.data(columns::inverse_inertia);
  }
  pushed.kick = step.kick;
  pushed.time_step = step.time_step;
  const ContactSides sides = this->sides();
  const std::size_t count = list_.elements().size();
  for_blocks(count / elements_a_block + 1, 8, [&](std::size_t block, std::size_t end) {
    alignas(64) double sums[8 * elements_a_block];
    std::int32_t elements[elements_a_block];
    for (; block < end; ++block) {
      const std::size_t first = block * elements_a_block,
                        last = std::min(count, first + elements_a_block);
      PushedElements some = pushed;
      some.element = elements;
      some.load = sums;
      some.count = kernels().sum_contact_loads(sides, first, last, elements, sums);
      kernels().push(some);
    }
  });
}

void ElementContacts::observe_loads(const Model& model, Observation& observation) const {
  const std::size_t all = list_.elements().size();
  std::vector<std::int32_t> elements(all);
  std::vector<double> sums(8 * all);
  const std::size_t count =
      kernels().sum_contact_loads(sides(), 0, all, elements.data(), sums.data());
  for (std::size_t n = 0; n < count; ++n) {
    const double* load = sums.data() + 8 * n;
    observe_push(model, observation, elements[n], {load[0], load[1], load[2]});
    if (has_rotation_) observe_twist(model, observation, elements[n], {load[4], load[5], load[6]});
  }
}

}  // namespace solidem
