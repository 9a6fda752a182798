// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "effects/push.hpp"
#include "effects/removed_elements.hpp"
#include "effects/selections.hpp"
#include "effects/time_function_json.hpp"
#include "model/axis_names.hpp"
#include "model/blocks.hpp"
#include "model/error.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr double deepest_start = 0.25;         // of an element's radius: deeper is refused
constexpr std::size_t least_for_threads = 64;  // candidates, of which each looks at facets
constexpr std::size_t least_elements = 4097;   // of which each is looked at once

Vector centre_of(const Model& model, std::size_t element) {
  const double* row = model.positions()[element];
  return {row[0], row[1], row[2]};
}

/// The largest value of a function of elements, the same on any number of threads.
template <class Value>
double largest_of(std::size_t elements, const Value& value) {
  double largest = 0;
  std::mutex gathering;
  for_blocks(elements, least_elements, [&](std::size_t first, std::size_t last) {
    double mine = 0;
    for (std::size_t i = first; i < last; ++i) mine = std::max(mine, value(i));
    const std::lock_guard<std::mutex> lock(gathering);
    largest = std::max(largest, mine);
  });
  return largest;
}

double squared(const Vector& v) {
  return dot(v, v);
}

}  // namespace

Tool::Tool(std::string name, std::unique_ptr<RigidShape> shape, const RigidPose& start,
           const ToolMotion& motion, const ToolContact& contact, double stiffness,
           const Model& model)
    : name_(std::move(name)),
      shape_(std::move(shape)),
      start_(start),
      motion_(motion),
      contact_(contact),
      stiffness_(stiffness),
      tangential_stiffness_(contact.friction > 0 ? contact.tangential_ratio * stiffness : 0),
      damping_ratio_(restitution_damping_ratio(contact.restitution)),
      largest_inverse_mass_(largest_of(model.elements(), [of = model.data(columns::inverse_mass)](
                                                             std::size_t i) { return of[i]; })),
      radius_(model.specimen().radius),
      skin_(0.5 * mean_radius(model.specimen())),
      watch_(2 * mean_radius(model.specimen())) {
  fit_radii(model);
}

void Tool::fit_radii(const Model& model) {
  const Specimen& specimen = model.specimen();
  std::size_t deepest = 0, deep = 0;
  double most = 0;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double distance =
        shape_->distance(start_.to_body(specimen.position[i]), specimen.radius[i]);
    const double overlap = specimen.radius[i] - distance;
    if (overlap <= 0) continue;
    if (overlap > deepest_start * specimen.radius[i]) {
      ++deep;
      if (overlap > most) {
        most = overlap;
        deepest = i;
      }
      continue;
    }
    radius_[i] = distance;
    ++fitted_;
    deepest_fitted_ = std::max(deepest_fitted_, overlap);
  }
  if (deep == 0) return;
  throw InputError(fmt::format(
      "[[tools]] \"{}\" begins inside of the body: {} m deep in {}, the deepest of {} that it "
      "overlaps by more than a quarter of their radius; expected a tool that begins outside",
      name_, text(most), place(specimen, deepest), deep));
}

void Tool::move(double time) {
  displacement_ = motion_.drive ? travel_ * motion_.drive->axis : motion_.way(time);
  angle_ = motion_.angle(time);
}

void Tool::advance(Model& model, const Step& step) {
  const Pushes pushes(model, step);
  for (const Candidate& candidate : candidates_) {
    if (candidate.touches.empty()) continue;
    const auto i = static_cast<std::size_t>(candidate.element);
    pushes.push(i, candidate.force);
    if (pushes.can_twist()) pushes.twist(i, candidate.moment);
  }
  if (!motion_.drive) return;
  insist_on_stable_drive(step);
  const ToolDrive& drive = *motion_.drive;
  speed_ += step.kick / drive.mass * (drive.force(step.time) + dot(force_, drive.axis));
  travel_ += step.time_step * speed_;
}

