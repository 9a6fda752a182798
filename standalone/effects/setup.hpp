// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_SETUP_HPP
#define SOLIDEM_EFFECTS_SETUP_HPP

#include <any>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <typeindex>
#include <vector>

#include "model/gauge.hpp"
#include "model/material.hpp"

namespace solidem {

/// A quantity followed at a point.
struct Sensor {
  /// Of the nearest element, or from a linear fit through the elements round the point.
  enum class Sampling { nearest, fit };
  enum class Quantity { temperature, position, displacement, velocity };
  std::string name;
  Vector point;  ///< m
  Quantity quantity = Quantity::temperature;
  Sampling sampling = Sampling::nearest;
};

/// How long to run and how finely. One of `duration` and `steps` is given; of `time_step` and
/// `time_step_ratio` at most one.
struct RunControl {
  std::optional<double> duration;         ///< s
  std::optional<std::int64_t> steps;      ///< number of time steps
  std::optional<double> time_step;        ///< s
  std::optional<double> time_step_ratio;  ///< of the stiffness criteria; default 0.3
  std::optional<std::int64_t>
      observe_every;  ///< steps between two observations; default: 200 in all
};

/// What is written besides the history and the summary.
struct OutputControl {
  std::int64_t frames = 10;           ///< trajectory frames besides the first
  std::int64_t checkpoint_every = 0;  ///< steps; 0: only at the end and when interrupted
  std::vector<std::string> fields;    ///< that frames show besides: engine/frame_fields.hpp
};

/// What is asked of each effect, by the type of its parameters: those of an effect that acts once
/// as an optional, those of one that may act several times as a list. So that an effect may join
/// without a line here.
class Requests {
 public:
  /// The parameters of an effect that acts once; none: the scene does not name it.
  template <class Parameters>
  std::optional<Parameters>& get() {
    return held<std::optional<Parameters>>();
  }
  template <class Parameters>
  const std::optional<Parameters>& get() const {
    return held<std::optional<Parameters>>();
  }

  /// The parameters of each of several effects of a kind.
  template <class Parameters>
  std::vector<Parameters>& all() {
    return held<std::vector<Parameters>>();
  }
  template <class Parameters>
  const std::vector<Parameters>& all() const {
    return held<std::vector<Parameters>>();
  }

 private:
  template <class Held>
  Held& held() {
    std::any& place = by_type_[typeid(Held)];
    if (!place.has_value()) place = Held{};
    return *std::any_cast<Held>(&place);
  }
  template <class Held>
  const Held& held() const {
    static const Held nothing{};
    const auto found = by_type_.find(typeid(Held));
    return found == by_type_.end() ? nothing : *std::any_cast<Held>(&found->second);
  }

  std::map<std::type_index, std::any> by_type_;
};

/// Everything a simulation does to a specimen: the effects the scene names and nothing else.
struct Setup : Requests {
  std::vector<Material> materials;
  std::vector<Sensor> sensors;
  std::optional<Gauge> gauge;
  RunControl run;
  OutputControl output;
};

}  // namespace solidem

#endif