void Tool::insist_on_stable_drive(const Step& step) const {
  std::size_t contacts = 0;
  for (const Candidate& candidate : candidates_) contacts += candidate.touches.size();
  const double squared_frequency =
      static_cast<double>(contacts) * stiffness_ * inverse_mass() + added_squared_frequency();
  if (squared_frequency * step.time_step * step.time_step < 4) return;
  throw RunError(fmt::format(
      "the run may not go on: at time {} s the tool {} of {} kg is held by {} contacts so stiffly "
      "that steps must stay below {} s, but are {} s; take a smaller time step, or a heavier tool",
      text(step.time), name_, text(motion_.drive->mass), contacts,
      text(2 / std::sqrt(squared_frequency)), text(step.time_step)));
}

double Tool::moved_since_search() const {
  return norm(displacement_ - listed_displacement_) +
         (motion_.turns() ? std::fabs(angle_ - listed_angle_) * listed_reach_ : 0);
}

Tool::Elements Tool::elements_of(Model& model) {
  const auto now = model.positions();
  // Places of the step before are in rows like those of now: where those are kept once others hold.
  const double* before = model.has(columns::last_pose) ? model.data(columns::last_pose)
                                                       : model.next(model.position_column());
  return {{now.first, now.components},
          {before, now.components},
          model.data(columns::velocity),
          model.has(columns::angular_velocity) ? model.data(columns::angular_velocity) : nullptr,
          model.data(columns::inverse_mass)};
}

bool Tool::must_search(const Elements& elements, std::size_t count) {
  if (!is_listed_) return true;
  const double of_tool = moved_since_search();
  const double left = skin_ - of_tool;
  if (left <= 0) return true;
  const auto has_moved = [&](std::size_t i) { return squared(elements.centre(i) - listed_at_[i]); };
  for (const std::int32_t i : watched_)
    if (has_moved(static_cast<std::size_t>(i)) > left * left) return true;
  // Those beyond come near in no fewer steps than this, short of a fifth of a radius in each.
  constexpr int seldom = 8;
  if (++steps_since_look_ % seldom != 0) return false;
  const double allowed = 0.5 * watch_ - of_tool;
  return largest_of(count, has_moved) > allowed * allowed;
}

void Tool::search(const Model& model) {
  const RigidPose now = pose();
  const std::size_t elements = model.elements();
  std::vector<double> gap(elements, std::numeric_limits<double>::infinity());
  listed_at_.resize(elements);
  const PresentElements is_present(model);
  for_blocks(elements, least_elements, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      listed_at_[i] = centre_of(model, i);
      const double reach = radius_[i] + skin_;
      if (!is_present(i)) continue;
      const double distance = shape_->distance(now.to_body(listed_at_[i]), reach + watch_);
      if (distance < reach + watch_) gap[i] = distance - radius_[i];
    }
  });
  std::vector<Candidate> before = std::move(candidates_);
  candidates_.clear();
  watched_.clear();
  auto old = before.begin();
  for (std::size_t i = 0; i < elements; ++i) {
    const auto element = static_cast<std::int32_t>(i);
    if (gap[i] < skin_ + watch_) watched_.push_back(element);
    while (old != before.end() && old->element < element) ++old;
    const bool is_known = old != before.end() && old->element == element;
    // What touches stays, wherever it went, to be told that it parted.
    if (is_known && !old->touches.empty()) {
      candidates_.push_back(std::move(*old));
      candidates_.back().gap = 0;
    } else if (gap[i] < skin_) {
      candidates_.emplace_back();
      candidates_.back().element = element;
      candidates_.back().gap = gap[i];
    }
  }
  listed_displacement_ = displacement_;
  listed_angle_ = angle_;
  if (motion_.turns()) {
    const Vector axis_point = motion_.rotation_point + displacement_;
    const double of_body = std::sqrt(largest_of(elements,
                                                [&](std::size_t i) {
                                                  const double far =
                                                      norm(listed_at_[i] - axis_point) + radius_[i];
                                                  return far * far;
                                                })) +
                           skin_;
    const double of_tool = norm(start_.position - motion_.rotation_point) + shape_->extent();
    listed_reach_ = std::min(of_body, of_tool);
  }
  is_listed_ = true;
  ++searches_;
}

Tool::Passer Tool::passer(const Elements& elements, std::size_t element, bool is_held,
                          double time_step) {
  const Vector centre = elements.centre(element);
  Passer at{{{}, {}, centre}, elements.inverse_mass[element], is_held};
  if (!is_held) {
    const std::size_t lane = Model::at(columns::velocity, element);
    at.passage.velocity = lanes_vector(elements.velocity, lane);
    if (elements.spin != nullptr) at.passage.angular_velocity = lanes_vector(elements.spin, lane);
    return at;
  }
  // What moves it is not in its velocity.
  const double *before = elements.position_before[element], *now = elements.position[element];
  at.passage.velocity = (1 / time_step) * (centre - Vector{before[0], before[1], before[2]});
  if (elements.spin != nullptr) {
    const Quaternion<double> turned =
        Quaternion<double>{now[4], {now[5], now[6], now[7]}} *
        conjugate(Quaternion<double>{before[4], {before[5], before[6], before[7]}});
    at.passage.angular_velocity = ((turned.w < 0 ? -2 : 2) / time_step) * turned.v;
  }
  return at;
}

LinearContact<double> Tool::contact_of(const Passer& passer) const {
  const double reduced = passer.inverse_mass + inverse_mass();
  return {stiffness_, tangential_stiffness_, contact_.friction,
          damping_coefficient(damping_ratio_, stiffness_, reduced),
          passer.is_held ? inverse_mass() : reduced};
}

void Tool::press(const Passer& passer, const SurfacePoint& place, const Passage& passage,
                 double time_step, const ContactHistory<double>& before,
                 Candidate& candidate) const {
  const Vector lever = place.position - passer.passage.point;
  const double overlap = radius_[static_cast<std::size_t>(candidate.element)] - place.distance;
  const ContactMotion<double> motion{
      place.normal, overlap,
      passer.passage.velocity_at(place.position) - passage.velocity_at(place.position),
      0.5 * dot(passage.angular_velocity + passer.passage.angular_velocity, place.normal),
      time_step};
  const ContactResponse<double> response = linear_contact(contact_of(passer), motion, before);
  candidate.force -= response.force;
  candidate.moment -= cross(lever, response.force);
  candidate.virial += virial_of_force(-response.force, lever);
  candidate.on_tool += cross(place.position - passage.point, response.force);
  candidate.friction += response.friction_work;
  candidate.damping += response.damping_work;
  if (overlap > 0)
    candidate.touches.push_back(
        {response.history, response.normal_energy + response.tangential_energy, overlap});
}

void Tool::meet(const Passer& passer, const RigidPose& pose, const Passage& passage,
                double time_step, Candidate& candidate) const {
  thread_local std::vector<Touch> before;
  before.clear();
  before.swap(candidate.touches);
  candidate.force = candidate.moment = candidate.on_tool = {};
  candidate.virial = {};
  candidate.friction = candidate.damping = 0;
  const Vector& centre = passer.passage.point;
  const double radius = radius_[static_cast<std::size_t>(candidate.element)];
  thread_local std::vector<SurfacePoint> found;
  found.clear();
  if (!(passer.inverse_mass > 0)) {
    // It was taken out of the body, and with it what its contacts stored.
    for (const Touch& lost : before) candidate.damping += lost.stored;
    return;
  }
  shape_->find_touching(pose.to_body(centre), radius, candidate.near, found);
  for (SurfacePoint& place : found) {
    place.position = pose.to_world(place.position);
    place.normal = rotate(pose.orientation, place.normal);
    // A contact goes on where its normal hardly turned, over whichever facets.
    constexpr double same = 0.5;  // cosine
    const auto likest =
        std::max_element(before.begin(), before.end(), [&](const Touch& a, const Touch& b) {
          return dot(a.history.normal, place.normal) < dot(b.history.normal, place.normal);
        });
    ContactHistory<double> history;
    if (likest != before.end() && dot(likest->history.normal, place.normal) > same) {
      history = likest->history;
      before.erase(likest);
    }
    press(passer, place, passage, time_step, history, candidate);
  }
  for (const Touch& parted : before)
    press(passer, {centre - radius * parted.history.normal, parted.history.normal, radius}, passage,
          time_step, parted.history, candidate);
}

void Tool::look(Model& model, const Step& step, const std::vector<char>& imposed) {
  const double time = step.time + step.time_step, per_step = 1 / step.time_step;
  const Vector displacement_before = displacement_, force_before = force_, torque_before = torque_;
  const double angle_before = angle_;
  move(time);
  const Vector way = displacement_ - displacement_before;
  const double turned = angle_ - angle_before;
  const Passage passage{per_step * way, (per_step * turned) * motion_.rotation_axis,
                        motion_.rotation_point + displacement_};
  const Elements elements = elements_of(model);
  if (must_search(elements, model.elements())) search(model);
  const RigidPose now = pose();
  const double of_tool = moved_since_search();
  const auto meet_one = [&](Candidate& candidate) {
    const auto i = static_cast<std::size_t>(candidate.element);
    const double left = candidate.gap - of_tool;
    const bool is_apart = candidate.touches.empty() && left > 0 &&
                          squared(elements.centre(i) - listed_at_[i]) < left * left;
    candidate.friction = candidate.damping = 0;
    if (is_apart) return;
    meet(passer(elements, i, imposed[i] != 0, step.time_step), now, passage, step.time_step,
         candidate);
  };
  for_blocks(candidates_.size(), least_for_threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) meet_one(candidates_[k]);
  });
  force_ = torque_ = {};
  stored_ = 0;
  for (const Candidate& candidate : candidates_) {
    force_ -= candidate.force;
    torque_ += candidate.on_tool;
    friction_ += candidate.friction;
    damping_ += candidate.damping;
    for (const Touch& touch : candidate.touches) stored_ += touch.stored;
  }
  if (contact_heat_ != nullptr) share_heat(model);
  work_ -= 0.5 * turned * dot(torque_before + torque_, motion_.rotation_axis);
  if (motion_.drive)
    work_ += 0.5 * (motion_.drive->force(step.time) + motion_.drive->force(time)) *
             dot(way, motion_.drive->axis);
  else
    work_ -= 0.5 * dot(force_before + force_, way);
}

void Tool::share_heat(Model& model) {
  double* of_elements = model.data(columns::friction_heat);
  for (const Candidate& candidate : candidates_) {
    const double heat = contact_heat_->of(candidate.friction, candidate.damping);
    const double share = contact_heat_->share(candidate.element, contact_.effusivity);
    of_elements[candidate.element] += share * heat;
    heat_ += (1 - share) * heat;
  }
}

void Tool::observe(const Model& model, Observation& observation) const {
  const bool turns = model.has(columns::angular_velocity);
  for (const Candidate& candidate : candidates_) {
    if (candidate.touches.empty()) continue;
    observe_push(model, observation, candidate.element, candidate.force);
    if (turns) observe_twist(model, observation, candidate.element, candidate.moment);
  }
  Vector velocity = motion_.velocity(observation.time);
  if (motion_.drive) {
    const ToolDrive& drive = *motion_.drive;
    const double force = drive.force(observation.time) + dot(force_, drive.axis);
    const double speed = speed_ + observation.behind * force / drive.mass;
    velocity = speed * drive.axis;
    observation.motion.kinetic_energy += 0.5 * drive.mass * speed * speed;
    observation.motion.squared_impulse += 0.5 * force * force / drive.mass;
  }
  using Kind = EnergyLedger::Kind;
  observation.energies.add(Kind::stored, "contact_energy", stored_);
  observation.energies.add(Kind::dissipated, "friction", friction_);
  observation.energies.add(Kind::dissipated, "contact_damping", damping_);
  observation.energies.add(Kind::input, "external_work", work_);
  const double rate = motion_.angular_velocity(observation.time);
  const auto add = [&](const std::string& what, double value) {
    observation.add("tool." + name_ + "." + what, value);
  };
  for (int k = 0; k < 3; ++k) add(std::string("force_") + axis_names[k], component(force_, k));
  for (int k = 0; k < 3; ++k) add(std::string("torque_") + axis_names[k], component(torque_, k));
  add("power", -dot(force_, velocity) - rate * dot(torque_, motion_.rotation_axis));
  for (int k = 0; k < 3; ++k)
    add(std::string("displacement_") + axis_names[k], component(displacement_, k));
  if (motion_.turns()) add("angle", angle_);
  if (contact_heat_ != nullptr) add("heat", heat_);
}

double Tool::stiffness_over_mass() const {
  // A sphere that is pushed aside at its surface turns as well: 1/m + R²/J is 3.5/m.
  return std::max(stiffness_, 3.5 * tangential_stiffness_) *
         (largest_inverse_mass_ + inverse_mass());
}

std::vector<TimeStepCriterion> Tool::time_step_criteria(const Model& /*model*/) const {
  return {{"contact with the tool " + name_, 1 / std::sqrt(stiffness_over_mass())}};
}

double Tool::added_squared_frequency() const {
  return shape_->most_contacts() * stiffness_over_mass();
}

void Tool::state(Archive& archive) {
  std::vector<Candidate> touching;
  for (const Candidate& candidate : candidates_)
    if (!candidate.touches.empty()) touching.push_back(candidate);
  archive(touching, displacement_, angle_, travel_, speed_, force_, torque_, stored_, friction_,
          damping_, work_);
  if (contact_heat_ != nullptr) archive(heat_);
  if (!archive.is_reading()) return;
  candidates_ = std::move(touching);
  is_listed_ = false;
}

TriangleMesh Tool::surface(const Model& model) const {
  const Domain& domain = model.specimen().domain;
  TriangleMesh mesh = shape_->drawn(norm(domain.upper - domain.lower));
  const RigidPose now = pose();
  for (Vector& vertex : mesh.vertices) vertex = now.to_world(vertex);
  return mesh;
}

void Tool::show(const Model& model, Frame& frame) const {
  TriangleMesh mesh = surface(model);
  frame.add({name_, std::move(mesh.vertices), std::move(mesh.facets)});
}

Summary Tool::explanation() const {
  const auto triple = [](const Vector& v) { return Summary{v.x, v.y, v.z}; };
  Summary told{{"name", name_},
               {"shape", shape_->name()},
               {"origin", triple(start_.position)},
               {"axis", triple(rotate(start_.orientation, Vector{0, 0, 1}))},
               {"stiffness", stiffness_},
               {"tangential_stiffness", tangential_stiffness_},
               {"friction", contact_.friction},
               {"restitution", contact_.restitution},
               {"damping_ratio", damping_ratio_},
               {"effusivity", contact_.effusivity},
               {"motion", motion_.drive     ? "force"
                          : motion_.is_path ? "path"
                                            : "velocity"},
               {"angular_velocity", to_json(motion_.angular_velocity)},
               {"rotation_axis", triple(motion_.rotation_axis)},
               {"rotation_point", triple(motion_.rotation_point)},
               {"elements_that_overlap_at_the_start", fitted_},
               {"deepest_overlap_at_the_start", deepest_fitted_}};
  if (contact_.temperature) told["temperature"] = to_json(*contact_.temperature);
  for (const TimeFunction& along : motion_.along) told["along"].push_back(to_json(along));
  return told;
}

void Tool::summarise(const Model& /*model*/, Summary& summary) const {
  summary["tools"][name_] = {{"stiffness", stiffness_},
                             {"work", work_},
                             {"searches", searches_},
                             {"elements_that_overlapped_at_the_start", fitted_},
                             {"deepest_overlap_at_the_start", deepest_fitted_}};
}

void Tool::for_each_touched(const Visit& visit) const {
  for (const Candidate& candidate : candidates_)
    if (!candidate.touches.empty()) visit(candidate.element, candidate.virial);
}

std::vector<std::int32_t> Tool::touched() const {
  std::vector<std::int32_t> elements;
  for (const Candidate& candidate : candidates_)
    if (!candidate.touches.empty()) elements.push_back(candidate.element);
  return elements;
}

}  // namespace solidem
